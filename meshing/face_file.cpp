// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/face_file.hpp"

#include <algorithm>
#include <cctype>

#include "meshing/obj_file.hpp"
#include "meshing/ply_file.hpp"

namespace millfoam::meshing {

PolygonSet read_faces(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".obj") return read_obj(file);
  if (extension == ".ply") return read_ply(file);
  throw PolygonError(file.string() + ": expected a file of faces that ends in .obj or .ply");
}

}  // namespace millfoam::meshing
