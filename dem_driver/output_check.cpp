// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/output_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "averaging/run/live_averages.hpp"
#include "dem_driver/averages_order.hpp"
#include "dem_driver/contact_record.hpp"
#include "dem_driver/disk_room.hpp"
#include "dem_driver/liggghts_log.hpp"
#include "dem_driver/segments.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

constexpr long header_lines = 9;
constexpr int count_line = 3;              // of the header, from 0: how many entries follow
constexpr double fewest_ball_numbers = 8;  // of a record in a restart file: its length, place, number, …

std::string contents_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// The entries that the header announces; -1 where it is cut short.
long announced(const std::string& text) {
  std::size_t begin = 0;
  for (int line = 0; line < count_line; ++line) {
    begin = text.find('\n', begin);
    if (begin == std::string::npos) return -1;
    ++begin;
  }
  return text.find('\n', begin) == std::string::npos ? -1 : std::atol(text.c_str() + begin);
}

template <typename Number>
Number number_at(const std::string& bytes, std::size_t at) {
  Number number{};
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

/// Balls in the records from `at` to `end`; nothing when they do not fill it.
std::optional<long> count_records(const std::string& bytes, std::size_t at, std::size_t end) {
  long balls = 0;
  for (; at < end; ++balls) {
    const auto length = number_at<double>(bytes, at);
    const double most = static_cast<double>(end - at) / sizeof(double);
    if (!(length >= fewest_ball_numbers && length <= most) || length != std::floor(length))
      return std::nullopt;
    at += static_cast<std::size_t>(length) * sizeof(double);
  }
  return balls;
}

/// Balls in the blocks from `at` to the end of the file; nothing when what is there are no blocks.
std::optional<long> count_blocks(const std::string& bytes, std::size_t at) {
  long balls = 0;
  while (at < bytes.size()) {
    if (bytes.size() - at < sizeof(std::int32_t)) return std::nullopt;
    const auto numbers = number_at<std::int32_t>(bytes, at);
    at += sizeof numbers;
    if (numbers < 0 || static_cast<std::size_t>(numbers) > (bytes.size() - at) / sizeof(double))
      return std::nullopt;
    const std::size_t end = at + static_cast<std::size_t>(numbers) * sizeof(double);
    const auto records = count_records(bytes, at, end);
    if (!records) return std::nullopt;
    balls += *records;
    at = end;
  }
  return balls;
}

/// Whether all dumps of steps from `begin` to `end` are complete, of contacts too.
bool whole_part(const CaseFolder& folder, const DemPlan& plan, long begin, long end) {
  const auto is_whole = [&](const NumberedFile& dump, long balls) {
    return dump.step < begin || dump.step > end || dump_complaint(dump.file, balls).empty();
  };
  for (const auto& dump : find_numbered_dumps(folder))
    if (!is_whole(dump, plan.charge.balls())) return false;
  for (const char* kind : contact_kinds)
    for (const auto& contacts : find_contacts(folder, kind))
      if (!is_whole(contacts, any_number)) return false;
  return true;
}

/// Whether the averages that are made in the run can be resumed from a step.
bool whole_averages(const CaseFolder& folder, const DemPlan& plan, long step) {
  for (std::size_t n = 0; n < plan.averages.size(); ++n)
    if (!averaging::has_checkpoint(averages_files(folder.dem(), n), plan.averages[n], step)) return false;
  return true;
}

/// What the next call can do with a run that was stopped.
std::string next_call(const CaseFolder& folder, const DemPlan& plan) {
  const auto step = last_good_restart(folder, plan);
  if (step && *step > plan.begin)
    return "With more room, --resume continues from step " + std::to_string(*step);
  const auto restarts = find_restarts(folder);
  if (restarts.empty() || restarts.back().step <= plan.begin)
    return "With more room, --resume starts from the beginning: there is no complete restart file";
  return "It cannot be resumed: no restart file of it is usable. Without --resume it starts from the "
         "beginning";
}

/// Throws RunError that says what an incomplete file means for the run.
[[noreturn]] void stop(const CaseFolder& folder, const DemPlan& plan, const fs::path& file,
                       const std::string& complaint) {
  throw RunError(file.string() + ": " + complaint + "; " + free_in_words(folder.root, plan.charge.balls()) +
                 ".\nThe run was stopped. " + next_call(folder, plan));
}

}  // namespace

std::string dump_complaint(const fs::path& file, long entries) {
  const std::string text = contents_of(file);
  const std::string size = std::to_string(text.size()) + " bytes";
  const long found = announced(text);
  if (found < 0) return size + ", expected a header and one line for each entry";
  if (entries != any_number && found != entries)
    return std::to_string(found) + " entries, expected " + std::to_string(entries);
  const long expected = header_lines + found;
  const long lines = std::count(text.begin(), text.end(), '\n');
  if (lines != expected || text.back() != '\n')
    return size + " with " + std::to_string(lines) + " complete lines, expected " + std::to_string(expected);
  return {};
}

std::string restart_complaint(const fs::path& file, long balls) {
  const std::string bytes = contents_of(file);
  // The length of the part before the blocks is not in the file, so they may begin at any byte.
  for (std::size_t at = 0; at + sizeof(std::int32_t) < bytes.size(); ++at)
    if (number_at<std::int32_t>(bytes, at) > 0 && count_blocks(bytes, at) == balls) return {};
  return std::to_string(bytes.size()) + " bytes, expected a restart file with all " + std::to_string(balls) +
         " balls";
}

std::optional<long> last_good_restart(const CaseFolder& folder, const DemPlan& plan) {
  const auto restarts = find_restarts(folder);
  for (auto restart = restarts.rbegin(); restart != restarts.rend(); ++restart) {
    if (restart_complaint(restart->file, plan.charge.balls()).empty() &&
        whole_averages(folder, plan, restart->step) &&
        (!plan.watches_contacts || has_contact_state(folder.dem(), restart->step)) &&
        whole_part(folder, plan, restart->step - plan.restart_steps, restart->step) &&
        rows_complaint(folder, plan, restart->step).empty())
      return restart->step;
  }
  return std::nullopt;
}

OutputCheck::OutputCheck(const CaseFolder& folder, const DemPlan& plan, long start)
    : folder_(folder), plan_(plan), start_(start), next_dump_(start) {
  const long every = plan.contact_steps;
  if (every > 0) next_contacts_ = (start + every - 1) / every * every;
}

void OutputCheck::dumps_until(long step) {
  const auto check = [&](const fs::path& file, long balls) {
    if (!fs::exists(file)) return;
    const std::string complaint = dump_complaint(file, balls);
    if (!complaint.empty()) stop(folder_, plan_, file, complaint);
  };
  for (; next_dump_ <= step; next_dump_ += plan_.step.steps_per_record)
    check(folder_.dumps() / ("dump." + std::to_string(next_dump_) + ".txt"), plan_.charge.balls());
  if (plan_.contact_steps == 0) return;
  for (; next_contacts_ <= step; next_contacts_ += plan_.contact_steps)
    for (const std::string kind : contact_kinds)
      check(folder_.contacts() / (kind + "." + std::to_string(next_contacts_) + ".txt"), any_number);
}

void OutputCheck::restart(long step) {
  const fs::path file = folder_.dem() / ("restart." + std::to_string(step));
  const std::string complaint = restart_complaint(file, plan_.charge.balls());
  if (!complaint.empty()) stop(folder_, plan_, file, complaint);
  if (rows_.empty())
    for (const RowKind& kind : row_kinds(folder_, plan_))
      rows_.emplace_back(folder_, kind, start_, plan_.step.steps_per_record);
  for (RowCheck& rows : rows_) {
    const std::string wrong = rows.complaint(step);
    if (!wrong.empty()) stop(folder_, plan_, rows.file(), wrong);
  }
  if (!whole_averages(folder_, plan_, step))
    stop(folder_, plan_, averages_files(folder_.dem(), 0).checkpoint(step),
         "there is no state of the averages of this step, expected one");
}

}  // namespace millfoam::dem_driver
