// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "averaging/grids/grid.hpp"
#include "averaging/values/ledger.hpp"
#include "averaging/values/solids_window.hpp"

/// @file
/// solids.h5, the contract between averaging and flow. Layout: FORMATS.md. Neither class may be used by two
/// threads at once.

namespace millfoam::averaging {

/// The version of the layout of files whose velocities are along x, y and z on cells of the lab or of a mesh.
inline constexpr int solids_version = 2;

/// The version of files on a cylinder with velocities along r, theta and z, which may turn. Programs that
/// read only the other would take them for velocities along x, y and z.
inline constexpr int cylindrical_solids_version = 3;

/// A solids file that cannot be read or written; the message names the file and the reason.
class SolidsFileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What holds for the whole file.
struct SolidsHeader {
  double time0 = 0;                        ///< DEM time at which the first window begins, s
  double timestep = 0;                     ///< of the DEM run, s
  bool whole_run = false;                  ///< one window over the whole run
  std::string method;                      ///< how balls were deposited in cells, in words
  std::optional<double> angular_velocity;  ///< of the mill about z, right-handed, rad/s
  double smoothing = 0;                    ///< width of the diffusion on the mesh, m; 0: none
  std::optional<double> solidity_cap;      ///< above which solids were moved to neighbours
  bool inside_fractions = false;           ///< whether windows have inside fractions
  std::string program;                     ///< that wrote the file, with its version; empty: not known
  std::string mill_charge;    ///< fingerprint of the mill whose charge was averaged; empty: not known
  std::string mill_averages;  ///< fingerprint of the mill and its averages; empty: not known
  std::string run_id;         ///< of the dry run whose dumps were averaged, `RunMetadata`; empty: not known
  std::optional<double> fines_share;  ///< of the charge's mass: fines, which are not simulated; if known
  /// Width of the walls across z over that of the grid; nothing without walls, or where it is not known.
  std::optional<double> walls_over_grid = std::nullopt;
};

/// Writes a solids file window by window; memory does not grow with the number of windows. Until `finish` the
/// file is called `path` + ".part" and says that it is not complete, so a run that is killed leaves nothing
/// that looks whole. All members throw SolidsFileError.
class SolidsWriter {
 public:
  /// Makes `path` + ".part", replacing an older one.
  SolidsWriter(const std::filesystem::path& path, const Grid& grid, const SolidsHeader& header);
  ~SolidsWriter();
  SolidsWriter(const SolidsWriter&) = delete;
  SolidsWriter& operator=(const SolidsWriter&) = delete;

  /// Appends the next window and hands it to the operating system. Every field must have the grid's size.
  void append(const WindowAverage& window);

  /// Marks the file complete and gives it its name, replacing an older file. Throws when no window was
  /// appended.
  void finish();

 private:
  struct Open;
  std::filesystem::path path_;
  std::filesystem::path part_;
  std::size_t cells_;
  std::unique_ptr<Open> open_;
};

/// Reads a solids file, one window at a time. Any number of processes may read one file at once: it is opened
/// read-only and without HDF5's file locks (which some network file systems refuse), and HDF5 prints nothing.
class SolidsReader {
 public:
  /// Opens and checks the file: there, HDF5, of this format and version, complete, all data sets of matching
  /// shape, windows in order. Throws SolidsFileError.
  explicit SolidsReader(const std::filesystem::path& path);
  ~SolidsReader();
  /// Takes over the open file; the other reader must not be used any more.
  SolidsReader(SolidsReader&&) noexcept;
  SolidsReader& operator=(SolidsReader&&) noexcept;

  const Grid& grid() const;  ///< that the fields live on
  /// At least one, in order of time. Files of millFoam 0.2 do not know `expected`.
  const std::vector<TimeWindow>& windows() const;
  double time0() const;                ///< DEM time at which the first window begins, s
  double timestep() const;             ///< of the DEM run, s
  bool whole_run() const;              ///< one window over the whole run, which a flow holds
  const SolidsHeader& header() const;  ///< all that holds for the whole file

  /// Fields of window `number`, from 0. Throws SolidsFileError for a number beyond the last, a value that is
  /// not finite, a negative diameter, or a solidity outside [0, 1); the message says in which cell.
  SolidsWindow read_window(std::size_t number) const;

  /// The same without checks of the values, to inspect a file that a flow would refuse.
  SolidsWindow read_unchecked(std::size_t number) const;

  /// Where the particles' volume went, per window. Throws SolidsFileError.
  std::vector<Ledger> read_ledgers() const;

  /// Mean number of balls in an occupied cell, per window. Throws SolidsFileError.
  std::vector<double> read_balls_per_cell() const;

 private:
  struct Open;
  std::filesystem::path path_;
  std::unique_ptr<Open> open_;
};

}  // namespace millfoam::averaging
