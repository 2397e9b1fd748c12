// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/dem_plan.hpp"
#include "dem_driver/record_rows.hpp"

namespace millfoam::dem_driver {

/// A number of entries that is not known before, such as the contacts in a dump.
inline constexpr long any_number = -1;

/// What is wrong with a dump of LIGGGHTS: "0 bytes, expected …"; empty when it is complete. A complete one
/// announces `entries` lines (or `any_number`), has them all, and ends with a line end.
std::string dump_complaint(const std::filesystem::path& file, long entries);

/// What is wrong with a restart file of LIGGGHTS; empty when it is complete. At its end it has one block for
/// each rank: a count n (int) and n numbers (double), which are the records of the rank's balls, each begun
/// by its own length (write_restart.cpp of LIGGGHTS-PUBLIC 3.8). A complete file has records of `balls` balls
/// up to its last byte.
std::string restart_complaint(const std::filesystem::path& file, long balls);

/// Step of the last restart file that is complete, as are the averages of the run at that step, all dumps of
/// the part of the run that ends with it, and all rows of torque, energy and what row_kinds has; nothing when
/// there is none. The dumps of earlier parts were checked before their restart files were removed.
std::optional<long> last_good_restart(const CaseFolder& folder, const DemPlan& plan);

/// Checks the files that LIGGGHTS writes while it runs, because LIGGGHTS itself does not: on a full disk it
/// continues and leaves files empty or cut short.
class OutputCheck {
 public:
  /// Of a run that begins with step `start`. Folder and plan must outlive this object.
  OutputCheck(const CaseFolder& folder, const DemPlan& plan, long start);

  /// Dumps, of contacts too, of all steps up to `step` that were not yet checked. Throws RunError that names
  /// the first that is not complete, the free room on the disk, and the step from which --resume resumes.
  /// Dumps that are not there are counted at the end.
  void dumps_until(long step);

  /// The restart file of a step, after the dumps up to it, and the rows up to it that were not yet checked.
  /// Throws RunError as above.
  void restart(long step);

 private:
  const CaseFolder& folder_;
  const DemPlan& plan_;
  long start_;
  long next_dump_;
  long next_contacts_ = 0;
  std::vector<RowCheck> rows_;  ///< of the segments that the run writes
};

}  // namespace millfoam::dem_driver
