// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/run_metadata.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include "averaging/dumps/dump_error.hpp"
#include "meshing/files/file_fingerprint.hpp"
#include "meshing/files/json_object.hpp"

namespace millfoam::averaging {

namespace {

std::optional<double> finite(const JsonObject& run, const char* key, const std::string& expected,
                             double above = -std::numeric_limits<double>::infinity()) {
  return run.find<double>(key, expected,
                          [above](double value) { return value > above && std::isfinite(value); });
}

std::optional<long long> count(const JsonObject& run, const char* key, long long least) {
  return run.find<long long>(key, least > 0 ? "a positive whole number" : "a whole number of 0 or more",
                             [least](long long number) { return number >= least; });
}

std::optional<double> fines_share(const JsonObject& run) {
  const auto mass = [&](const char* key) {
    return run.find<double>(key, "a mass of 0 kg or more",
                            [](double m) { return m >= 0 && std::isfinite(m); });
  };
  const std::optional<double> fines = mass("fines_mass_kg"), balls = mass("charge_mass_kg");
  if (!fines || !balls || *fines + *balls == 0) return std::nullopt;
  return *fines / (*fines + *balls);
}

RunMetadata metadata_of(const JsonObject& run) {
  constexpr char format[] = "millfoam-dumps";
  run.find<std::string>("format", '"' + std::string(format) + '"',
                        [&](const std::string& found) { return found.empty() || found == format; });
  RunMetadata metadata;
  metadata.timestep = finite(run, "timestep_s", "a positive number", 0);
  metadata.interval = count(run, "interval", 1);
  metadata.angular_velocity = finite(run, "angular_velocity_rad_s", "a finite number");
  metadata.begin = finite(run, "begin_s", "a finite time in s");
  metadata.duration = finite(run, "duration_s", "a time in s above 0", 0);
  metadata.dumps = count(run, "dumps", 0);
  if (const auto mill = run.find_object("mill")) {
    metadata.mill_walls = mill->find<std::string>("walls").value_or("");
    metadata.mill_charge = mill->find<std::string>("charge").value_or("");
  }
  metadata.fines_share = fines_share(run);
  return metadata;
}

}  // namespace

std::optional<RunMetadata> read_run_metadata(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "run.json";
  try {
    const auto run = JsonObject::read(file);
    if (!run) return std::nullopt;
    RunMetadata metadata = metadata_of(*run);
    metadata.file = file;
    metadata.run_id = file_fingerprint(file);
    return metadata;
  } catch (const JsonError& error) {
    throw DumpError(error.what());
  }
}

std::map<std::string, std::string> read_run_walls(const std::filesystem::path& folder) {
  using Fingerprints = std::map<std::string, std::string>;
  try {
    const auto run = JsonObject::read(folder / "run.json");
    return run ? run->find<Fingerprints>("wall_files").value_or(Fingerprints()) : Fingerprints();
  } catch (const JsonError& error) {
    throw DumpError(error.what());
  }
}

void require_dumps(const RunMetadata& metadata) {
  if (metadata.dumps.value_or(1) > 0) return;
  throw DumpError(metadata.file.string() +
                  ": the run wrote no dumps (dem.dumps: no): its averages were made while it ran");
}

void require_all_dumps(const RunMetadata& metadata, std::size_t found) {
  const long long written = metadata.dumps.value_or(0);
  if (static_cast<long long>(found) >= written) return;
  throw DumpError(metadata.file.parent_path().string() + ": " + std::to_string(found) + " dumps, " +
                  metadata.file.filename().string() + " says " + std::to_string(written) +
                  "; expected all of them, or --window and --start for a part of the run");
}

double agreed_timestep(std::optional<double> given, const std::optional<RunMetadata>& metadata) {
  std::ostringstream message;
  message.precision(12);
  const bool known = metadata && metadata->timestep;
  if (!given && !known) {
    message << "the DEM time-step is not known: give --dt SECONDS, or a file 'run.json' with the key "
               "'timestep_s' in the folder of the dumps";
  } else if (given && !(*given > 0 && std::isfinite(*given))) {
    message << "--dt is " << *given << ", expected a positive time in s";
  } else if (given && known && std::abs(*given - *metadata->timestep) > 1e-9 * *metadata->timestep) {
    message << "--dt is " << *given << " s, but " << metadata->file.string() << " has timestep_s "
            << *metadata->timestep << " s; they must be the same";
  } else {
    return known ? *metadata->timestep : *given;
  }
  throw DumpError(message.str());
}

std::optional<double> agreed_angular_velocity(std::optional<double> given,
                                              const std::optional<RunMetadata>& metadata) {
  std::ostringstream message;
  message.precision(12);
  if (given && !std::isfinite(*given)) {
    message << "--speed is " << *given << ", expected a finite angular velocity in rad/s";
  } else if (given && metadata && metadata->angular_velocity &&
             std::abs(*given - *metadata->angular_velocity) > 1e-9 * std::abs(*given)) {
    message << "--speed is " << *given << " rad/s, but " << metadata->file.string()
            << " has angular_velocity_rad_s " << *metadata->angular_velocity
            << " rad/s; they must be the same";
  } else if (given) {
    return given;
  } else {
    return metadata ? metadata->angular_velocity : std::nullopt;
  }
  throw DumpError(message.str());
}

}  // namespace millfoam::averaging
