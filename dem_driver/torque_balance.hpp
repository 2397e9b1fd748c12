// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "dem_driver/fluid_forces.hpp"
#include "dem_driver/rank_group.hpp"

namespace millfoam::dem_driver {

/// Gives balls the torque about z that a flow has given them.
///
/// The flow sees the balls spread over voxels. Its force on all balls is their force, but it acts at other
/// places, so that the torque is another one. Each ball gets, in addition,
///
///     f = c w e_z x (x - x_0),    w = |pressure| + |drag|,    x_0 = sum(w x)/sum(w),
///
/// with one c for all, by which the torque of all balls becomes that of the flow. At the time of the meeting
/// the f add up to no force; until the next one, w follows the balls' motion. Like the forces that they
/// correct, they act on balls in slurry, and hardly on balls in air.
///
/// c is limited: at the distance r from x_0 that is the root mean square of all balls (with the weights w), f
/// is at most `largest_share` of w. Where r is below a quarter of a ball there is no addition: such balls, or
/// one alone, cannot take a torque. Then the balls' torque is not that of the flow; the ledgers of both show
/// it.
class TorqueBalance {
 public:
  /// Largest f over w, as above.
  static constexpr double largest_share = 0.5;

  /// No addition.
  TorqueBalance() = default;
  /// @param torque  of the flow on all balls about +z, N m
  /// @param balls   of this rank
  /// @param force   on a ball, without addition
  /// @param ball    diameter of the smallest ball, m
  /// @param ranks   on all of which this is called
  TorqueBalance(double torque, const std::vector<BallInFluid>& balls,
                const std::function<FluidForce(const BallInFluid&)>& force, double ball, RankGroup& ranks);

  /// The addition for a ball that feels this force, N.
  Vector on(const BallInFluid& ball, const FluidForce& force) const;

 private:
  std::array<double, 2> centre_ = {};  ///< x and y of x_0, m
  double factor_ = 0;                  ///< c, 1/m
};

}  // namespace millfoam::dem_driver
