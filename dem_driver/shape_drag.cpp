// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/shape_drag.hpp"

#include <algorithm>

#include "meshing/mill/mill_charge.hpp"

namespace millfoam::dem_driver {

double ShapeDrag::factor(double sphericity, double solidity, double slip, double diameter) const {
  if (bed.empty()) return 1;
  return drag::drag_over_mean(drag::reynolds(solidity, slip, diameter, slurry), {sphericity, sphericity},
                              bed);
}

double ShapeDrag::largest_factor() const {
  constexpr double fast = 1e6;  // Reynolds number
  double largest = 1;
  for (const drag::ShapeShare& part : bed)
    largest = std::max(largest, drag::drag_over_mean(fast, part.shape, bed));
  return largest;
}

ShapeDrag shape_drag_of(const meshing::Mill& mill) {
  ShapeDrag shapes;
  if (!mill.charge.has_shapes() || mill.flow.law != drag::hoelzer_sommerfeld_law().name) return shapes;
  for (const meshing::ClassShape& part : meshing::class_shapes(meshing::count_charge(mill)))
    shapes.bed.push_back({part.share, {part.sphericity, part.sphericity}});
  shapes.slurry = {mill.slurry.density, mill.slurry.plastic_viscosity};
  return shapes;
}

}  // namespace millfoam::dem_driver
