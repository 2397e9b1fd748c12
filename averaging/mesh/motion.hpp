// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

namespace millfoam::averaging {

/// A value given at two or more rising times; between them it is linear.
struct TimeTable {
  std::vector<double> times;   ///< s
  std::vector<double> values;  ///< [times]
  std::string file = {};       ///< of which it was read, for messages
};

/// The value at a time, s. Throws std::out_of_range, naming the file and the time, outside the table.
double value_at(const TimeTable& table, double time);

/// The exact integral of the value from the first time to `time`. Throws as `value_at`.
double integral_to(const TimeTable& table, double time);

/// A rigid motion of a body.
class Motion {
 public:
  virtual ~Motion() = default;

  /// The body's place at a DEM time, s: maps a point of the body, m, to where it is then. The places of two
  /// times together say how the body moves between them; what the body's points are numbered by is up to the
  /// caller. Throws std::out_of_range with the table's file and the time where the motion is not known.
  virtual Eigen::Isometry3d place(double time) const = 0;
};

/// One of, or a composition of, the motions that a user can name; each text is one motion, and the first one
/// is applied first:
///
///     rotation speed W [axis X Y Z] [origin X Y Z]     W in rad/s, right-handed about the axis
///     rotation table FILE [axis X Y Z] [origin X Y Z]  the file has lines "time W", s and rad/s
///     translation velocity X Y Z                       m/s
///     translation table FILE                           the file has lines "time x y z", s and m
///
/// The axis is z and the origin, a point on it in m, is 0 unless given. Values in a file are linear between
/// its lines, so the angle is a sum of parabolas; what follows a # in it is a comment.
///
/// Throws std::invalid_argument naming the text or "file:line", the word and what was expected. An empty list
/// is rest.
std::shared_ptr<const Motion> parse_motion(const std::vector<std::string>& texts);

}  // namespace millfoam::averaging
