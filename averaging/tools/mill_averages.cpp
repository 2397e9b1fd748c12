// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/tools/mill_averages.hpp"

#include <algorithm>
#include <array>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "averaging/dumps/run_metadata.hpp"
#include "averaging/statistics/time_windows.hpp"
#include "meshing/files/json_object.hpp"
#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/resolved_mill.hpp"
#include "meshing/walls/wall_files.hpp"

namespace millfoam::averaging {
namespace {

namespace fs = std::filesystem;

/// The notes of the dry run in a folder of dumps.
RunMetadata metadata_of(const fs::path& dumps) {
  if (auto metadata = read_run_metadata(dumps)) return *metadata;
  throw std::invalid_argument((dumps / "run.json").string() +
                              ": cannot be read; expected the file that millDem writes at the end of a run");
}

/// Throws where the dumps' part of the mill has another fingerprint than this one's.
void require_dumps_of(const RunMetadata& run, const std::string& part, const std::string& found,
                      const std::string& fingerprint) {
  if (found.empty() || found == fingerprint) return;
  throw std::invalid_argument(run.file.string() + ": the dumps are of another mill (" + part + " " + found +
                              ", this mill's are " + fingerprint + "): run millDem again");
}

/// The pattern of files in a folder, whose own name may have characters that patterns give a meaning.
std::string pattern_in(const fs::path& folder, const std::string& files) {
  std::string pattern;
  for (const char letter : folder.string()) {
    if (std::string_view("*?[]{}\\~").find(letter) != std::string_view::npos) pattern += '\\';
    pattern += letter;
  }
  return pattern + '/' + files;
}

/// The values of an option in words.
template <typename Values>
std::string words_of(const Values& values) {
  std::ostringstream words;
  for (const auto& value : values) words << (words.tellp() > 0 ? " " : "") << value;
  return words.str();
}

/// Throws for an option that belongs to a grid of its own.
void refuse_without_grid(const Options& options) {
  const std::array<std::pair<const char*, std::string>, 4> given{
      {{"--shape", words_of(options.shape)},
       {"--frame", options.frame.value_or("")},
       {"--components", options.components},
       {"--periodic", words_of(options.periodic)}}};
  for (const auto& [name, value] : given) {
    if (value.empty()) continue;
    throw std::invalid_argument(
        name + (" is " + value) +
        ", but the cells are those of the mill; expected --box, --cylinder or --mesh with it, or a change of "
        "the mill by --set averages.KEY=VALUE");
  }
}

}  // namespace

SteadyStart steady_start(const fs::path& results) {
  const auto found = JsonObject::read(results, "; give averages.start a time, or run millDem again");
  const auto time = found ? found->find<double>("steady_from_s") : std::nullopt;
  if (!time)
    throw std::invalid_argument(results.string() +
                                ": no number steady_from_s, which 'averages.start: steady' needs; "
                                "give averages.start a time, or run millDem again");
  SteadyStart start{*time, ""};
  if (!found->find<bool>("steady").value_or(true))
    start.warning = results.string() + ": the dry run is not steady; its last part is averaged, from " +
                    exact(start.time) + " s on. Raise dem.duration";
  return start;
}

double last_whole_window(double start, double end, double duration, double window, double timestep) {
  const auto steps = [&](double time, const char* what) { return whole_steps(time, timestep, what); };
  const long long first = steps(start, "averages.start"), length = steps(window, "averages.window");
  const long long count = (steps(end, "the end of the dry run") - first) / std::max(length, 1LL);
  if (count < 1)
    throw std::invalid_argument("averages.window: " + exact(window) + " s, but the dry run of " +
                                exact(duration) + " s has only " + exact(end - start) + " s from " +
                                exact(start) + " s on: raise dem.duration, or lower averages.window");
  return static_cast<double>(first + count * length) * timestep;
}

bool has_grid(const Options& options) {
  return !options.box.empty() || !options.cylinder.empty() || !options.mesh.empty();
}

bool has_windows(const Options& options) {
  return !options.windows.empty() || options.start || options.end;
}

bool request_others(const Options& options) {
  const bool own_method = options.method || options.template_points || !options.walls.empty();
  return has_grid(options) || has_windows(options) || own_method || options.solidity_cap;
}

void take_grid(const meshing::Mill& mill, Options& options) {
  refuse_without_grid(options);
  const std::array<int, 3> shape = mill.averages.shape();
  options.shape.assign(shape.begin(), shape.end());
  if (mill.averages.rings) {
    options.cylinder = {0, mill.geometry.radius(), 0, mill.geometry.length};
    options.components = "cylindrical";
    options.frame = mill.averages.rings->turning ? "turning" : "lab";
  } else {
    const meshing::Voxels& voxels = mill.averages.voxels;
    options.box.assign(voxels.lower.begin(), voxels.lower.end());
    options.box.insert(options.box.end(), voxels.upper.begin(), voxels.upper.end());
  }
  if (mill.geometry.ends == meshing::Ends::periodic) options.periodic = {"z"};
  if (options.walls.empty()) options.walls = {pattern_in(fs::path(options.case_folder) / "walls", "*.stl")};
  if (!options.method) options.method = mill.averages.method;
  if (!options.template_points) options.template_points = mill.averages.template_points;
}

namespace {

/// Its time, s; prints its warning.
double warned(const SteadyStart& start) {
  if (!start.warning.empty()) std::cerr << "millAverage: warning: " << start.warning << '\n';
  return start.time;
}

/// Window, start and end, where the options leave them open: whole windows up to the end of the dry run, or
/// one with all records. A run that continues another begins at its end, and averages.start counts from
/// there. Several windows of the options, and one that is longer than the run, have no end.
void take_windows(const meshing::Mill& mill, const fs::path& dumps, const RunMetadata& run,
                  Options& options) {
  const bool of_mill = options.windows.empty();
  const double begin = run.begin.value_or(0), duration = run.duration.value_or(mill.dem.duration);
  if (of_mill) options.windows = {mill.averages.whole_run ? "whole" : exact(mill.averages.window)};
  if (!options.start)
    options.start =
        mill.averages.start ? begin + *mill.averages.start : warned(steady_start(dumps / "results.json"));
  if (options.end || options.windows.size() > 1) return;
  const double window = to_number(options.windows.front()).value_or(0);  // 0: of the whole run
  if (!(window > 0) || (!of_mill && *options.start + window > begin + duration + 1e-6 * window)) return;
  options.end = last_whole_window(*options.start, begin + duration, duration, window,
                                  agreed_timestep(options.timestep, run));
}

}  // namespace

std::string take_from_mill(const meshing::MillDescription& description, Options& options) {
  const meshing::Mill& mill = description.mill;
  const meshing::MillFingerprints& of = mill.fingerprint;
  const fs::path dumps = fs::path(options.case_folder) / "dumps";
  const bool others = request_others(options), own_windows = has_windows(options);
  const bool own_dumps = !options.dumps.empty();
  if (!own_dumps) {
    const RunMetadata run = metadata_of(dumps);
    require_dumps_of(run, "charge", run.mill_charge, of.charge);
    require_dumps_of(run, "walls", run.mill_walls, of.walls);
    require_dumps(run);
    options.dumps = pattern_in(dumps, "dump.*.txt{,.gz}");
    options.whole_run_dumped = !own_windows;
    take_windows(mill, dumps, run, options);
  } else if (!own_windows) {
    throw std::invalid_argument("--dumps: for dumps in another folder, also give --window and --start");
  }
  if (!has_grid(options)) {
    const fs::path walls = fs::path(options.case_folder) / "walls";
    if (options.walls.empty()) {
      meshing::require_walls_of(walls, mill);
      meshing::require_written_walls(walls);
      const auto used = own_dumps ? std::map<std::string, std::string>() : read_run_walls(dumps);
      if (!used.empty()) meshing::require_walls_of_run(walls, used, (dumps / "run.json").string());
    }
    take_grid(mill, options);
  }
  if (options.output.empty()) options.output = (fs::path(options.case_folder) / "solids.h5").string();
  return others ? "" : of.averages;
}

}  // namespace millfoam::averaging
