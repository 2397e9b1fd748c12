// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>

#include "dem_driver/dem_plan.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// What a dry run costs on this machine.
struct Cost {
  double rate = 0;      ///< balls moved by one step, per second
  double dump = 0;      ///< bytes per ball of one dump
  double memory = 0;    ///< bytes of one rank, without those of the balls beyond the trial's
  double contacts = 0;  ///< bytes per ball of one dump of the contacts
};

/// What a dry run will take.
struct Forecast {
  long steps = 0;        ///< of insertions, settling and turning mill together
  double wall_time = 0;  ///< s
  double disk = 0;       ///< bytes of dumps, contacts, restart file and histories
  double memory = 0;     ///< bytes of all ranks
};

/// Balls of a trial mill, where the mill has so many.
inline constexpr double trial_balls = 3000;

/// Of these in a stirred mill, where not all balls are spheres: a step of a ball takes 10 to 100 times as
/// long.
inline constexpr double trial_shaped_balls = 1000;

/// A short periodic slice of the mill with about that many balls, long enough to be split as the mill is,
/// soft and quickly settled: it costs as much per ball and step as the whole mill. Each size class keeps one
/// ball at least. Of a stirred mill, the whole mill; where not all balls are spheres, the mill smaller in all
/// lengths, with the same speed of the tips. Throws meshing::KeyError as plan_dem does.
meshing::Mill trial_mill(const meshing::Mill& mill, int ranks);

/// Runs the trial mill in a temporary folder and measures it, in about half a minute; blunt superquadrics
/// take longer. Throws RunError as run_liggghts does; only then the folder stays, with the log that the
/// message names.
Cost measure_cost(const meshing::Mill& mill, int ranks);

/// Steps times balls at that rate, insertion round by round, and what is written.
Forecast forecast(const DemPlan& plan, const Cost& cost, int ranks);

/// Prints it in words.
void print_forecast(std::ostream& out, const Forecast& forecast, const Cost& cost, int ranks);

}  // namespace millfoam::dem_driver
