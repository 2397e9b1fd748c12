// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_averages.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_charge.hpp"
#include "meshing/mill/mill_voxels.hpp"
#include "meshing/mill/rules.hpp"
#include "meshing/mill/stirred_averages.hpp"

namespace millfoam::meshing {
namespace {

/// Where mill.yaml leaves them open. Voxels of 2.5 Sauter diameters hold 18 balls of a dense charge; the drag
/// laws were derived on 8 to 64. Few balls fit across a small mill, whose curved wall voxels must still show.
constexpr double usual_voxel = 2.5;
constexpr double usual_voxels_of_radius = 4;

/// A number of records, as a time.
double whole_records(double time, const Mill& mill) {
  return std::max(1.0, std::round(time / mill.dem.record_interval)) * mill.dem.record_interval;
}

/// The averages' length of windows; of a whole run it follows from the start.
void read_window(const Section& in, const Mill& mill, Averages& averages) {
  averages.whole_run = averages.rings && (!in.has("window") || in.is("window", "whole"));
  if (averages.whole_run) {
    in.choice("window", {"whole"}, "whole");
    return;
  }
  const double duration = mill.dem.duration, shortest = mill.dem.record_interval;
  averages.window = in.number("window",
                              {(averages.rings ? "'whole', or a time" : "a time") +
                                   std::string(" in s of at least dem.record_interval, ") + shown(shortest) +
                                   " s, and not above dem.duration, " + shown(duration) + " s",
                               [=](double v) { return v >= shortest * (1 - 1e-9) && v <= duration; }},
                              std::min(whole_records(mill.turn() / windows_per_turn, mill), duration));
}

}  // namespace

Averages read_averages(const Section& root, const Mill& mill) {
  const bool stirred = mill.machine() == Machine::stirred;
  Section::Keys keys{"window", "start", "method", "template", "live"};
  const Section::Keys cells = stirred ? Section::Keys{"frame", "radial", "azimuthal", "axial"}
                                      : Section::Keys{"voxel_size", "counts"};
  keys.insert(keys.end(), cells.begin(), cells.end());
  Section in = root.optional_section("averages", keys);
  const ChargeNumbers charge = count_charge(mill);
  const double radius = mill.geometry.radius();
  const double many_balls = std::min(usual_voxel * charge.sauter_diameter, radius / usual_voxels_of_radius);
  const double usual_size = std::min(std::max(charge.largest_diameter, many_balls), radius);
  Averages averages;
  if (stirred)
    averages.rings = read_rings(in, mill.geometry, charge.largest_diameter);
  else
    averages.voxels = read_voxels(in, mill.geometry, usual_size, 0);
  read_window(in, mill, averages);
  const double duration = mill.dem.duration;
  const bool whole_run = averages.whole_run;
  const double room = whole_run ? duration : duration - averages.window;
  const Rule time = {
      "'steady', or a DEM time in s of 0 or more and " +
          (whole_run ? "below dem.duration, " + shown(duration)
                     : "at most dem.duration less averages.window, " + shown(std::max(room, 0.0))) +
          " s",
      [=](double v) { return v >= 0 && (whole_run ? v < room : v <= room + 1e-9 * duration); }};
  if (!in.has("start") || in.is("start", "steady"))
    in.choice("start", {"steady"}, "steady");
  else
    averages.start = in.number("start", time);
  averages.method = in.choice("method", {"exact", "sample"}, "exact");
  averages.template_points =
      in.integer("template",
                 {"a whole number of points from 2 to 100", [](double v) { return v >= 2 && v <= 100; }}, 12);
  averages.live = in.boolean("live", false);
  if (averages.whole_run) averages.window = duration - averages.start.value_or(0);
  if (averages.whole_run && averages.live && !averages.start)
    in.refuse("live",
              "false, or a time in s as averages.start: a window of the whole run cannot wait until the "
              "charge is steady");
  return averages;
}

}  // namespace millfoam::meshing
