// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/dem_plan.hpp"

namespace millfoam::dem_driver {

/// A file of `dem/`, `dumps/` or `contacts/` whose name carries the step at which it was written or begun.
struct NumberedFile {
  long step = 0;               ///< of the turning mill, from DEM time 0
  std::filesystem::path file;  ///< with its folder
};

/// What a run writes in segments: every resumed run begins its own files.
inline constexpr const char* segment_kinds[] = {"torque",      "partTorques",  "energy",
                                                "fluid",       "ballOverlaps", "wallOverlaps",
                                                "contactWork", "contactBins",  "wallCells"};

/// Every `dem/<kind>.<step>.txt`, by step.
std::vector<NumberedFile> find_segments(const CaseFolder& folder, const std::string& kind);

/// Kinds of files of the contacts: those of two balls, those of balls and walls, and the balls themselves.
inline constexpr const char* contact_kinds[] = {"pairs", "walls", "balls"};

/// Every `contacts/<kind>.<step>.txt`, by step.
std::vector<NumberedFile> find_contacts(const CaseFolder& folder, const std::string& kind);

/// What is wrong with the contacts of the run's steps up to `step`: "folder: 3 pairs up to step 50, expected
/// 6"; empty when all contacts of the plan are there.
std::string contacts_complaint(const CaseFolder& folder, const DemPlan& plan, long step);

/// Every complete restart file, `dem/restart.<step>`, by step.
std::vector<NumberedFile> find_restarts(const CaseFolder& folder);

/// The numbers of a line; nothing when a word is none.
std::optional<std::vector<double>> numbers_of(const std::string& line);

/// A line of numbers of a segment and its place.
struct SegmentLine {
  std::vector<double> values;  ///< at least one
  std::filesystem::path file;  ///< with its folder
  long line = 0;               ///< of that file, from 1
};

/// The lines of all segments of a kind without comments, as one run has written them: what a segment wrote
/// after the step at which the next one begins was lost with the run that was killed, and is left out; so
/// is a half line at the end of a segment. A line of a record begins with its step; lines that continue a
/// record (`continued` of them after each line) follow it. Throws std::runtime_error naming file and line for
/// one that is not all numbers.
std::vector<SegmentLine> read_segments(const CaseFolder& folder, const std::string& kind, long continued = 0);

/// Every `dumps/dump.<step>.txt`, by step.
std::vector<NumberedFile> find_numbered_dumps(const CaseFolder& folder);

/// Number of dumps of steps up to `step`.
long count_dumps_until(const CaseFolder& folder, long step);

/// Removes dumps and contacts later than `step`: they belong to a run that was killed after its last restart
/// file.
void remove_dumps_after(const CaseFolder& folder, long step);

/// Every file of averages of the run under way, `dem/averages_*`: their states and finished windows.
std::vector<std::filesystem::path> find_averages(const CaseFolder& folder);

/// Removes `dem/contactState.<step>.txt`, which belongs to the restart file of that step, of chosen steps.
void remove_contact_states(const CaseFolder& folder, const std::function<bool(long)>& chosen);

/// Removes the restart files of steps before `step`, with what belongs to them.
void remove_restarts_before(const CaseFolder& folder, long step);

/// Removes the restart files of steps after `step`, with what belongs to them, and histories that begin after
/// it: they cannot be resumed from.
void remove_restarts_after(const CaseFolder& folder, long step);

}  // namespace millfoam::dem_driver
