// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/statistics/time_windows.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

namespace millfoam::averaging {

namespace {

std::string seconds(long long steps, double timestep) {
  std::ostringstream text;
  text << static_cast<double>(steps) * timestep << " s";
  return text.str();
}

/// The median of the numbers of steps between two records, which an odd dump or a gap does not change; 1 when
/// there is only one record.
long long usual_interval(const std::vector<long long>& steps) {
  if (steps.size() < 2) return 1;
  std::vector<long long> between;
  for (std::size_t r = 1; r < steps.size(); ++r) between.push_back(steps[r] - steps[r - 1]);
  const auto middle = between.begin() + static_cast<std::ptrdiff_t>((between.size() - 1) / 2);
  std::nth_element(between.begin(), middle, between.end());
  return *middle;
}

long long window_length(const WindowRequest& request, long long interval) {
  const long long length = whole_steps(*request.length, request.timestep, "the window's length");
  if (length >= interval) return length;
  std::ostringstream message;
  message << "the window's length " << *request.length << " s is less than the "
          << seconds(interval, request.timestep) << " between two records";
  throw WindowError(message.str());
}

/// Records used: all from `start` on and before `end`, in steps.
struct Range {
  long long start;
  long long end;
  std::size_t first;  ///< number of the first record
  std::size_t last;   ///< number of the record after the last
};

Range used_range(const std::vector<long long>& steps, const WindowRequest& request, long long interval) {
  const double dt = request.timestep;
  Range range{};
  range.start = request.start ? whole_steps(*request.start, dt, "the start") : steps.front();
  range.end = request.end ? whole_steps(*request.end, dt, "the end") : steps.back() + interval;
  range.first = static_cast<std::size_t>(
      std::distance(steps.begin(), std::lower_bound(steps.begin(), steps.end(), range.start)));
  range.last = static_cast<std::size_t>(
      std::distance(steps.begin(), std::lower_bound(steps.begin(), steps.end(), range.end)));
  if (request.end && range.end <= range.start) {
    throw WindowError("the end " + seconds(range.end, dt) + " is not after the start " +
                      seconds(range.start, dt));
  }
  if (range.first >= range.last) {
    throw WindowError("no record between " + seconds(range.start, dt) + " and " +
                      (request.end ? seconds(range.end, dt) : "the end") + "; they go from " +
                      seconds(steps.front(), dt) + " to " + seconds(steps.back(), dt));
  }
  return range;
}

/// Records after the last one are missing up to the requested end.
void check_end(const std::vector<long long>& steps, const Range& range, long long interval,
               const WindowRequest& request, WindowPlan& plan) {
  if (!request.end || steps.back() + interval >= range.end) return;
  const double dt = request.timestep;
  const std::string sentence = "the dumps end at " + seconds(steps.back(), dt) + ", " +
                               seconds(range.end - steps.back(), dt) + " before the end " +
                               seconds(range.end, dt);
  if (request.up_to_end)
    throw WindowError(sentence + ": expected those of the whole run, or --window, --start and --end");
  plan.notes.push_back("warning: " + sentence);
}

void note_unused(const std::vector<long long>& steps, const Range& range, WindowPlan& plan) {
  if (range.first > 0)
    plan.notes.push_back(std::to_string(range.first) + " records before the start are not used");
  if (range.last < steps.size()) {
    plan.notes.push_back(std::to_string(steps.size() - range.last) + " records from the end on are not used");
  }
}

void cut(const std::vector<long long>& steps, const Range& range, long long length, double timestep,
         WindowPlan& plan) {
  std::size_t record = range.first;
  for (long long begin = range.start; record < range.last; begin += length) {
    WindowSpan span{begin, begin + length, record, 0};
    while (record < range.last && steps[record] < span.end) ++record;
    span.records = record - span.first_record;
    if (span.records == 0) {
      throw WindowError("there is no record in the window from " + seconds(span.begin, timestep) + " to " +
                        seconds(span.end, timestep) + ": a gap in the dumps, or a wrong --start");
    }
    plan.windows.push_back(span);
  }
}

/// Leaves out a last window of which there is only the record at its beginning, unless that fills it.
void drop_closing_record(const std::vector<long long>& steps, long long interval, double timestep,
                         WindowPlan& plan) {
  const WindowSpan& last = plan.windows.back();
  const bool only_its_beginning = last.records == 1 && steps[last.first_record] == last.begin;
  if (plan.windows.size() < 2 || !only_its_beginning || last.end - last.begin <= interval) return;
  plan.notes.push_back("the record at " + seconds(last.begin, timestep) +
                       " lies exactly at the end of the last window: it is not used");
  plan.windows.pop_back();
}

/// How many records fill the windows, before the last one is shortened.
void expect_records(long long interval, WindowPlan& plan) {
  for (WindowSpan& span : plan.windows)
    span.expected = static_cast<std::size_t>(std::max(1LL, (span.end - span.begin) / interval));
}

/// Windows with fewer or more records than fit.
void note_odd_numbers(long long interval, double timestep, WindowPlan& plan) {
  for (std::size_t w = 0; w < plan.windows.size(); ++w) {
    const WindowSpan& span = plan.windows[w];
    const auto records = static_cast<long long>(span.records), full = static_cast<long long>(span.expected);
    const long long most = (span.end - span.begin + interval - 1) / interval;
    if (records >= full && records <= most) continue;
    std::string sentence = "warning: window " + std::to_string(w) + " from " + seconds(span.begin, timestep) +
                           " to " + seconds(span.end, timestep) + " holds " + std::to_string(records) +
                           " records, " + std::to_string(records < full ? full : most) + " would fill it";
    if (records > most)
      sentence +=
          ": those between records of every " + seconds(interval, timestep) + " count as fully as they";
    plan.notes.push_back(std::move(sentence));
  }
}

void mark_late_and_short(const std::vector<long long>& steps, long long interval, WindowPlan& plan) {
  for (WindowSpan& span : plan.windows) {
    span.starts_late = steps[span.first_record] - span.begin >= interval;
    span.ends_short = span.end - steps[span.first_record + span.records - 1] > interval;
  }
}

/// A window that is not full ends with its last record's interval: it has no time without records.
void end_with_the_dumps(const std::vector<long long>& steps, long long interval, WindowPlan& plan) {
  WindowSpan& last = plan.windows.back();
  last.end = std::min(last.end, steps[last.first_record + last.records - 1] + interval);
}

}  // namespace

long long whole_steps(double time, double timestep, const char* what) {
  constexpr double exactly_countable = 9e15;
  const double steps = std::round(time / timestep);
  if (!(std::abs(steps) < exactly_countable)) {
    std::ostringstream message;
    message << what << " is " << time << " s, expected a time that can be counted in steps of " << timestep
            << " s";
    throw WindowError(message.str());
  }
  return static_cast<long long>(steps);
}

TimeWindow time_of(const WindowSpan& span, double timestep) {
  TimeWindow time;
  time.begin = static_cast<double>(span.begin) * timestep;
  time.end = static_cast<double>(span.end) * timestep;
  time.starts_late = span.starts_late;
  time.ends_short = span.ends_short;
  time.expected = static_cast<long long>(span.expected);
  return time;
}

WindowPlan plan_windows(const std::vector<long long>& steps, const WindowRequest& request) {
  if (steps.empty()) throw WindowError("there are no records");
  assert(request.timestep > 0);
  const long long interval = request.interval.value_or(usual_interval(steps));
  const Range range = used_range(steps, request, interval);
  const long long length = request.length ? window_length(request, interval) : range.end - range.start;

  WindowPlan plan;
  check_end(steps, range, interval, request, plan);
  note_unused(steps, range, plan);
  cut(steps, range, length, request.timestep, plan);
  drop_closing_record(steps, interval, request.timestep, plan);
  expect_records(interval, plan);
  note_odd_numbers(interval, request.timestep, plan);
  mark_late_and_short(steps, interval, plan);
  end_with_the_dumps(steps, interval, plan);
  return plan;
}

}  // namespace millfoam::averaging
