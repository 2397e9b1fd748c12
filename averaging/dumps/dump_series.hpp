// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace millfoam::averaging {

/// One dump of a series.
struct DumpFile {
  std::filesystem::path path;
  long long step = 0;  ///< DEM time-step in its header
};

/// The dumps that a pattern matches (glob(3): * ? [ ] and ~), in order of their time-steps, read from their
/// headers. Throws DumpError when none matches, a header cannot be read, or two have the same time-step.
std::vector<DumpFile> find_dumps(const std::string& pattern);

/// What the DEM driver notes in `run.txt` beside its dumps: lines "key value"; other keys are allowed.
struct RunNotes {
  std::filesystem::path file;              ///< where it was read
  std::optional<double> timestep;          ///< key `timestep`, s
  std::optional<long long> interval;       ///< key `interval`, time-steps between dumps
  std::optional<double> angular_velocity;  ///< key `angular_velocity`, of the mill about z, rad/s
};

/// Reads `run.txt` in a folder; nothing when there is none.
/// Throws DumpError for a `timestep` or `interval` that is not a positive number, and an `angular_velocity`
/// that is not a finite one.
std::optional<RunNotes> read_run_notes(const std::filesystem::path& folder);

/// The DEM time-step, s: `given`, or else the notes'.
/// Throws DumpError when both are there and differ by more than 1e-9 of each other, when neither is, or when
/// `given` is not positive.
double agreed_timestep(std::optional<double> given, const std::optional<RunNotes>& notes);

/// The mill's angular velocity, rad/s: `given`, or else the notes', or nothing. Throws DumpError as
/// `agreed_timestep` when they differ or `given` is not finite.
std::optional<double> agreed_angular_velocity(std::optional<double> given,
                                              const std::optional<RunNotes>& notes);

}  // namespace millfoam::averaging
