// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/volume/openfoam_files.hpp"

#include <algorithm>
#include <string>

#include "meshing/files/output_file.hpp"
#include "meshing/files/text_numbers.hpp"

namespace millfoam::meshing {
namespace {

namespace fs = std::filesystem;

void write_header(std::ostream& out, const std::string& type, const std::string& location,
                  const std::string& object, const std::string& note = "") {
  out << "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       " << type << ";\n";
  if (!note.empty()) out << "    note        \"" << note << "\";\n";
  out << "    location    \"" << location << "\";\n    object      " << object << ";\n}\n\n";
}

/// A list in OpenFOAM's notation, one item a line.
template <typename List, typename WriteItem>
void write_list(std::ostream& out, const List& list, const WriteItem& write_item) {
  out << list.size() << "\n(\n";
  for (const auto& item : list) {
    write_item(item);
    out << '\n';
  }
  out << ")\n";
}

void write_labels(const fs::path& folder, const std::string& object, const std::vector<int>& labels,
                  const std::string& note) {
  write_file(folder / object, [&](std::ostream& out) {
    write_header(out, "labelList", "constant/polyMesh", object, note);
    write_list(out, labels, [&](int label) { out << label; });
  });
}

/// First point of a patch's first face.
template <typename Mesh>
const Eigen::Vector3d& first_point(const Mesh& mesh, const Patch& patch) {
  const auto& face = mesh.faces[static_cast<std::size_t>(patch.start)];
  return mesh.points[static_cast<std::size_t>(face[0])];
}

template <typename Mesh>
void write_patch(std::ostream& out, const Mesh& mesh, const Patch& patch) {
  out << "    " << patch.name << "\n    {\n";
  if (patch.open) {
    out << "        type            patch;\n";
  } else if (patch.neighbour.empty()) {
    out << "        type            wall;\n        inGroups        1(wall);\n";
  } else {
    const auto other = std::find_if(mesh.patches.begin(), mesh.patches.end(),
                                    [&](const Patch& p) { return p.name == patch.neighbour; });
    const double separation = first_point(mesh, *other).z() - first_point(mesh, patch).z();
    out << "        type            cyclic;\n        inGroups        1(cyclic);\n        neighbourPatch  "
        << patch.neighbour << ";\n        transform       translational;\n        separationVector (0 0 "
        << exact(separation) << ");\n        matchTolerance  0.0001;\n";
  }
  out << "        nFaces          " << patch.size << ";\n        startFace       " << patch.start
      << ";\n    }";
}

/// `kind`: cell or face.
void write_zones(const fs::path& folder, const std::string& kind, const std::vector<Zone>& zones) {
  if (zones.empty()) return;
  const std::string object = kind + "Zones";
  write_file(folder / object, [&](std::ostream& out) {
    write_header(out, "regIOobject", "constant/polyMesh", object);
    write_list(out, zones, [&](const Zone& zone) {
      out << zone.name << "\n{\n    type " << kind << "Zone;\n    " << kind << "Labels List<label> ";
      write_list(out, zone.members, [&](int label) { out << label; });
      out << ";\n";
      if (kind == "face") out << "    flipMap List<bool> " << zone.members.size() << "{0};\n";
      out << '}';
    });
  });
}

template <typename Mesh>
void write_mesh(const Mesh& mesh, const fs::path& case_folder) {
  const fs::path whole = case_folder / "constant" / "polyMesh";
  const fs::path partial = whole.string() + ".partial";
  fs::remove_all(partial);
  write_file(partial / "points", [&](std::ostream& out) {
    write_header(out, "vectorField", "constant/polyMesh", "points");
    write_list(out, mesh.points, [&](const Eigen::Vector3d& point) { out << '(' << exact(point) << ')'; });
  });
  write_file(partial / "faces", [&](std::ostream& out) {
    write_header(out, "faceList", "constant/polyMesh", "faces");
    write_list(out, mesh.faces, [&](const auto& face) {
      out << face.size() << '(';
      for (std::size_t i = 0; i < face.size(); ++i) out << (i == 0 ? "" : " ") << face[i];
      out << ')';
    });
  });
  const std::string note = "nPoints:" + std::to_string(mesh.points.size()) +
                           " nCells:" + std::to_string(mesh.cells) +
                           " nFaces:" + std::to_string(mesh.faces.size()) +
                           " nInternalFaces:" + std::to_string(mesh.neighbour.size());
  write_labels(partial, "owner", mesh.owner, note);
  write_labels(partial, "neighbour", mesh.neighbour, note);
  write_file(partial / "boundary", [&](std::ostream& out) {
    write_header(out, "polyBoundaryMesh", "constant/polyMesh", "boundary");
    write_list(out, mesh.patches, [&](const Patch& patch) { write_patch(out, mesh, patch); });
  });
  write_zones(partial, "cell", mesh.cell_zones);
  write_zones(partial, "face", mesh.face_zones);
  fs::remove_all(whole);
  fs::rename(partial, whole);
}

}  // namespace

void write_poly_mesh(const VolumeMesh& mesh, const fs::path& case_folder) {
  write_mesh(mesh, case_folder);
}

void write_poly_mesh(const PolyMesh& mesh, const fs::path& case_folder) {
  write_mesh(mesh, case_folder);
}

}  // namespace millfoam::meshing
