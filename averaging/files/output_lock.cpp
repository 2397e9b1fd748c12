// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/output_lock.hpp"

#include <utility>

#include "averaging/files/hdf5_file.hpp"
#include "averaging/files/solids_layout.hpp"

namespace millfoam::averaging {

void require_solids_or_nothing(const std::filesystem::path& path) {
  hdf5::naming_file<SolidsFileError>(path, [&] { hdf5::require_format_or_nothing(path, layout::format); });
}

FileLock lock_output(const std::filesystem::path& output) {
  LockRequest request{output.string() + ".lock"};
  request.temporary = true;
  if (auto lock = FileLock::take(request)) return std::move(*lock);
  throw SolidsFileError(output.string() + ": another millAverage is writing this file (it holds " +
                        request.file.string() + "): wait for it, or give another name");
}

}  // namespace millfoam::averaging
