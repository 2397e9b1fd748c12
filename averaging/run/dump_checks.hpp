// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "averaging/dumps/dump_header.hpp"
#include "averaging/dumps/dump_series.hpp"
#include "averaging/grids/grid.hpp"
#include "averaging/run/average_request.hpp"

namespace millfoam::averaging {

/// Compares the numbers of balls in the headers of dumps that are averaged. `note` gets a warning with the
/// first dump whose number is not that of the one before. Throws DumpError for a dump without balls between
/// such that have some.
/// @param dumps  in order of time
/// @param first  number of the first dump that is averaged
/// @param end  number after the last one
/// @param note  takes a sentence
void check_numbers_of_balls(const std::vector<DumpFile>& dumps, std::size_t first, std::size_t end,
                            const std::function<void(const std::string&)>& note);

/// Smallest change of the balls' volume from one dump to the next, with as many balls, that is noted.
inline constexpr double noted_volume_change = 0.01;
/// Largest ratio of such volumes: above it one of the dumps is in another unit, or of other balls.
inline constexpr double largest_volume_ratio = 2;

/// Compares the balls' volume in dumps that have as many balls as the one before. Feeds and wear change it a
/// little: that is noted, for the first such dump.
class VolumeCheck {
 public:
  /// @param dumps  in order of time; must outlive this object
  /// @param note  takes a sentence; must outlive this object
  VolumeCheck(const std::vector<DumpFile>& dumps, const std::function<void(const std::string&)>& note)
      : dumps_(dumps), note_(note) {}

  /// The next dump: in order of time, but some may be left out. Throws DumpError that names it where its
  /// volume is more than `largest_volume_ratio` times that of the one before, or less than its inverse.
  /// @param number  of the dump, from 0
  /// @param volume  of its balls, m^3
  void add(std::size_t number, double volume);

 private:
  const std::vector<DumpFile>& dumps_;
  const std::function<void(const std::string&)>& note_;
  std::optional<std::size_t> before_;  ///< number of the last dump added
  double volume_before_ = 0;           ///< m^3
  bool noted_ = false;
};

/// Throws std::invalid_argument for a grid or mesh that repeats after another length than the balls do, or
/// along an axis along which the flags of their box say that they do not. Without flags that is not known.
/// @param request  of the averages
/// @param box  of the dumps, or of the run that makes the balls
/// @param name  of the dump or the run, for the message
void require_period_of(const AverageRequest& request, const DumpBox& box, const std::string& name);

/// The warning that balls lie outside a grid that spans the dumps' period and does not repeat; empty where it
/// repeats, or spans another length, and where no volume is outside.
/// @param request  of the averages
/// @param grid  of the averages
/// @param box  of the dumps
/// @param outside  largest share of the balls' volume outside the grid, of any window
std::string missing_period(const AverageRequest& request, const Grid& grid, const DumpBox& box,
                           double outside);

}  // namespace millfoam::averaging
