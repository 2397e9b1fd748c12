// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "averaging/grids/box_grid.hpp"
#include "averaging/values/voxel_sums.hpp"

/// @file
/// slurry.h5, a flow's slurry averaged in time on the voxels of a box. Layout: FORMATS.md.

namespace millfoam::averaging {

/// The version of the layout that is written.
inline constexpr int slurry_version = 2;

/// A slurry file or a segment that cannot be read or written; the message names the file and the reason.
class SlurryFileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What is summed in a voxel, per volume of the cells: with fluid's share epsilon, slurry's share alpha of
/// the fluid, velocity u, pressure p and p_rgh: epsilon alpha, epsilon, epsilon alpha u (3), epsilon alpha p,
/// epsilon alpha p_rgh.
inline constexpr std::size_t slurry_components = 7;

/// Added to the solidity phi in the weight w = phi + this of what a ball feels, so that voxels without balls
/// have values, too.
inline constexpr double few_balls = 1e-6;

/// What follows these in a flow with balls, per volume of the cells: w, phi, and, times w, the pressure's
/// force on balls -grad p (3), the exchange coefficient over the balls' volume K, the drag K (u - u_s) (3),
/// the balls' velocity u_s (3), the fluid's density, and the balls' Sauter diameter.
inline constexpr std::size_t ball_components = 14;

/// A stretch of a flow, in sums over time and volume.
struct SlurrySegment {
  double begin = 0;                ///< flow time, s
  double end = 0;                  ///< s
  long long samples = 0;           ///< times at which the fields were taken
  double duration = 0;             ///< that the samples represent, s
  double slurry = 0;               ///< integral over time of the slurry's volume in the cells, m^3 s
  std::vector<double> volume;      ///< [n] of the cells' parts in each voxel, m^3 s
  std::size_t width = 0;           ///< number of components: slurry_components, or that and ball_components
  std::vector<double> components;  ///< [n][width], see there, times m^3 s

  /// An empty one of n voxels, with or without what balls feel.
  explicit SlurrySegment(std::size_t voxels = 0, bool balls = false)
      : volume(voxels, 0.0),
        width(slurry_components + (balls ? ball_components : 0)),
        components(voxels * width, 0.0) {}

  /// Adds fields that were sampled once, for so many seconds.
  /// @param sample  with `width` components
  /// @param slurry_volume  in all cells, m^3
  /// @param seconds  of flow time that the sample represents
  void add(const VoxelSums& sample, double slurry_volume, double seconds);

  /// Adds another stretch's sums; the times become those that both cover.
  void add(const SlurrySegment& other);
};

/// Throws SlurryFileError when there is something at `path` that is no slurry file, so that no other file is
/// lost to a name typed wrong.
void require_slurry_or_nothing(const std::filesystem::path& path);

/// Writes a segment; a run that is killed leaves nothing that looks whole. Throws SlurryFileError.
void write_segment(const std::filesystem::path& path, const BoxGrid& grid, const SlurrySegment& segment);

/// Reads it back. Throws SlurryFileError, also when it was written for another grid, by a version with
/// another layout, or has what balls feel and `balls` is false, or the other way round.
SlurrySegment read_segment(const std::filesystem::path& path, const BoxGrid& grid, bool balls = false);

/// Number of the window [k w, (k+1) w) in which a segment lies; `name` is the segment's, for the message.
/// Throws SlurryFileError when it lies in two.
long long window_of(const SlurrySegment& segment, double window, const std::string& name);

/// What the force on balls was computed with.
struct BallsHeader {
  std::string law = {};             ///< of the drag
  bool polydispersity = false;      ///< whether the flow's drag had the factor of a mixture of sizes
  double slurry_density = 0;        ///< kg/m^3
  double air_density = 0;           ///< kg/m^3
  std::array<double, 3> gravity{};  ///< m/s^2
};

/// What holds for a whole slurry file.
struct SlurryHeader {
  double time0 = 0;                       ///< DEM time at flow time 0, s
  double window = 0;                      ///< length of the windows, s
  double start = 0;                       ///< flow time from which the mean over the run is taken, s
  std::string program = {};               ///< that writes the file, with its version
  std::string mill_flow = {};             ///< fingerprint of the mill; empty: not known
  std::optional<BallsHeader> balls = {};  ///< of a flow with balls, whose segments have what they feel
};

/// Joins a flow's segments, in order of time: means over windows [k w, (k+1) w) of flow time, and over all
/// from `start` on. Writes slurry.h5 and, in the same folder, slurry.xdmf; memory does not grow with the
/// number of windows. Windows that the segments do not fill, also between their ends, are marked. Throws
/// SlurryFileError, also when there is no segment, when one lies in two windows or begins before the one
/// before it ends. Returns whether there is a mean over the run: false where no segment lies after `start`.
bool assemble_slurry(const std::filesystem::path& path, const BoxGrid& grid, const SlurryHeader& header,
                     const std::vector<std::filesystem::path>& segments);

}  // namespace millfoam::averaging
