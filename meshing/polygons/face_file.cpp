// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/polygons/face_file.hpp"

#include <algorithm>
#include <cctype>

#include "meshing/polygons/obj_file.hpp"
#include "meshing/polygons/ply_file.hpp"

namespace millfoam::meshing {

bool has_extension(const std::filesystem::path& file, const std::string& extension) {
  std::string found = file.extension().string();
  std::transform(found.begin(), found.end(), found.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return found == extension;
}

PolygonSet read_faces(const std::filesystem::path& file) {
  if (has_extension(file, ".obj")) return read_obj(file);
  if (has_extension(file, ".ply")) return read_ply(file);
  throw PolygonError(file.string() + ": expected a file of faces that ends in .obj or .ply");
}

}  // namespace millfoam::meshing
