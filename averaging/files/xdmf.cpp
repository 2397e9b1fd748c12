// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/xdmf.hpp"

#include <fstream>
#include <sstream>

#include "averaging/files/solids_file.hpp"
#include "averaging/files/solids_layout.hpp"

namespace millfoam::averaging {

namespace {

/// Three values from the slowest axis, z, to the fastest, x, as XDMF wants them.
template <typename Values>
std::string zyx(const Values& values) {
  std::ostringstream text;
  text.precision(17);
  text << values[2] << ' ' << values[1] << ' ' << values[0];
  return text.str();
}

void write_geometry(std::ostream& out, const BoxGrid& grid) {
  const auto [nx, ny, nz] = grid.shape();
  out << "        <Topology TopologyType=\"3DCoRectMesh\" Dimensions=\""
      << zyx(VoxelIndex{nx + 1, ny + 1, nz + 1})
      << "\"/>\n        <Geometry GeometryType=\"ORIGIN_DXDYDZ\">\n";
  for (const Vector3& values : {grid.lower(), grid.spacing()}) {
    out << "          <DataItem Dimensions=\"3\" NumberType=\"Float\" Precision=\"8\" Format=\"XML\">"
        << zyx(values) << "</DataItem>\n";
  }
  out << "        </Geometry>\n";
}

/// A field of one window as a slab of the data set over all windows.
void write_attribute(std::ostream& out, const BoxGrid& grid, const layout::Field& field,
                     const std::string& file, std::size_t window, std::size_t windows) {
  const std::string sizes = zyx(grid.shape()) + (field.vector ? " 3" : "");
  const std::string zeros = field.vector ? " 0 0 0 0" : " 0 0 0", ones = field.vector ? " 1 1 1 1" : " 1 1 1";
  out << "        <Attribute Name=\"" << field.name << "\" Center=\"Cell\" AttributeType=\""
      << (field.vector ? "Vector" : "Scalar") << "\">\n"
      << "          <DataItem ItemType=\"HyperSlab\" Dimensions=\"" << sizes << "\">\n"
      << "            <DataItem Dimensions=\"3 " << (field.vector ? 5 : 4) << "\" Format=\"XML\">" << window
      << zeros << "  1" << ones << "  1 " << sizes << "</DataItem>\n"
      << "            <DataItem Dimensions=\"" << windows << ' ' << sizes
      << "\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">" << file << ":/" << field.name
      << "</DataItem>\n"
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

std::filesystem::path write_xdmf(const std::filesystem::path& solids_file) {
  std::filesystem::path path = xdmf_path(solids_file);
  const SolidsReader solids(solids_file);
  std::ofstream out(path);
  out.precision(17);
  out << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n  <Domain>\n"
      << "    <Grid Name=\"solids\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  const std::vector<TimeWindow>& windows = solids.windows();
  for (std::size_t w = 0; w < windows.size(); ++w) {
    out << "      <Grid Name=\"window " << w << "\" GridType=\"Uniform\">\n"
        << "        <Time Value=\"" << windows[w].begin << "\"/>\n";
    write_geometry(out, solids.grid());
    for (const layout::Field& field : layout::fields) {
      write_attribute(out, solids.grid(), field, escaped(solids_file.filename().string()), w, windows.size());
    }
    out << "      </Grid>\n";
  }
  out << "    </Grid>\n  </Domain>\n</Xdmf>\n";
  out.close();
  if (!out) throw SolidsFileError(path.string() + ": cannot write this file");
  return path;
}

}  // namespace millfoam::averaging
