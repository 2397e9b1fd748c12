// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "averaging/values/solids_window.hpp"

namespace millfoam::averaging {

/// Windows that cannot be cut; the message names the times.
class WindowError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The request for the division of a run into windows. Times are rounded to whole time-steps.
struct WindowRequest {
  double timestep = 0;                ///< of the DEM run, s
  std::optional<long long> interval;  ///< time-steps between records; unless known, the median between two
  std::optional<double> length;       ///< s; unless given, one window over the whole run
  std::optional<double> start;        ///< DEM time, s; unless given, that of the first record
  std::optional<double> end;          ///< DEM time, s, not included; unless given, all records are used
  bool up_to_end = false;             ///< refuse records that end before `end`
};

/// One window [begin, end) in time-steps and the records in it, as numbers into the list of records.
struct WindowSpan {
  long long begin = 0;           ///< time-step
  long long end = 0;             ///< time-step, not included
  std::size_t first_record = 0;  ///< its number, from 0
  std::size_t records = 0;       ///< how many from there on
  bool starts_late = false;      ///< a record or more is missing at its beginning
  bool ends_short = false;       ///< or at its requested end
  std::size_t expected = 0;      ///< how many records would fill it, at least 1
};

/// A time in whole time-steps. Throws WindowError that names it as `what` where it cannot be counted.
/// @param time  s
/// @param timestep  of the DEM run, s
/// @param what  name of the time, for the message
long long whole_steps(double time, double timestep, const char* what);

/// The times and marks of a window; its number of records is left 0.
/// @param span  of the window
/// @param timestep  of the DEM run, s
TimeWindow time_of(const WindowSpan& span, double timestep);

/// A run cut into windows.
struct WindowPlan {
  std::vector<WindowSpan> windows;  ///< in order of time, at least one
  std::vector<std::string> notes;   ///< about records left out, windows not full or too full
};

/// Cuts records into the windows [start + w T, start + (w+1) T) by whole time-steps, so that no record
/// changes window by rounding of times.
///
/// A window that the records do not fill is kept, marked, with a note; so is one with more records than fit.
/// Only a last one that holds nothing but the record at its very beginning is left out, with a note: that
/// record closes the window before. The last window and a whole run end at most one record interval after
/// their last record, since each record stands for one interval: no time is claimed that was not recorded.
/// Records that end before the requested end have a note, or are refused (`up_to_end`).
///
/// @param steps  time-steps of the records, rising
/// @param request  length, start and end
///
/// Throws WindowError for a length shorter than the record interval, times that are not finite or an end that
/// is not after the start, no record in the range, or a window without a record.
WindowPlan plan_windows(const std::vector<long long>& steps, const WindowRequest& request);

}  // namespace millfoam::averaging
