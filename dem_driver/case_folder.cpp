// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/case_folder.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace millfoam::dem_driver {

std::vector<std::filesystem::path> find_dumps(const CaseFolder& folder) {
  std::vector<std::filesystem::path> dumps;
  if (!std::filesystem::is_directory(folder.dumps())) return dumps;
  for (const auto& entry : std::filesystem::directory_iterator(folder.dumps())) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("dump.", 0) == 0 && entry.path().extension() == ".txt") dumps.push_back(entry.path());
  }
  return dumps;
}

void remove_results(const CaseFolder& folder) {
  for (const auto& file : {folder.run_file(), folder.results(), folder.energy(), folder.torques(),
                           folder.fluid(), folder.contact_power(), folder.contact_spectra(),
                           folder.wall_forces(), folder.overlaps(), folder.charge()})
    std::filesystem::remove(file);
}

averaging::FileLock lock_folder(const CaseFolder& folder, std::chrono::milliseconds longest_wait) {
  averaging::LockRequest request{folder.lock(), longest_wait};
  request.inherited = true;
  if (auto lock = averaging::FileLock::take(request)) return std::move(*lock);
  throw std::runtime_error(folder.dem().string() +
                           ": another millDem runs in this folder, expected one at a time");
}

}  // namespace millfoam::dem_driver
