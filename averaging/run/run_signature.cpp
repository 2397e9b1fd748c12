// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/run_signature.hpp"

#include <sstream>

#include "averaging/files/solids_file.hpp"
#include "averaging/run/program.hpp"

namespace millfoam::averaging {

namespace {

std::ostream& operator<<(std::ostream& out, const std::optional<double>& value) {
  return value ? out << *value : out << '-';
}

void put_file(std::ostream& out, const std::filesystem::path& file) {
  std::error_code missing;
  out << file << ' ' << std::filesystem::file_size(file, missing) << ' '
      << std::filesystem::last_write_time(file, missing).time_since_epoch().count() << '\n';
}

template <typename Values>
void put_all(std::ostream& out, const Values& values) {
  for (const auto& value : values) out << value << ' ';
}

void put(std::ostream& out, const BoxGrid& grid) {
  out << "box ";
  put_all(out, grid.lower());
  put_all(out, grid.upper());
  put_all(out, grid.shape());
  put_all(out, grid.periodic());
}

void put(std::ostream& out, const CylinderRequest& cylinder) {
  const CylinderGrid& grid = cylinder.grid;
  out << "cylinder " << grid.periodic_z() << ' ' << cylinder.cylindrical << ' ' << cylinder.turning << ' ';
  put_all(out, grid.radii());
  put_all(out, grid.ends());
  put_all(out, grid.shape());
}

void put(std::ostream& out, const MeshRequest& mesh) {
  out << "mesh ";
  put_file(out, mesh.file);
  for (const std::string& text : mesh.motion) {
    out << '\'' << text << "' ";
    std::istringstream words(text);
    std::string kind, source, file;
    if (words >> kind >> source >> file && source == "table") put_file(out, file);
  }
  out << mesh.at_rest << ' ' << mesh.period_z << ' ' << mesh.smoothed << ' ' << mesh.smoothing;
}

}  // namespace

std::string signature(const AverageRequest& request, const RunSettings& settings,
                      const std::vector<WindowPlan>& plans, const std::vector<DumpFile>& dumps) {
  std::ostringstream out;
  out.precision(17);
  out << program() << ' ' << solids_version << '\n'
      << settings.timestep << ' ' << settings.angular_velocity << ' ' << static_cast<int>(request.method)
      << ' ' << request.template_points << ' ' << request.solidity_cap << ' ' << request.start << ' '
      << request.end << '\n';
  std::visit([&](const auto& grid) { put(out, grid); }, request.grid);
  out << '\n';
  for (const std::filesystem::path& file : request.walls) put_file(out, file);
  for (const WindowsRequest& windows : request.windows)
    out << windows.length << ' ' << windows.output << '\n';
  for (const WindowPlan& plan : plans) {
    for (const WindowSpan& span : plan.windows) {
      out << span.begin << ' ' << span.end << ' ' << span.first_record << ' ' << span.records << ' ';
    }
    out << '\n';
  }
  for (const DumpFile& dump : dumps) {
    out << dump.step << ' ';
    put_file(out, dump.path);
  }
  return out.str();
}

}  // namespace millfoam::averaging
