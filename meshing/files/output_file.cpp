// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/files/output_file.hpp"

#include <fstream>
#include <stdexcept>
#include <system_error>

namespace millfoam {

void replace_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  const std::filesystem::path part = file.string() + ".part";
  std::ofstream stream(part, std::ios::binary);
  write(stream);
  stream.close();
  std::error_code failure;
  if (stream) std::filesystem::rename(part, file, failure);
  if (stream && !failure) return;
  std::filesystem::remove(part, failure);
  throw std::runtime_error(file.string() + ": cannot be written: no permission, or the disk is full");
}

void write_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  replace_file(file, write);
}

}  // namespace millfoam
