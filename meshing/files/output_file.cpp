// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/files/output_file.hpp"

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

void write_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write) {
  const std::filesystem::path partial = file.string() + ".partial";
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  {
    std::ofstream stream(partial);
    write(stream);
    stream.close();
    if (!stream)
      throw std::runtime_error(partial.string() + ": cannot be written: no permission, or the disk is full");
  }
  std::filesystem::rename(partial, file);
}

}  // namespace millfoam::meshing
