// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "averaging/grids/box_grid.hpp"
#include "dem_driver/shape_drag.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// What pushes the balls of a run besides their contacts and their weight.
enum class FluidKind {
  none,      ///< a dry run
  buoyancy,  ///< a pool at rest, PoolForces
  slurry,    ///< a flow's slurry.h5, VoxelForces
  flow       ///< a flow that runs at the same time, FlowExchange
};

/// Which times of a flow act on the balls.
enum class FluidTime {
  mean,    ///< the mean over the flow's run, always
  windows  ///< its time windows: linear between their middles, held before the first and after the last
};

/// The fluid of a run.
struct FluidSettings {
  FluidKind kind = FluidKind::none;  ///< what it is
  double level = 0;                  ///< of the pool, m
  double density = 0;                ///< of the pool, kg/m^3
  std::filesystem::path file = {};   ///< slurry.h5, or the folder of the exchange with a flow
  std::string averages = {};         ///< of the balls for a flow at the same time, as averages_in_words
  std::string file_id = {};          ///< hash of the file's bytes (FNV-1a, 16 hexadecimal digits)
  FluidTime time = FluidTime::mean;  ///< of slurry.h5
  ShapeDrag shapes = {};             ///< of the flow's drag
  /// Whether it acts on balls that are inserted and settle, too: a pool does, a flow only on a turning mill.
  bool acts_at_rest() const { return kind == FluidKind::buoyancy; }
};

/// "none", "buoyancy", "slurry" or "flow".
std::string name_of(FluidKind kind);
/// "mean" or "windows".
std::string name_of(FluidTime time);

/// The pool of `dem.fluid: buoyancy`, or none.
FluidSettings fluid_of(const meshing::Mill& mill);

/// The fluid in words, for the deck and for people: "buoyancy in a pool of 1239 kg/m3 up to y = -0.002 m".
std::string in_words(const FluidSettings& fluid);

/// What an exchange with a flow needs: how balls are averaged for it, and what its drag may be.
struct ExchangeOrder {
  averaging::BoxGrid grid;   ///< of the balls' averages
  bool exact = true;         ///< volumes, instead of samples
  int template_points = 12;  ///< along a diameter, of samples
  std::vector<std::filesystem::path> walls =
      {};                        ///< STL files at DEM time 0, as found from the order's folder
  double angular_velocity = 0;   ///< of the mill about z, rad/s
  std::string mill = {};         ///< fingerprint of its averages
  double ball_density = 0;       ///< kg/m^3
  double smallest_ball = 0;      ///< diameter, m
  double rayleigh_fraction = 0;  ///< dem.rayleigh_fraction, for messages
  long begin = 0;                ///< step of the turning mill at which the flow begins
  long end = 0;                  ///< last step of the run
};

/// What millLiggghts needs besides the deck.
struct FluidOrder {
  FluidSettings fluid;    ///< not FluidKind::none; `file` as found from the order's folder
  double timestep = 0;    ///< s
  long record_steps = 0;  ///< between two lines of the ledger
  std::optional<ExchangeOrder> exchange = {};  ///< of FluidKind::flow
};

/// The exchange of a run of this mill with a flow.
/// @param mill  whose section `averages` is taken
/// @param walls  STL files, as found from dem/
/// @param begin, end  first and last step of the run
ExchangeOrder exchange_of(const meshing::Mill& mill, const std::vector<std::filesystem::path>& walls,
                          long begin, long end);

/// How balls are averaged for a flow that runs at the same time, in words: "exact averages on 33 x 33 x 8
/// voxels from (-0.06 -0.06 0) to (0.06 0.06 0.03) m".
std::string averages_in_words(const meshing::Mill& mill);

/// Writes `dem/fluid.json` (FORMATS.md), which appears whole or not at all; paths in it are relative to its
/// folder. Throws std::runtime_error naming the file.
void write_fluid_order(const std::filesystem::path& file, const meshing::Mill& mill, const FluidOrder& order);

/// Reads it back. Throws std::runtime_error naming the file, and the key that is missing or wrong.
FluidOrder read_fluid_order(const std::filesystem::path& file);

}  // namespace millfoam::dem_driver
