// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "averaging/mesh/mesh_geometry.hpp"

namespace millfoam::averaging {

/// Spreads fields of a mesh over a width, by diffusion with no flux through the walls: in free space a point
/// becomes the kernel exp(-r^2/b^2) of the bandwidth b, with the variance b^2/2 along each axis.
///
/// It is done in explicit steps, short enough that each only moves parts of a cell's total to its neighbours:
/// nothing becomes negative, the total is kept to round-off, and ratios such as the velocity (momentum over
/// volume) stay between those of the cells that were mixed, however little came. The flux through a face is
/// its area times the difference of the densities over the distance of the cells' centres; what a skew of
/// that line against the face would add is left out, so on skewed meshes the width is met to the order of the
/// skew.
///
/// Source: Sun & Xiao 2015, Int J Multiph Flow 77:142 (diffusion-based coarse graining).
class MeshDiffusion {
 public:
  /// @param mesh    whose cells keep their shape; it is not kept
  /// @param width   bandwidth b, m
  /// @param period  length of the mesh along z where it repeats, m
  ///
  /// Throws std::invalid_argument for a width that is not positive or takes too many steps, and as
  /// `periodic_faces`.
  MeshDiffusion(const MeshGeometry& mesh, double width, std::optional<double> period = std::nullopt);

  int steps() const { return steps_; }  ///< number of explicit steps

  /// Spreads extensive totals per cell in place, [cells][components].
  void apply(std::vector<double>& totals, std::size_t components) const;

 private:
  template <std::size_t Components>
  void step(const std::vector<double>& from, std::vector<double>& to, std::size_t some) const;

  int steps_ = 0;
  std::vector<double> kept_;         ///< [cells] the part of a cell's total that stays in a step
  std::vector<std::size_t> begin_;   ///< [cells + 1] where a cell's sources begin
  std::vector<std::size_t> source_;  ///< cells it gets something from
  std::vector<double> part_;         ///< and the part of their total
};

}  // namespace millfoam::averaging
