// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "dem_driver/dem_plan.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

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
