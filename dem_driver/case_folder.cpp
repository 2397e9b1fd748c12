// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/case_folder.hpp"

#include <fstream>
#include <limits>
#include <stdexcept>

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

std::vector<std::string> find_walls(const CaseFolder& folder, const meshing::Mill& mill) {
  std::vector<std::string> parts{"shell"};
  if (mill.geometry.lifters.count > 0) parts.push_back("lifters");
  if (mill.geometry.ends == meshing::Ends::plain) parts.insert(parts.end(), {"feedEnd", "dischargeEnd"});
  for (const auto& part : parts) {
    const fs::path file = folder.walls() / (part + ".stl");
    if (!fs::exists(file)) throw std::runtime_error(file.string() + ": no such wall, run millMesh first");
  }
  return parts;
}

std::vector<fs::path> find_dumps(const CaseFolder& folder) {
  std::vector<fs::path> dumps;
  if (!fs::is_directory(folder.dumps())) return dumps;
  for (const auto& entry : fs::directory_iterator(folder.dumps())) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("dump.", 0) == 0 && entry.path().extension() == ".txt") dumps.push_back(entry.path());
  }
  return dumps;
}

std::size_t prepare_folders(const CaseFolder& folder) {
  fs::create_directories(folder.dem());
  fs::create_directories(folder.dumps());
  fs::remove(folder.run_file());
  const auto old = find_dumps(folder);
  for (const auto& dump : old) fs::remove(dump);
  return old.size();
}

void write_run_file(const CaseFolder& folder, const meshing::Mill& mill, const DemPlan& plan) {
  const fs::path unfinished = folder.dumps() / "run.txt.part";
  {
    std::ofstream out(unfinished);
    out.precision(std::numeric_limits<double>::max_digits10);
    out << "timestep " << plan.step.value << "\ninterval " << plan.step.steps_per_record
        << "\nangular_velocity " << mill.angular_velocity << '\n';
    out.close();
    if (!out) throw std::runtime_error(unfinished.string() + ": cannot be written");
  }
  fs::rename(unfinished, folder.run_file());
}

}  // namespace millfoam::dem_driver
