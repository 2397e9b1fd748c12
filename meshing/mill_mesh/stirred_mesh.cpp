// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill_mesh/stirred_mesh.hpp"

#include "meshing/mill_mesh/o_grid.hpp"
#include "meshing/mill_mesh/stirred_grid.hpp"
#include "meshing/volume/hexahedra.hpp"

namespace millfoam::meshing {
namespace {

/// The patches in their order.
enum StirredPatch { impeller_patch, shell_patch, base_patch, lid_patch };
const std::vector<std::string> stirred_patches = {"impeller", "shell", "base", "lid"};

class StirredMesh {
 public:
  StirredMesh(const Geometry& geometry, double cell_size) : grid_(geometry, cell_size) {}

  VolumeMesh run() && {
    add_ring_points();
    add_cells();
    return mesh_of_hexahedra(points_, std::move(cells_), stirred_patches);
  }

 private:
  static std::size_t index(int number) { return static_cast<std::size_t>(number); }

  int ring_point(int ring, int column, int row) const {
    const int around = grid_.around();
    return (row * (grid_.rings() + 1) + ring) * around + (column + around) % around;
  }

  void add_ring_points() {
    for (int row = 0; row <= grid_.rows(); ++row)
      for (int ring = 0; ring <= grid_.rings(); ++ring)
        for (int column = 0; column < grid_.around(); ++column)
          points_.push_back(grid_.place(ring, column, row));
  }

  /// The O-grid below the shaft at the lower side of a row. Appends its points to the mesh, and to `numbers`
  /// the numbers of the section's points in the mesh.
  CrossSection core_at(int row, std::vector<int>& numbers) {
    CrossSection section;
    std::vector<int> rim;
    for (int column = 0; column < grid_.around(); ++column) {
      const int point = ring_point(0, column, row);
      rim.push_back(column);
      numbers.push_back(point);
      section.points.emplace_back(points_[index(point)].head<2>());
    }
    add_o_grid(section, rim, grid_.around() / 8, grid_.lines().core_layers);
    for (std::size_t p = numbers.size(); p < section.points.size(); ++p) {
      numbers.push_back(static_cast<int>(points_.size()));
      points_.emplace_back(section.points[p].x(), section.points[p].y(), grid_.lines().heights[index(row)]);
    }
    return section;
  }

  /// The patches of a cell's faces at the boundary; ring -1: of the O-grid.
  std::array<int, 6> parts_of(int ring, int row) const {
    return {row == 0 ? base_patch : impeller_patch,
            row == grid_.rows() - 1 ? lid_patch : impeller_patch,
            ring == grid_.rings() - 1 ? shell_patch : impeller_patch,
            impeller_patch,
            impeller_patch,
            impeller_patch};
  }

  void add_cells() {
    std::vector<int> lower, upper;
    if (grid_.lines().shaft_end > 0) core_at(0, lower);
    for (int row = 0; row < grid_.rows(); ++row) {
      if (row < grid_.lines().shaft_end) {
        upper.clear();
        const CrossSection section = core_at(row + 1, upper);
        for (const auto& quad : section.quads) {
          Hexahedron cell;
          for (std::size_t i = 0; i < 4; ++i) {
            cell.points[i] = lower[index(quad[i])];
            cell.points[i + 4] = upper[index(quad[i])];
          }
          cell.parts = parts_of(-1, row);
          cells_.push_back(cell);
        }
        lower = upper;
      }
      for (int ring = 0; ring < grid_.rings(); ++ring)
        for (int column = 0; column < grid_.around(); ++column)
          if (!grid_.is_solid(ring, column, row)) add_ring_cell(ring, column, row);
    }
  }

  /// The third of its faces is the outer one.
  void add_ring_cell(int ring, int column, int row) {
    Hexahedron cell;
    for (int up = 0; up < 2; ++up) {
      cell.points[index(4 * up)] = ring_point(ring + 1, column, row + up);
      cell.points[index(4 * up + 1)] = ring_point(ring + 1, column + 1, row + up);
      cell.points[index(4 * up + 2)] = ring_point(ring, column + 1, row + up);
      cell.points[index(4 * up + 3)] = ring_point(ring, column, row + up);
    }
    cell.parts = parts_of(ring, row);
    cells_.push_back(cell);
  }

  StirredGrid grid_;
  std::vector<Eigen::Vector3d> points_;  ///< m
  std::vector<Hexahedron> cells_;
};

}  // namespace

VolumeMesh make_stirred_mesh(const Geometry& geometry, double cell_size) {
  return StirredMesh(geometry, cell_size).run();
}

}  // namespace millfoam::meshing
