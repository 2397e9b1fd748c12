// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/dem_plan.hpp"

namespace millfoam::dem_driver {

/// A kind of segment with a row of numbers for each record, or with a histogram for each part of the run.
struct RowKind {
  std::string name;                  ///< of its files, `dem/<name>.<step>.txt`
  std::vector<std::size_t> numbers;  ///< that a row may have, with its step
  bool at_begin = false;             ///< whether the step at which a segment begins has a row, too
  long bins = 0;                     ///< of the histogram that follows each row; 0: none
  /// Whether its rows are the first lines of histograms.
  bool is_histogram() const { return bins > 0; }
};

/// What LIGGGHTS and millLiggghts write of the records of this run: torque and energy, the part torques where
/// the folder has such segments, the fluid, and the histograms of the overlaps.
std::vector<RowKind> row_kinds(const CaseFolder& folder, const DemPlan& plan);

/// Reads the rows of one segment as it grows. On a full disk, LIGGGHTS leaves rows out or cuts them, and
/// continues.
class RowCheck {
 public:
  /// Begins with the first line.
  /// @param folder  of the case
  /// @param kind  of the segment
  /// @param begin  step at which the segment begins
  /// @param record  steps between two rows of a kind without histograms
  RowCheck(const CaseFolder& folder, RowKind kind, long begin, long record);

  /// What is wrong with the file's rows up to `step`, "18230 bytes: line 289 is …", without the file's name;
  /// empty when there is one whole row for each record. Histograms must be whole, but any may be missing.
  /// Reads what follows the rows that earlier calls have found whole.
  std::string complaint(long step);

  /// The segment.
  const std::filesystem::path& file() const { return file_; }
  /// Bytes of the file that hold what the calls have found whole, with comments.
  std::uintmax_t whole_bytes() const { return whole_bytes_; }

 private:
  std::string fault(long step);

  RowKind kind_;
  std::filesystem::path file_;
  long record_;
  long next_;  ///< step of the next row
  long line_ = 0;
  std::uintmax_t whole_bytes_ = 0;
};

/// What is wrong with the rows of all segments from the run's begin up to `step`: "file: 18230 bytes: line
/// 289 is …"; empty when all are whole.
std::string rows_complaint(const CaseFolder& folder, const DemPlan& plan, long step);

/// Cuts what the segments have after `step`, up to which their rows are whole: it belongs to a run that was
/// killed or stopped after its last restart file.
void cut_rows_after(const CaseFolder& folder, const DemPlan& plan, long step);

}  // namespace millfoam::dem_driver
