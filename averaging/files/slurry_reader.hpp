// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "averaging/grids/box_grid.hpp"

/// @file
/// What a ball feels of a flow: the group /balls of slurry.h5. Layout: FORMATS.md.

namespace millfoam::averaging {

/// A flow on n voxels as a ball feels it, mean over a time: a ball of volume V and velocity v feels
/// V (pressure_force + drag_force - exchange v). Fields are in C order [z][y][x].
struct BallFields {
  std::vector<double> inside;          ///< [n] share of the voxel in the flow's mesh; 0: no fluid there
  std::vector<double> pressure_force;  ///< [n][3] -grad p of the fluid, N/m^3
  std::vector<double> exchange;        ///< [n] K, kg/(m^3 s)
  std::vector<double> drag_force;      ///< [n][3] mean of K (u - u_s), and K times the mean of u_s, N/m^3
  std::vector<double> solidity;        ///< [n] that the flow saw
  std::vector<double> diameter;        ///< [n] Sauter mean diameter that the drag law saw, m
};

/// The first voxel with fluid in which a field is not finite.
/// @param values  [n][width]
/// @param width  numbers of a voxel
/// @param inside  [n] as in BallFields
std::optional<std::size_t> not_finite(const std::vector<double>& values, std::size_t width,
                                      const std::vector<double>& inside);

/// A voxel for messages: "voxel x y z = (3, 0, 1), whose centre is (0.01, 0, 0.02) m".
std::string voxel_in_words(const BoxGrid& grid, std::size_t voxel);

/// What holds for a whole slurry file.
struct BallFieldsHeader {
  std::string mill_flow;        ///< fingerprint of the mill; empty: not known
  bool polydispersity = false;  ///< a ball of diameter d feels the exchange of its own size
  std::size_t windows = 0;      ///< number of time windows
};

/// Reads slurry.h5 of version 2. All functions throw SlurryFileError with the file's name; the sentences say
/// what to do.
class SlurryReader {
 public:
  /// Opens the file. Throws when it is missing, not complete, of a version without forces on balls, or of a
  /// flow without balls.
  explicit SlurryReader(const std::filesystem::path& path);
  ~SlurryReader();
  /// Takes the open file of another.
  SlurryReader(SlurryReader&&) noexcept;
  SlurryReader& operator=(SlurryReader&&) = delete;

  const BoxGrid& grid() const;                ///< of the voxels
  const BallFieldsHeader& header() const;     ///< what holds for the whole file
  const std::filesystem::path& path() const;  ///< of the file
  /// Begin of the first window and end of the last one, DEM time, s. There must be windows.
  std::array<double, 2> span() const;
  /// Middle of a window, DEM time, s.
  double middle(std::size_t window) const;

  /// The mean over the run. Throws when the file has none, and for a value that is not finite in a voxel
  /// with fluid; the message names the voxel and its centre.
  BallFields mean() const;
  /// A time window, from 0 on. Throws as `mean`.
  BallFields window(std::size_t number) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

/// Flow time at which the first window of a slurry.h5 begins, s. None where the file does not exist, is not
/// complete, or cannot be read.
std::optional<double> slurry_begin(const std::filesystem::path& path);

}  // namespace millfoam::averaging
