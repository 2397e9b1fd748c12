// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace millfoam::averaging {

/// The DEM driver's notes about its run: `run.json` in the folder of the dumps, an object of JSON. Other keys
/// are allowed.
struct RunMetadata {
  std::filesystem::path file;              ///< where it was read
  std::string run_id;                      ///< of the dry run: FNV-1a of the file's bytes, 16 hex digits
  std::optional<double> timestep;          ///< key `timestep_s`, s
  std::optional<long long> interval;       ///< key `interval`, time-steps between dumps
  std::optional<double> angular_velocity;  ///< key `angular_velocity_rad_s`, of the mill about z, rad/s
  std::optional<double> begin;             ///< key `begin_s`, DEM time, s
  std::optional<double> duration;          ///< key `duration_s`, s
  std::optional<long long> dumps;          ///< key `dumps`, their number; 0: none were written
  std::string mill_walls;                  ///< key `walls` of `mill`: fingerprint; empty: not known
  std::string mill_charge;                 ///< key `charge` of `mill`: fingerprint; empty: not known
  /// Mass of the fines, which are not simulated, over that of the whole charge: fines_mass_kg /
  /// (fines_mass_kg + charge_mass_kg), where both keys are there.
  std::optional<double> fines_share;
};

/// Reads `run.json` in a folder; nothing when there is none.
/// Throws DumpError, naming the file and its line, for text that is not JSON; naming the file and the key,
/// for a `format` other than millfoam-dumps, a `timestep_s` or `duration_s` that is not a positive number, an
/// `interval` that is not a positive whole number, and other values of another kind than above. A key that is
/// null counts as not there.
std::optional<RunMetadata> read_run_metadata(const std::filesystem::path& folder);

/// Fingerprints of the files of the run's walls by their names without `.stl`, key `wall_files` of `run.json`
/// in a folder; none without the file or the key. Throws DumpError where it cannot be read.
std::map<std::string, std::string> read_run_walls(const std::filesystem::path& folder);

/// Throws DumpError, naming the file, for a run that wrote no dumps.
void require_dumps(const RunMetadata& metadata);

/// Throws DumpError, naming the file and both numbers, where fewer dumps are there than the run wrote.
/// @param metadata  of the run
/// @param found     number of dumps in its folder
void require_all_dumps(const RunMetadata& metadata, std::size_t found);

/// The DEM time-step, s: `given`, or else the metadata's.
/// Throws DumpError when both are there and differ by more than 1e-9 of each other, when neither is, or when
/// `given` is not positive.
double agreed_timestep(std::optional<double> given, const std::optional<RunMetadata>& metadata);

/// The mill's angular velocity, rad/s: `given`, or else the metadata's, or nothing. Throws DumpError as
/// `agreed_timestep` when they differ or `given` is not finite.
std::optional<double> agreed_angular_velocity(std::optional<double> given,
                                              const std::optional<RunMetadata>& metadata);

}  // namespace millfoam::averaging
