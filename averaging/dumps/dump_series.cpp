// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/dump_series.hpp"

#include <glob.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include "averaging/dumps/dump_reader.hpp"
#include "averaging/dumps/text_lines.hpp"

namespace millfoam::averaging {

namespace {

std::vector<std::filesystem::path> matches(const std::string& pattern) {
  glob_t found{};
  const int status = glob(pattern.c_str(), GLOB_TILDE, nullptr, &found);
  std::vector<std::filesystem::path> paths(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  if (status == GLOB_NOMATCH || (status == 0 && paths.empty())) {
    throw DumpError("no dump matches '" + pattern + "'");
  }
  if (status != 0) throw DumpError("cannot look for dumps that match '" + pattern + "'");
  return paths;
}

double finite(std::string_view word, std::string_view key, const TextLines& lines) {
  const auto value = as_number<double>(word);
  if (!value || !std::isfinite(*value)) {
    throw DumpError(lines.place() + "key '" + std::string(key) + "' is '" + std::string(word) +
                    "', expected a finite number");
  }
  return *value;
}

template <typename Number>
Number positive(std::string_view word, std::string_view key, const TextLines& lines) {
  const auto value = as_number<Number>(word);
  if (!value || !(*value > 0) || !std::isfinite(static_cast<double>(*value))) {
    throw DumpError(lines.place() + "key '" + std::string(key) + "' is '" + std::string(word) +
                    "', expected a positive number");
  }
  return *value;
}

}  // namespace

std::vector<DumpFile> find_dumps(const std::string& pattern) {
  std::vector<DumpFile> dumps;
  for (const std::filesystem::path& path : matches(pattern)) dumps.push_back({path, read_dump_step(path)});
  std::stable_sort(dumps.begin(), dumps.end(),
                   [](const DumpFile& a, const DumpFile& b) { return a.step < b.step; });
  const auto twin = std::adjacent_find(dumps.begin(), dumps.end(),
                                       [](const DumpFile& a, const DumpFile& b) { return a.step == b.step; });
  if (twin != dumps.end()) {
    throw DumpError("'" + twin->path.string() + "' and '" + std::next(twin)->path.string() +
                    "' are both of time-step " + std::to_string(twin->step) +
                    ", expected one dump of each time");
  }
  return dumps;
}

std::optional<RunNotes> read_run_notes(const std::filesystem::path& folder) {
  RunNotes notes;
  notes.file = folder / "run.txt";
  std::ifstream input(notes.file);
  if (!input) return std::nullopt;
  std::string text{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  // Written by hand, it may lack its last line end.
  text += '\n';
  TextLines lines(text, notes.file.string());
  for (auto line = lines.next(); line; line = lines.next()) {
    const std::string_view key = take_word(*line);
    const std::string_view value = take_word(*line);
    if (key == "timestep") notes.timestep = positive<double>(value, key, lines);
    if (key == "interval") notes.interval = positive<long long>(value, key, lines);
    if (key == "angular_velocity") notes.angular_velocity = finite(value, key, lines);
  }
  return notes;
}

double agreed_timestep(std::optional<double> given, const std::optional<RunNotes>& notes) {
  std::ostringstream message;
  message.precision(12);
  const bool noted = notes && notes->timestep;
  if (!given && !noted) {
    message << "the DEM time-step is not known: give --dt SECONDS, or a file 'run.txt' with a line 'timestep "
               "SECONDS' "
               "beside the dumps";
  } else if (given && !(*given > 0 && std::isfinite(*given))) {
    message << "--dt is " << *given << ", expected a positive time in s";
  } else if (given && noted && std::abs(*given - *notes->timestep) > 1e-9 * *notes->timestep) {
    message << "--dt is " << *given << " s, but " << notes->file.string() << " says timestep "
            << *notes->timestep << " s; they must be the same";
  } else {
    return noted ? *notes->timestep : *given;
  }
  throw DumpError(message.str());
}

std::optional<double> agreed_angular_velocity(std::optional<double> given,
                                              const std::optional<RunNotes>& notes) {
  std::ostringstream message;
  message.precision(12);
  if (given && !std::isfinite(*given)) {
    message << "--speed is " << *given << ", expected a finite angular velocity in rad/s";
  } else if (given && notes && notes->angular_velocity &&
             std::abs(*given - *notes->angular_velocity) > 1e-9 * std::abs(*given)) {
    message << "--speed is " << *given << " rad/s, but " << notes->file.string() << " says angular_velocity "
            << *notes->angular_velocity << " rad/s; they must be the same";
  } else if (given) {
    return given;
  } else {
    return notes ? notes->angular_velocity : std::nullopt;
  }
  throw DumpError(message.str());
}

}  // namespace millfoam::averaging
