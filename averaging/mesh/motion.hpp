// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

namespace millfoam::averaging {

/// A value given at rising times; between them it is linear. Outside them: std::out_of_range with the time.
struct TimeTable {
  std::vector<double> times;   ///< s
  std::vector<double> values;  ///< [times]
};

/// A rigid motion of a body.
class Motion {
 public:
  virtual ~Motion() = default;

  /// The body's place at a DEM time, s: maps a point of the body, m, to where it is then. The places of two
  /// times together say how the body moves between them; what the body's points are numbered by is up to the
  /// caller.
  virtual Eigen::Isometry3d place(double time) const = 0;
};

/// One of, or a composition of, the motions that a user can name; each text is one motion, and the first one
/// is applied first:
///
///     rotation speed W [axis X Y Z] [origin X Y Z]          rad/s, right-handed; axis z, origin 0 unless
///     given rotation table FILE [axis X Y Z] [origin X Y Z]       lines "time angular-velocity", s and rad/s
///     translation velocity X Y Z                            m/s
///     translation table FILE                                lines "time x y z", s and m
///
/// Throws std::invalid_argument naming the text or "file:line", the word and what was expected. An empty list
/// is rest.
std::shared_ptr<const Motion> parse_motion(const std::vector<std::string>& texts);

}  // namespace millfoam::averaging
