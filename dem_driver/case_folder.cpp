// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/case_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <stdexcept>
#include <thread>

namespace millfoam::dem_driver {

FolderLock::FolderLock(const CaseFolder& folder, std::chrono::milliseconds longest_wait)
    : file_(open(folder.lock().c_str(), O_RDWR | O_CREAT, 0666)) {
  if (file_ < 0) throw std::runtime_error(folder.lock().string() + ": cannot be written");
  constexpr std::chrono::milliseconds between(100);
  for (std::chrono::milliseconds waited(0); flock(file_, LOCK_EX | LOCK_NB) != 0; waited += between) {
    if (waited >= longest_wait) {
      close(file_);
      throw std::runtime_error(folder.dem().string() +
                               ": another millDem runs in this folder, expected one at a time");
    }
    std::this_thread::sleep_for(between);
  }
}

FolderLock::~FolderLock() {
  close(file_);
}

}  // namespace millfoam::dem_driver
