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
/// bounds on the coefficients are bounds on the values.
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

  /// Coefficients for which the mean of the spline over each window is the window's mean. Where they would be
  /// below 0 or above `largest`, what the windows exchange for it is limited (Zalesak 1979, J. Comput. Phys.
  /// 31:335). These windows keep less of their means, but the mean of the spline over all windows is always
  /// theirs. The coefficient of a window with the mean 0 is 0.
  /// @param means    [size()] each 0 or above
  /// @param largest  upper bound; means above it are kept. The coefficient of a window that is longer than
  /// its
  ///                 neighbours may exceed it by the ratio of their lengths
  /// @return [size()]
  std::vector<double> coefficients(const std::vector<double>& means, double largest) const;

 private:
  std::size_t before(std::size_t window) const;
  std::size_t after(std::size_t window) const;
  /// Share of the window before at the begin of a window, and of the window after at its end.
  std::array<double, 2> outer_shares(std::size_t window) const;
  /// Integral in time of each coefficient's share, s; their sum is that of the lengths.
  std::vector<double> integrals() const;
  /// Coefficients without bounds.
  std::vector<double> unbounded(const std::vector<double>& means) const;

  std::vector<double> lengths_;
  bool repeats_;
};

}  // namespace millfoam::averaging
