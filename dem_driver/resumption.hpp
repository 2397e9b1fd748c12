// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/continued_run.hpp"
#include "dem_driver/dem_plan.hpp"

namespace millfoam::dem_driver {

/// The step at which a run of this same deck resumes: that of its last complete restart file, or the last
/// step of a complete run, which needs no restart file unless it is made longer. Nothing where the folder has
/// neither a complete run nor a restart file of an interrupted one.
/// @param folder  of the case
/// @param plan  of the run that resumes
/// @param deck  of the run that resumes; numbers of ranks and the length may differ from those of the
/// folder's
/// @param out  gets a sentence about a restart file that is not used
/// Throws meshing::KeyError for a plan that is shorter than the run, and std::runtime_error naming the file
/// and what was expected for another run, for lost dumps, and without a usable restart file for a complete
/// run that is to be made longer and for an interrupted one that has restart files. So only a run that was
/// killed before its first restart file is removed.
std::optional<long> resumable(const CaseFolder& folder, const DemPlan& plan, const std::string& deck,
                              std::ostream& out);

/// Throws std::runtime_error when the folder has files of a run with another deck, or a complete run without
/// one: a deck that is written alone, without a run, would give these files another identity. Returns whether
/// the folder has files of a run.
bool require_deck_of_run(const CaseFolder& folder, const std::string& deck);

/// Prepares the folder for a deck that is written alone, to be run by hand.
/// @param folder  of the case; its folder `dem` must exist
/// @param deck  that will be written
/// @param state  with whose restart file the deck begins, which is put into `dem`; nothing: with none
/// Throws as require_deck_of_run and take_restart.
void prepare_deck_alone(const CaseFolder& folder, const std::string& deck,
                        const std::optional<LastState>& state);

}  // namespace millfoam::dem_driver
