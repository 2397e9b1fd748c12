// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/grids/grid.hpp"

namespace millfoam::averaging {

namespace {

/// Of a box or a cylinder: the shape from the slowest to the fastest.
template <typename Voxels>
std::vector<std::size_t> shape_of(const Voxels& grid) {
  const auto& [first, second, third] = grid.shape();
  return {static_cast<std::size_t>(third), static_cast<std::size_t>(second), static_cast<std::size_t>(first)};
}

std::vector<std::size_t> shape_of(const MeshCells& mesh) {
  return {mesh.volumes.size()};
}

double volume_of(const BoxGrid& grid, std::size_t) {
  return grid.voxel_volume();
}

double volume_of(const CylinderGrid& grid, std::size_t cell) {
  const int radius = static_cast<int>(cell % static_cast<std::size_t>(grid.shape()[0]));
  return grid.voxel_volume({radius, 0, 0});
}

double volume_of(const MeshCells& mesh, std::size_t cell) {
  return mesh.volumes[cell];
}

}  // namespace

double cell_volume(const Grid& grid, std::size_t cell) {
  return std::visit([cell](const auto& kind) { return volume_of(kind, cell); }, grid);
}

std::vector<std::size_t> field_shape(const Grid& grid) {
  return std::visit([](const auto& kind) { return shape_of(kind); }, grid);
}

std::size_t cell_count(const Grid& grid) {
  std::size_t cells = 1;
  for (const std::size_t size : field_shape(grid)) cells *= size;
  return cells;
}

std::string cell_name(const Grid& grid, std::size_t cell) {
  const std::vector<std::size_t> shape = field_shape(grid);
  if (shape.size() == 1) return "cell " + std::to_string(cell);
  const std::size_t nx = shape[2], ny = shape[1];
  return "voxel (" + std::to_string(cell % nx) + ' ' + std::to_string(cell / nx % ny) + ' ' +
         std::to_string(cell / (nx * ny)) + ')';
}

std::optional<Vector3> voxel_centre(const Grid& grid, std::size_t cell) {
  const std::vector<std::size_t> shape = field_shape(grid);
  if (shape.size() == 1) return std::nullopt;
  const std::size_t nx = shape[2], ny = shape[1];
  const VoxelIndex voxel{static_cast<int>(cell % nx), static_cast<int>(cell / nx % ny),
                         static_cast<int>(cell / (nx * ny))};
  if (const auto* box = std::get_if<BoxGrid>(&grid)) return box->centre(voxel);
  return std::get<CylinderGrid>(grid).centre(voxel);
}

}  // namespace millfoam::averaging
