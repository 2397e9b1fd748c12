// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/segments.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "dem_driver/contact_record.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

/// The whole number between `before` and `after` in a name.
std::optional<long> number_in(const std::string& name, const std::string& before, const std::string& after) {
  if (name.size() <= before.size() + after.size() || name.rfind(before, 0) != 0 ||
      name.compare(name.size() - after.size(), after.size(), after) != 0)
    return std::nullopt;
  long number = 0;
  const char* end = name.data() + name.size() - after.size();
  const auto [stop, error] = std::from_chars(name.data() + before.size(), end, number);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return number;
}

std::vector<NumberedFile> find_numbered(const fs::path& folder, const std::string& before,
                                        const std::string& after) {
  std::vector<NumberedFile> found;
  if (!fs::is_directory(folder)) return found;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const auto step = number_in(entry.path().filename().string(), before, after))
      found.push_back({*step, entry.path()});
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.step < b.step; });
  return found;
}

/// All lines of numbers; the last one only if its line end is there.
std::vector<SegmentLine> read_file(const fs::path& file) {
  std::ifstream in(file);
  std::vector<SegmentLine> lines;
  std::string text;
  for (long number = 1; std::getline(in, text); ++number) {
    if (in.eof()) break;
    if (text.empty() || text.front() == '#') continue;
    const auto values = numbers_of(text);
    if (!values || values->empty())
      throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": '" + text +
                               "', expected numbers only");
    lines.push_back({*values, file, number});
  }
  return lines;
}

/// Every state of averages after a record, by its step.
std::vector<NumberedFile> find_states(const CaseFolder& folder) {
  std::vector<NumberedFile> states;
  for (const fs::path& file : find_averages(folder))
    if (const auto step = number_in(file.extension().string(), ".", "")) states.push_back({*step, file});
  return states;
}

}  // namespace

std::optional<std::vector<double>> numbers_of(const std::string& line) {
  std::vector<double> values;
  std::istringstream in(line);
  for (std::string word; in >> word;) {
    char* end = nullptr;
    values.push_back(std::strtod(word.c_str(), &end));
    if (*end != '\0') return std::nullopt;
  }
  return values;
}

std::vector<fs::path> find_averages(const CaseFolder& folder) {
  std::vector<fs::path> found;
  if (!fs::is_directory(folder.dem())) return found;
  for (const auto& entry : fs::directory_iterator(folder.dem()))
    if (entry.path().filename().string().rfind("averages_", 0) == 0) found.push_back(entry.path());
  return found;
}

std::vector<NumberedFile> find_segments(const CaseFolder& folder, const std::string& kind) {
  return find_numbered(folder.dem(), kind + ".", ".txt");
}

std::vector<NumberedFile> find_contacts(const CaseFolder& folder, const std::string& kind) {
  return find_numbered(folder.contacts(), kind + ".", ".txt");
}

std::string contacts_complaint(const CaseFolder& folder, const DemPlan& plan, long step) {
  if (plan.contact_steps == 0) return {};
  const long expected = contact_dumps_until(plan, step);
  for (const std::string kind : contact_kinds) {
    const auto files = find_contacts(folder, kind);
    const auto found =
        std::count_if(files.begin(), files.end(), [&](const auto& file) { return file.step <= step; });
    if (found != expected)
      return folder.contacts().string() + ": " + std::to_string(found) + ' ' + kind + " up to step " +
             std::to_string(step) + ", expected " + std::to_string(expected);
  }
  return {};
}

std::vector<NumberedFile> find_restarts(const CaseFolder& folder) {
  return find_numbered(folder.dem(), "restart.", "");
}

std::vector<SegmentLine> read_segments(const CaseFolder& folder, const std::string& kind, long continued) {
  const auto segments = find_segments(folder, kind);
  const auto record = static_cast<std::size_t>(1 + continued);
  std::vector<SegmentLine> all;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const double end = i + 1 < segments.size() ? static_cast<double>(segments[i + 1].step)
                                               : std::numeric_limits<double>::infinity();
    const auto lines = read_file(segments[i].file);
    for (std::size_t first = 0; first + record <= lines.size(); first += record) {
      if (lines[first].values.front() > end) break;
      const auto at = lines.begin() + static_cast<std::ptrdiff_t>(first);
      all.insert(all.end(), at, at + static_cast<std::ptrdiff_t>(record));
    }
  }
  return all;
}

std::vector<NumberedFile> find_numbered_dumps(const CaseFolder& folder) {
  return find_numbered(folder.dumps(), "dump.", ".txt");
}

long count_dumps_until(const CaseFolder& folder, long step) {
  const auto dumps = find_numbered_dumps(folder);
  return std::count_if(dumps.begin(), dumps.end(), [&](const auto& dump) { return dump.step <= step; });
}

void remove_dumps_after(const CaseFolder& folder, long step) {
  for (const auto& dump : find_numbered_dumps(folder))
    if (dump.step > step) fs::remove(dump.file);
  for (const char* kind : contact_kinds)
    for (const auto& contacts : find_contacts(folder, kind))
      if (contacts.step > step) fs::remove(contacts.file);
}

void remove_contact_states(const CaseFolder& folder, const std::function<bool(long)>& chosen) {
  for (const auto& state : find_segments(folder, contact_state_kind))
    if (chosen(state.step)) fs::remove(state.file);
}

void remove_restarts_after(const CaseFolder& folder, long step) {
  for (const auto& files : {find_restarts(folder), find_states(folder)})
    for (const auto& found : files)
      if (found.step > step) fs::remove(found.file);
  for (const char* kind : segment_kinds)
    for (const auto& segment : find_segments(folder, kind))
      if (segment.step > step) fs::remove(segment.file);
  remove_contact_states(folder, [&](long other) { return other > step; });
}

void remove_restarts_before(const CaseFolder& folder, long step) {
  for (const auto& files : {find_restarts(folder), find_states(folder)})
    for (const auto& found : files)
      if (found.step < step) fs::remove(found.file);
  remove_contact_states(folder, [&](long other) { return other < step; });
}

}  // namespace millfoam::dem_driver
