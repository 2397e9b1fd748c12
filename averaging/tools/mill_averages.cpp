// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/tools/mill_averages.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <istream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "averaging/statistics/time_windows.hpp"
#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/resolved_mill.hpp"

namespace millfoam::averaging {
namespace {

namespace fs = std::filesystem;

/// A JSON object out of a file, of that program.
nlohmann::json parse_object(std::istream& in, const fs::path& file, const std::string& program) {
  nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object())
    throw std::invalid_argument(file.string() + ": is not a JSON object; run " + program + " again");
  return json;
}

/// A JSON object of the dry run's folder.
nlohmann::json read_object(const fs::path& file) {
  std::ifstream in(file);
  if (!in)
    throw std::invalid_argument(
        file.string() + ": cannot be read; expected the file that millDem writes at the end of a run");
  return parse_object(in, file, "millDem");
}

/// Throws where the walls that a file names have another fingerprint than the mill's.
void require_walls_of(const nlohmann::json& json, const fs::path& file, const std::string& what,
                      const std::string& program, const std::string& fingerprint) {
  const std::string found = json.value(nlohmann::json::json_pointer("/mill/walls"), std::string());
  if (found.empty() || found == fingerprint) return;
  throw std::invalid_argument(file.string() + ": " + what + " of another mill (walls " + found +
                              ", this mill's are " + fingerprint + "): run " + program + " again");
}

/// The same for the folder of the walls. Those from CAD belong to any mill, and other files to none.
void require_folder_of(const fs::path& walls, const std::string& fingerprint) {
  const fs::path file = walls / "walls.json";
  std::ifstream in(file);
  if (!in) return;
  const nlohmann::json json = parse_object(in, file, "millMesh");
  if (json.value("source", nlohmann::json()) != "cad")
    require_walls_of(json, file, "the walls are", "millMesh", fingerprint);
}

void require_charge_of(const nlohmann::json& run, const fs::path& file, const std::string& fingerprint) {
  const std::string found = run.value(nlohmann::json::json_pointer("/mill/charge"), std::string());
  if (found.empty() || found == fingerprint) return;
  throw std::invalid_argument(file.string() + ": the dumps are of another mill (charge " + found +
                              ", this mill's is " + fingerprint + "): run millDem again");
}

double time_step(const nlohmann::json& run, const fs::path& file, const Options& options) {
  const double found = options.timestep.value_or(run.value("timestep_s", 0.0));
  if (!(found > 0))
    throw std::invalid_argument(file.string() + ": no number timestep_s above 0; run millDem again");
  return found;
}

double steady_start(const fs::path& file) {
  const nlohmann::json results = read_object(file);
  if (!results.contains("steady_from_s") || !results["steady_from_s"].is_number())
    throw std::invalid_argument(file.string() +
                                ": no number steady_from_s, which 'averages.start: steady' needs; "
                                "give averages.start a time, or run millDem again");
  return results["steady_from_s"].get<double>();
}

void require_dumps(const nlohmann::json& run, const fs::path& file) {
  if (run.value("dumps", 1) > 0) return;
  throw std::invalid_argument(
      file.string() + ": the run wrote no dumps (dem.dumps: no): its averages were made while it ran");
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
  if (options.walls.empty()) options.walls = {(fs::path(options.case_folder) / "walls" / "*.stl").string()};
  if (!options.method) options.method = mill.averages.method;
  if (!options.template_points) options.template_points = mill.averages.template_points;
}

namespace {

/// Start, window and end: whole windows up to the end of the dry run, or one with all records. A run that
/// continues another begins at its end, and averages.start counts from there.
void take_windows(const meshing::Mill& mill, const fs::path& dumps, const nlohmann::json& run,
                  Options& options) {
  const double window = mill.averages.window;
  const double begin = run.value("begin_s", 0.0), duration = run.value("duration_s", mill.dem.duration);
  const double start =
      mill.averages.start ? begin + *mill.averages.start : steady_start(dumps / "results.json");
  if (!mill.averages.whole_run)
    options.end = last_whole_window(start, begin + duration, duration, window,
                                    time_step(run, dumps / "run.json", options));
  options.windows = {mill.averages.whole_run ? "whole" : exact(window)};
  options.start = start;
}

}  // namespace

std::string take_from_mill(const meshing::MillDescription& description, Options& options) {
  const meshing::Mill& mill = description.mill;
  const meshing::MillFingerprints& of = mill.fingerprint;
  const fs::path dumps = fs::path(options.case_folder) / "dumps";
  const bool others = request_others(options), own_windows = has_windows(options);
  if (options.dumps.empty()) {
    const nlohmann::json run = read_object(dumps / "run.json");
    require_charge_of(run, dumps / "run.json", of.charge);
    require_walls_of(run, dumps / "run.json", "the dumps are", "millDem", of.walls);
    require_dumps(run, dumps / "run.json");
    options.dumps = (dumps / "dump.*.txt").string();
    if (!own_windows) take_windows(mill, dumps, run, options);
  } else if (!own_windows) {
    throw std::invalid_argument("--dumps: for dumps in another folder, also give --window and --start");
  }
  if (!has_grid(options)) {
    if (options.walls.empty()) require_folder_of(fs::path(options.case_folder) / "walls", of.walls);
    take_grid(mill, options);
  }
  if (options.output.empty()) options.output = (fs::path(options.case_folder) / "solids.h5").string();
  return others ? "" : of.averages;
}

}  // namespace millfoam::averaging
