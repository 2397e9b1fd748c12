// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/output_file.hpp"

#include <array>
#include <charconv>
#include <fstream>
#include <stdexcept>

namespace millfoam::meshing {

std::string exact(double value) {
  std::array<char, 32> text;  // the longest, -2.2250738585072014e-308, has 24
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string exact(const Eigen::Vector3d& vector) {
  return exact(vector.x()) + ' ' + exact(vector.y()) + ' ' + exact(vector.z());
}

namespace {

void write_through(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  std::ofstream stream(file);
  write(stream);
  stream.close();
  if (!stream)
    throw std::runtime_error(file.string() + ": cannot be written: no permission, or the disk is full");
}

}  // namespace

void write_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  namespace fs = std::filesystem;
  if (file.has_parent_path()) fs::create_directories(file.parent_path());
  // A device or a pipe must not be replaced, nor a link by what it points to
  const fs::path whole = fs::exists(file) ? fs::canonical(file) : file;
  if (fs::exists(whole) && !fs::is_regular_file(whole)) {
    write_through(whole, write);
    return;
  }
  const fs::path partial = whole.string() + ".partial";
  write_through(partial, write);
  fs::rename(partial, whole);
}

}  // namespace millfoam::meshing
