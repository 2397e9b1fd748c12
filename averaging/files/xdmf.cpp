// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/xdmf.hpp"

#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "averaging/files/hdf5_file.hpp"
#include "averaging/files/hdf5_io.hpp"
#include "averaging/files/solids_file.hpp"
#include "averaging/files/solids_layout.hpp"
#include "meshing/files/output_file.hpp"

namespace millfoam::averaging {

namespace {

template <typename Values>
std::string joined(const Values& values) {
  std::ostringstream text;
  text.precision(17);
  for (const auto& value : values) text << (text.tellp() > 0 ? " " : "") << value;
  return text.str();
}

const std::string begin_of_file = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n";

/// An array in the text itself or, named FILE:/NAME, in an HDF5 file.
std::string data_item(const std::string& sizes, bool whole_numbers, bool in_file,
                      const std::string& content) {
  std::string type = " NumberType=\"Float\" Precision=\"8\"";
  if (whole_numbers) type = " NumberType=\"Int\" Precision=\"8\"";
  return "          <DataItem Dimensions=\"" + sizes + "\"" + type + " Format=\"" +
         (in_file ? "HDF" : "XML") + "\">" + content + "</DataItem>\n";
}

/// What ParaView needs to know of a grid: its topology and geometry.
class Geometry {
 public:
  Geometry(std::ostream& out, const std::string& file, std::vector<hsize_t> points, hsize_t topology)
      : out_(out), file_(file), points_(std::move(points)), topology_(topology) {}

  void operator()(const BoxGrid& grid) const {
    const auto [nx, ny, nz] = grid.shape();
    const auto [x, y, z] = grid.lower();
    const auto [dx, dy, dz] = grid.spacing();
    out_ << "        <Topology TopologyType=\"3DCoRectMesh\" Dimensions=\""
         << joined(std::vector<int>{nz + 1, ny + 1, nx + 1})
         << "\"/>\n        <Geometry GeometryType=\"ORIGIN_DXDYDZ\">\n"
         << data_item("3", false, false, joined(Vector3{z, y, x}))
         << data_item("3", false, false, joined(Vector3{dz, dy, dx})) << "        </Geometry>\n";
  }

  void operator()(const CylinderGrid& grid) const {
    const auto [nr, ntheta, nz] = grid.shape();
    out_ << "        <Topology TopologyType=\"3DSMesh\" Dimensions=\""
         << joined(std::vector<int>{nz + 1, ntheta + 1, nr + 1}) << "\"/>\n";
    write_points();
  }

  void operator()(const MeshCells& mesh) const {
    out_ << "        <Topology TopologyType=\"Mixed\" NumberOfElements=\"" << mesh.volumes.size() << "\">\n"
         << data_item(std::to_string(topology_), true, true, file_ + ":/grid/topology")
         << "        </Topology>\n";
    write_points();
  }

 private:
  void write_points() const {
    out_ << "        <Geometry GeometryType=\"XYZ\">\n"
         << data_item(joined(points_), false, true, file_ + ":/grid/points") << "        </Geometry>\n";
  }

  std::ostream& out_;
  std::string file_;
  std::vector<hsize_t> points_;
  hsize_t topology_;
};

/// A field of one window as a slab of the data set over all windows.
void write_attribute(std::ostream& out, const Grid& grid, const std::string& file, const XdmfField& field,
                     std::size_t window, std::size_t windows) {
  std::vector<std::size_t> shape = field_shape(grid);
  if (field.vector) shape.push_back(3);
  const std::string sizes = joined(shape);
  const std::vector<int> zeros(shape.size(), 0), ones(shape.size(), 1);
  out << "        <Attribute Name=\"" << field.name << "\" Center=\"Cell\" AttributeType=\""
      << (field.vector ? "Vector" : "Scalar") << "\">\n"
      << "          <DataItem ItemType=\"HyperSlab\" Dimensions=\"" << sizes << "\">\n"
      << "            <DataItem Dimensions=\"3 " << shape.size() + 1 << "\" Format=\"XML\">" << window << ' '
      << joined(zeros) << "  1 " << joined(ones) << "  1 " << sizes << "</DataItem>\n  "
      << data_item(std::to_string(windows) + ' ' + sizes, false, true, file + ":/" + field.data_set)
      << "          </DataItem>\n        </Attribute>\n";
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else {
      result += c;
    }
  }
  return result;
}

/// Dimensions of /grid/points and length of /grid/topology, where they are there.
std::pair<std::vector<hsize_t>, hsize_t> geometry_sizes(const std::filesystem::path& path, const Grid& grid) {
  if (std::holds_alternative<BoxGrid>(grid)) return {};
  return hdf5::naming_file<SolidsFileError>(path, [&]() -> std::pair<std::vector<hsize_t>, hsize_t> {
    const hdf5::Handle file = hdf5::open_file(path, "millAverage");
    const hdf5::Handle group = hdf5::open_group(file.get(), "grid");
    return {hdf5::dimensions(group.get(), "points"),
            std::holds_alternative<MeshCells>(grid) ? hdf5::dimensions(group.get(), "topology")[0] : 0};
  });
}

}  // namespace

std::filesystem::path xdmf_path(const std::filesystem::path& solids_file) {
  std::filesystem::path path = solids_file;
  path.replace_extension(".xdmf");
  if (path == solids_file) {
    throw SolidsFileError(path.string() +
                          ": this is the name of the file for ParaView, expected one like solids.h5");
  }
  return path;
}

void require_xdmf_or_nothing(const std::filesystem::path& path) {
  std::ifstream input(path, std::ios::binary);
  if (!input) return;
  std::string found(begin_of_file.size(), '\0');
  input.read(found.data(), static_cast<std::streamsize>(found.size()));
  if (found != begin_of_file)
    throw SolidsFileError(
        path.string() +
        ": this is no file for ParaView as millAverage writes it; it would be overwritten: give "
        "another name or remove it");
}

std::filesystem::path write_xdmf(const std::filesystem::path& fields_file, const std::string& title,
                                 const Grid& grid, const std::vector<double>& times,
                                 const std::vector<XdmfField>& fields) {
  std::filesystem::path path = xdmf_path(fields_file);
  const std::string file = escaped(fields_file.filename().string());
  const auto sizes = geometry_sizes(fields_file, grid);
  try {
    replace_file(path, [&](std::ostream& out) {
      out.precision(17);
      out << begin_of_file << "  <Domain>\n"
          << "    <Grid Name=\"" << title << "\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
      for (std::size_t w = 0; w < times.size(); ++w) {
        out << "      <Grid Name=\"window " << w << "\" GridType=\"Uniform\">\n"
            << "        <Time Value=\"" << times[w] << "\"/>\n";
        std::visit(Geometry(out, file, sizes.first, sizes.second), grid);
        for (const XdmfField& field : fields) write_attribute(out, grid, file, field, w, times.size());
        out << "      </Grid>\n";
      }
      out << "    </Grid>\n  </Domain>\n</Xdmf>\n";
    });
  } catch (const std::runtime_error&) {
    throw SolidsFileError(path.string() + ": cannot write this file (is the disk full?)");
  }
  return path;
}

std::filesystem::path write_xdmf(const std::filesystem::path& solids_file) {
  xdmf_path(solids_file);
  const SolidsReader solids(solids_file);
  std::vector<XdmfField> fields;
  fields.reserve(std::size(layout::fields) + 1);
  // ParaView takes the components of a vector for those along x, y and z
  const auto* cylinder = std::get_if<CylinderGrid>(&solids.grid());
  const bool cylindrical = cylinder != nullptr && cylinder->frame().cylindrical;
  for (const layout::Field& field : layout::fields) {
    const std::string directions = cylindrical && field.vector ? "_r_theta_z" : "";
    fields.push_back({field.name + directions, field.name, field.vector});
  }
  if (solids.header().inside_fractions) {
    const std::string name = layout::inside_fraction.name;
    fields.push_back({name, "grid/" + name, layout::inside_fraction.vector});
  }
  std::vector<double> times;
  for (const TimeWindow& window : solids.windows()) times.push_back(window.begin);
  return write_xdmf(solids_file, "solids", solids.grid(), times, fields);
}

}  // namespace millfoam::averaging
