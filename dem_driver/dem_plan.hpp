// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem_driver/charge_plan.hpp"
#include "dem_driver/fluid_settings.hpp"
#include "dem_driver/time_step.hpp"
#include "meshing/mill/mill.hpp"

/// The dry run of a mill: `mill.yaml` becomes a time-step, whole balls and an input deck; LIGGGHTS runs it;
/// its files are checked and become results. Units are SI. "DEM time 0" is the moment at which the mill
/// begins to turn.
namespace millfoam::dem_driver {

/// Everything that is decided before the deck is written: the numbers that deck, progress and summary agree
/// on.
struct DemPlan {
  TimeStep step;           ///< chosen by choose_time_step
  ChargePlan charge;       ///< made by plan_charge
  long round_steps = 0;    ///< settling after each round but the last
  long settle_steps = 0;   ///< settling after the last round, mill at rest
  long begin = 0;          ///< step of the turning mill at which this run begins; 0: from a settled charge
  long turning_steps = 0;  ///< from `begin` on, a whole number of records
  long records = 0;        ///< of the turning mill, with the one at step `begin`
  long dumps = 0;          ///< one for each record; 0: they are not written
  long thermo_steps = 0;   ///< between two lines of LIGGGHTS' log
  long contact_steps = 0;  ///< between two dumps of the contacts; 0: they are not dumped
  long contact_dumps = 0;  ///< of the turning mill, with the one at step `begin`, if it has one
  long restart_steps = 0;  ///< between two restart files of the turning mill, a whole number of records
  FluidSettings fluid;     ///< that pushes the balls
  bool watches_contacts = false;  ///< whether every contact is followed in every step
  /// Of the averages that are made while the mill turns: their `averages_id`.
  std::vector<std::string> averages = {};
  double averages_bytes = 0;                    ///< that the windows of these averages need on the disk
  bool continues() const { return begin > 0; }  ///< from the last state of another run
  long end_step() const { return begin + turning_steps; }  ///< last step of the turning mill
  long insertions() const;     ///< single insertions of all rounds; each takes one step
  long resting_steps() const;  ///< of insertions and settling together; 0 of a run that continues another
  long total_steps() const;    ///< of insertions, settling and turning mill together
  /// Between two records whose overlaps are counted: five to ten records, so that whole parts of this length
  /// fill the time between two restart files; where none does, the shortest part of more records. The whole
  /// time between two restart files where that is fewer than five records.
  long overlap_steps() const;
  double begin_time() const;  ///< DEM time at `begin`, s
  double duration() const;    ///< s of turning mill, from `begin` on
};

/// Most steps of the turning mill, and most of the settling one; a run of more is refused, because it would
/// never end.
inline constexpr double most_steps = 1e9;
/// Most dumps of the balls, and most of the contacts; a run of more is refused, because it would fill any
/// disk.
inline constexpr double most_dumps = 1e6;

/// Chooses the time-step and cuts charge and duration into whole balls and steps. The duration is rounded up
/// to a whole number of record intervals, and the interval of the contacts to the nearest whole number of
/// steps. Throws meshing::KeyError as `choose_time_step` and `plan_charge` do, for an interval of the
/// contacts below the time-step, and for more than `most_steps` or `most_dumps`.
DemPlan plan_dem(const meshing::Mill& mill);

/// Lets a plan begin with a step of the turning mill, with all balls in it, instead of with an insertion: its
/// dumps and its time continue from there, over the plan's duration.
void continue_from(long step, DemPlan& plan);

/// Lets the balls feel a flow that runs at the same time and meets them in `folder`: a restart file is
/// written whenever the flow's fields are, so that both can resume at the same time. Throws meshing::KeyError
/// where flow.write_interval is not a whole number of dem.record_interval.
void meet_flow(const std::filesystem::path& folder, const meshing::Mill& mill, DemPlan& plan);

/// Number of dumps of the contacts from the run's begin to a step.
long contact_dumps_until(const DemPlan& plan, long step);

}  // namespace millfoam::dem_driver
