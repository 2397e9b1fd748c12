// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "dem_driver/charge_plan.hpp"
#include "dem_driver/time_step.hpp"
#include "meshing/mill.hpp"

namespace millfoam::dem_driver {

/// Everything that is decided before the deck is written: the numbers that deck, progress and summary agree
/// on.
struct DemPlan {
  TimeStep step;
  ChargePlan charge;
  long round_steps = 0;     ///< settling after each round but the last
  long settle_steps = 0;    ///< settling after the last round, mill at rest
  long turning_steps = 0;   ///< from DEM time 0 on, a whole number of records
  long dumps = 0;           ///< of the turning mill, with the one at step 0
  long thermo_steps = 0;    ///< between two lines of LIGGGHTS' log
  long insertions() const;  ///< single insertions of all rounds; each takes one step
  long total_steps() const;
};

/// Chooses the time-step and cuts charge and duration into whole balls and steps. The duration is rounded up
/// to a whole number of record intervals. Throws std::runtime_error as `choose_time_step` and `plan_charge`
/// do.
DemPlan plan_dem(const meshing::Mill& mill);

/// Ranks along x, y and z: the product is `ranks`, x gets the larger factor and the axis is never cut,
/// because the charge fills it evenly and a slice is short. Throws std::runtime_error for ranks < 1.
struct RankGrid {
  int x = 1;
  int y = 1;
};
RankGrid split_ranks(int ranks);

/// Words that begin the deck's own lines in the log; `LiggghtsLog` reads them.
inline constexpr char inserted_mark[] = "millFoam inserted";
inline constexpr char turning_mark[] = "millFoam turning";
inline constexpr char finished_mark[] = "millFoam finished";

/// Writes the LIGGGHTS 3.8 input deck. LIGGGHTS runs in DIR/dem; the deck refers to `../walls/<part>.stl` for
/// each of `parts` and dumps to `../dumps/dump.<step>.txt`. Balls are atom type 1, walls type 2. Throws
/// std::runtime_error for a modulus below what LIGGGHTS accepts (5e6 Pa).
void write_deck(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan,
                const std::vector<std::string>& parts, int ranks);

}  // namespace millfoam::dem_driver
