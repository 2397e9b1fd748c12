// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/dump_series.hpp"

#include <glob.h>

#include <algorithm>
#include <iterator>

#include "averaging/dumps/dump_error.hpp"
#include "averaging/dumps/dump_input.hpp"

namespace millfoam::averaging {

namespace {

std::vector<std::filesystem::path> matches(const std::string& pattern) {
  glob_t found{};
  const int status = glob(pattern.c_str(), GLOB_TILDE | GLOB_BRACE, nullptr, &found);
  std::vector<std::filesystem::path> paths(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  if (status == GLOB_NOMATCH || (status == 0 && paths.empty())) {
    throw DumpError("no dump matches '" + pattern + "'");
  }
  if (status != 0) throw DumpError("cannot look for dumps that match '" + pattern + "'");
  return paths;
}

}  // namespace

DumpHeader read_dump_header(const std::filesystem::path& file) {
  DumpInput input(file, std::size_t{1} << 12U);
  TextLines lines = input.lines();
  return read_header(lines);
}

std::vector<DumpFile> find_dumps(const std::string& pattern) {
  std::vector<DumpFile> dumps;
  for (const std::filesystem::path& path : matches(pattern)) {
    DumpInput input(path, std::size_t{1} << 12U);
    TextLines lines = input.lines();
    const long long step = read_step(lines);
    dumps.push_back({path, step, read_count(lines)});
  }
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

}  // namespace millfoam::averaging
