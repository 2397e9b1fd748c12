// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "averaging/grids/box_grid.hpp"
#include "dem_driver/fluid_forces.hpp"

namespace millfoam::dem_driver::tests {

/// A flow's fields at a point.
struct FlowAtPoint {
  double inside = 1;
  Vector pressure_force = {}, drag_force = {};
  double exchange = 0, solidity = 0, diameter = 0.003;
};

/// What is in a slurry.h5.
struct SlurryContent {
  averaging::BoxGrid grid;
  /// The windows and, after them, the mean: fields by the centre of a voxel.
  std::vector<std::function<FlowAtPoint(const Vector&)>> windows;
  std::function<FlowAtPoint(const Vector&)> mean = {};
  std::string mill_flow = {};
  bool polydispersity = false;
  int version = 2;
  int complete = 1;
  bool balls = true;
};

/// Writes a slurry.h5 whose windows are [0, 1), [1, 2), … s.
void write_slurry(const std::filesystem::path& file, const SlurryContent& content);

}  // namespace millfoam::dem_driver::tests
