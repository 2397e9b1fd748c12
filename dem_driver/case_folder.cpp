// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/case_folder.hpp"

#include <stdexcept>
#include <utility>

namespace millfoam::dem_driver {

averaging::FileLock lock_folder(const CaseFolder& folder, std::chrono::milliseconds longest_wait) {
  averaging::LockRequest request{folder.lock(), longest_wait};
  request.inherited = true;
  if (auto lock = averaging::FileLock::take(request)) return std::move(*lock);
  throw std::runtime_error(folder.dem().string() +
                           ": another millDem runs in this folder, expected one at a time");
}

}  // namespace millfoam::dem_driver
