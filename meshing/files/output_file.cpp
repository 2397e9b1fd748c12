// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/files/output_file.hpp"

#include <fstream>
#include <stdexcept>
#include <system_error>

namespace millfoam {

namespace {

std::runtime_error not_written(const std::filesystem::path& file) {
  return std::runtime_error(file.string() + ": cannot be written: no permission, or the disk is full");
}

/// Whether the text was written.
bool write_through(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  std::ofstream stream(file, std::ios::binary);
  write(stream);
  stream.close();
  return static_cast<bool>(stream);
}

}  // namespace

void replace_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  namespace fs = std::filesystem;
  if (fs::is_directory(file))
    throw std::runtime_error(file.string() + ": is a folder, expected the name of a file");
  const fs::path whole = fs::exists(file) ? fs::canonical(file) : file;
  if (fs::exists(whole) && !fs::is_regular_file(whole)) {
    if (!write_through(whole, write)) throw not_written(file);
    return;
  }
  const fs::path part = whole.string() + ".part";
  std::error_code failure;
  const bool written = write_through(part, write);
  if (written) fs::rename(part, whole, failure);
  if (written && !failure) return;
  fs::remove(part, failure);
  throw not_written(file);
}

void write_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  std::error_code failure;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), failure);
  if (failure) throw FolderError(file.string() + ": its folder cannot be made: " + failure.message());
  replace_file(file, write);
}

}  // namespace millfoam
