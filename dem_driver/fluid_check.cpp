// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/fluid_check.hpp"

#include <algorithm>
#include <sstream>

#include "averaging/files/slurry_file.hpp"
#include "averaging/files/slurry_reader.hpp"
#include "dem_driver/fluid_forces.hpp"
#include "dem_driver/pairs.hpp"
#include "meshing/files/file_fingerprint.hpp"
#include "meshing/files/text_numbers.hpp"

namespace millfoam::dem_driver {

namespace {

using averaging::SlurryFileError;

std::string point(const Vector& x) {
  return '(' + shown(x[0]) + ", " + shown(x[1]) + ", " + shown(x[2]) + ')';
}

void require_mill(const averaging::SlurryReader& reader, const meshing::Mill& mill) {
  const std::string& found = reader.header().mill_flow;
  if (found.empty() || found == mill.fingerprint.flow) return;
  throw SlurryFileError(reader.path().string() + ": the flow is of another mill (flow " + found +
                        ", this mill's is " + mill.fingerprint.flow + "): run the flow again");
}

/// Voxels must reach over the whole mill, and repeat along the axis just as the mill does.
void require_cover(const averaging::SlurryReader& reader, const meshing::Geometry& geometry) {
  const averaging::BoxGrid& grid = reader.grid();
  const double slack = 1e-6 * geometry.diameter, radius = geometry.radius();
  const Vector lower{-radius, -radius, 0}, upper{radius, radius, geometry.length};
  bool covers = true;
  for (std::size_t k = 0; k < 3; ++k)
    covers = covers && grid.lower()[k] <= lower[k] + slack && grid.upper()[k] >= upper[k] - slack;
  const bool periodic = geometry.ends == meshing::Ends::periodic;
  if (periodic) covers = covers && grid.lower()[2] >= -slack && grid.upper()[2] <= geometry.length + slack;
  if (!covers)
    throw SlurryFileError(reader.path().string() + ": the voxels reach from " + point(grid.lower()) + " to " +
                          point(grid.upper()) + " m, expected " + (periodic ? "the period of " : "") +
                          "the mill, from " + point(lower) + " to " + point(upper) + " m");
  if (grid.periodic() != std::array<bool, 3>{false, false, periodic})
    throw SlurryFileError(reader.path().string() + ": the voxels are " +
                          (periodic ? "not periodic along the axis, expected periodic ones, as the slice is"
                                    : "periodic, expected voxels that are not, as the mill has ends"));
}

void require_windows(const averaging::SlurryReader& reader) {
  if (reader.header().windows > 0) return;
  throw SlurryFileError(reader.path().string() +
                        ": has no time windows, only a mean over the run; expected a flow's slurry.h5, or "
                        "--fluid-time mean");
}

}  // namespace

void require_slow_drag(const averaging::BallFields& fields, const averaging::BoxGrid& grid,
                       const DragLimits& limits, const std::string& source) {
  double strongest = 0;
  std::size_t where = 0;
  for (std::size_t i = 0; i < fields.exchange.size(); ++i) {
    if (!(fields.inside[i] > 0)) continue;
    const double d32 = fields.diameter[i];
    const bool mixture = limits.polydispersity && d32 > 0;
    const double size = mixture ? mixture_factor(limits.smallest_ball / d32, fields.solidity[i]) : 1;
    const double factor = size * limits.shape_factor;
    if (factor * fields.exchange[i] <= strongest) continue;
    strongest = factor * fields.exchange[i];
    where = i;
  }
  const double share = strongest * limits.timestep / limits.ball_density;
  if (share <= largest_drag_step) return;
  const auto [nx, ny, nz] = grid.shape();
  const int index = static_cast<int>(where);
  const Vector centre = grid.centre({index % nx, index / nx % ny, index / nx / ny});
  throw SlurryFileError(source + ": the drag at " + point(centre) + " m, K = " + shown(strongest) +
                        " kg/(m3 s), takes " + shown(share) + " of a ball's speed in a step of " +
                        shown(limits.timestep) + " s, expected at most " + shown(largest_drag_step) +
                        ": lower dem.rayleigh_fraction (now " + shown(limits.rayleigh_fraction) + ") to " +
                        shown(limits.rayleigh_fraction * largest_drag_step / share) +
                        " at most, and run the mill and the flow again");
}

FluidSettings require_fluid_of(const std::filesystem::path& file, FluidTime time, const meshing::Mill& mill,
                               const DemPlan& plan) {
  const averaging::SlurryReader reader(file);
  require_mill(reader, mill);
  require_cover(reader, mill.geometry);
  const ShapeDrag shapes = shape_drag_of(mill);
  const DragLimits limits{
      reader.header().polydispersity, smallest_simulated(mill), mill.ball.density, plan.step.value,
      mill.dem.rayleigh_fraction,     shapes.largest_factor()};
  const std::string source = reader.path().string();
  if (time == FluidTime::mean) {
    require_slow_drag(reader.mean(), reader.grid(), limits, source);
  } else {
    require_windows(reader);
    for (std::size_t window = 0; window < reader.header().windows; ++window)
      require_slow_drag(reader.window(window), reader.grid(), limits, source);
  }
  FluidSettings fluid;
  fluid.kind = FluidKind::slurry;
  fluid.file = std::filesystem::absolute(file);
  fluid.file_id = file_fingerprint(file);
  fluid.time = time;
  fluid.shapes = shapes;
  return fluid;
}

void require_windows_in_run(const FluidSettings& fluid, const DemPlan& plan) {
  if (fluid.kind != FluidKind::slurry || fluid.time != FluidTime::windows) return;
  const auto [first, last] = averaging::SlurryReader(fluid.file).span();
  const double begin = plan.begin_time(), end = begin + plan.duration();
  if (first < end && last > begin) return;
  throw SlurryFileError(fluid.file.string() + ": the time windows are from " + shown(first) + " to " +
                        shown(last) + " s of DEM time, and the run is from " + shown(begin) + " to " +
                        shown(end) + " s; expected windows in this time, or --fluid-time mean");
}

}  // namespace millfoam::dem_driver
