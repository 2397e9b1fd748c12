// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "meshing/mill/mill.hpp"
#include "openfoam_module/drag/nonspherical.hpp"

namespace millfoam::dem_driver {

/// Drag on balls of several shapes in a flow whose drag is the mean over the shapes.
struct ShapeDrag {
  std::vector<drag::ShapeShare> bed = {};  ///< all shapes; empty: each ball feels the mean
  drag::Fluid slurry = {};                 ///< with its plastic viscosity

  /// Drag on a ball over the mean; 1 without a bed.
  /// @param sphericity  of the ball, also crosswise
  /// @param solidity  around the ball
  /// @param slip  m/s
  /// @param diameter  of the sphere of equal volume, m
  double factor(double sphericity, double solidity, double slip, double diameter) const;

  /// The largest factor of a ball, which the least spherical ones have at high Reynolds numbers.
  double largest_factor() const;
};

/// Of a mill with balls that are not spheres and the law that knows shapes; else without a bed.
ShapeDrag shape_drag_of(const meshing::Mill& mill);

}  // namespace millfoam::dem_driver
