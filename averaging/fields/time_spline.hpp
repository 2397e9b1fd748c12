// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace millfoam::averaging {

/// A time in a window: the numbers of this window and of those before and after it, and their shares in the
/// spline.
struct SplineMoment {
  std::array<std::size_t, 3> windows{};  ///< before, this, after; this one in place of one that is not there
  std::array<double, 3> shares{};        ///< each 0 or above; their sum is 1
};

/// A quadratic B-spline in time over windows that follow each other: between the windows a quantity changes
/// with a continuous derivative.
///
/// Its value is the sum of three coefficients, one for each window, with shares that are 0 or above. So
/// bounds on the coefficients are bounds on the values. With `coefficients` the mean of the spline over each
/// window is the window's mean, wherever the bounds allow it.
///
/// Before the first window there is one like it, and after the last one, unless the windows repeat.
class TimeSpline {
 public:
  /// @param lengths  of the windows, s, each above 0. Throws std::invalid_argument for others, or for none.
  /// @param repeats  whether the first window follows the last
  TimeSpline(std::vector<double> lengths, bool repeats);

  std::size_t size() const { return lengths_.size(); }  ///< number of windows

  /// @param window  its number
  /// @param share   of it that has passed, 0 to 1
  SplineMoment at(std::size_t window, double share) const;

  /// Coefficients between 0 and `largest` for which the mean of the spline over each window is the window's
  /// mean; where a bound does not allow it, the mean is as near as it does: for windows of one length, the
  /// spline is the one of least energy. By Gauss-Seidel with projection on the bounds, to 1e-15.
  /// @param means    [size()] each 0 or above
  /// @param largest  upper bound; that of a window with a larger mean is this mean
  /// @return [size()]
  std::vector<double> coefficients(const std::vector<double>& means, double largest) const;

 private:
  std::size_t before(std::size_t window) const;
  std::size_t after(std::size_t window) const;
  /// Share of the window before at the begin of a window, and of the window after at its end.
  std::array<double, 2> outer_shares(std::size_t window) const;

  std::vector<double> lengths_;
  bool repeats_;
};

}  // namespace millfoam::averaging
