// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <iosfwd>
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
  long overlap_steps() const;  ///< between two records whose overlaps are counted
  double begin_time() const;   ///< DEM time at `begin`, s
  double duration() const;     ///< s of turning mill, from `begin` on
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
/// written whenever the flow's fields are, so that both can resume at the same time. The interval of the flow
/// must be a whole number of records; else the nearest number is taken.
void meet_flow(const std::filesystem::path& folder, const meshing::Mill& mill, DemPlan& plan);

/// The number of ranks that the word after `-np` is. Throws std::runtime_error for one that is not a whole
/// number from 1 on.
int read_ranks(const std::string& word);

/// How the box of the mill is cut into equal parts, one for each rank; x y z is the number of ranks.
struct RankGrid {
  int x = 1;  ///< parts along x, not more than along y
  int y = 1;  ///< parts along y
  int z = 1;  ///< parts along the axis
};

/// Splits ranks over a mill. The axis is cut first, because the charge lies evenly along it: into as many
/// parts as divide the number of ranks and are no thinner than one and a half of the largest balls. What is
/// left is cut across y, then x.
/// @param ranks  from 1 on
/// @param length  of the mill along its axis, m
/// @param largest_diameter  of the balls, m
RankGrid split_ranks(int ranks, double length, double largest_diameter);

/// The same of a stirred mill, whose balls lie at the base: across y, then x.
RankGrid split_ranks_across(int ranks);

/// Words that begin the deck's own lines in the log, which `LiggghtsLog` reads. This one follows every
/// insertion: `… ASKED of DIAMETER total BALLS`, with the diameter in m and all balls then in the mill.
inline constexpr char inserted_mark[] = "millFoam inserted";
/// Begins the line that LIGGGHTS prints at DEM time 0, or where a resumed run begins.
inline constexpr char turning_mark[] = "millFoam turning";
/// Begins the line that follows every complete restart file: `… STEP`.
inline constexpr char restart_mark[] = "millFoam restart";
/// Begins the last line of a deck that came to its end.
inline constexpr char finished_mark[] = "millFoam finished";

/// Name of the deck's fix through which the fluid pushes the balls of the turning mill, and of that for balls
/// that are inserted and settle. Only millLiggghts gives them forces.
inline constexpr char fluid_fix[] = "fluid";
/// See `fluid_fix`.
inline constexpr char fluid_at_rest_fix[] = "fluidAtRest";

/// The deck's contact model when every contact is followed: only millLiggghts knows this surface model, which
/// computes the same forces as the default one.
inline constexpr char watched_surface_model[] = "watched";
/// Command of the deck that millLiggghts carries out itself: from here on it follows the contacts.
inline constexpr char watch_command[] = "watch_contacts";
/// Name of the deck's fix through which the balls' averages are made. Only millLiggghts makes them.
inline constexpr char averages_fix[] = "averages";

/// Wall of a stirred mill that turns.
inline constexpr char impeller_part[] = "impeller";
/// The walls that turn: all of a tumbling mill's; of a stirred mill's the impeller alone.
std::vector<std::string> turning_parts(const meshing::Mill& mill, const std::vector<std::string>& parts);
/// Name of the deck's fix that writes the torque on each wall of a stirred mill, and of its files.
inline constexpr char part_torques_kind[] = "partTorques";

/// Number of bins of the overlaps' histograms, of equal width from 0 on.
inline constexpr int overlap_bins = 1000;
/// Upper end of these histograms over the largest ball's diameter.
inline constexpr double overlap_range = 0.2;

/// Number of dumps of the contacts from the run's begin to a step.
long contact_dumps_until(const DemPlan& plan, long step);

/// Writes the LIGGGHTS 3.8 input deck. LIGGGHTS runs in DIR/dem; the deck refers to `../walls/<part>.stl` for
/// each of `parts`, dumps to `../dumps/dump.<step>.txt` unless the plan has none, and writes into its own
/// folder, from step 0 on, `torque.0.txt`, of a stirred mill also `partTorques.0.txt`, `energy.0.txt`,
/// `ballOverlaps.0.txt`, `wallOverlaps.0.txt` and `restart.<step>`; with contacts,
/// `../contacts/<kind>.<step>.txt` for each of `contact_kinds` (segments.hpp). Balls are the first atom
/// types, one for each modulus, the wall is the last. Of a plan that continues another run, it is the deck
/// that resumes from the restart file of `plan.begin`.
void write_deck(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan,
                const std::vector<std::string>& parts, int ranks);

/// Writes the deck that resumes from the restart file of `step`, which contains balls, turned walls and
/// contacts. Its own files have `step` in the place of 0.
void write_resume_deck(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan,
                       const std::vector<std::string>& parts, int ranks, long step);

}  // namespace millfoam::dem_driver
