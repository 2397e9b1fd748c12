// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "averaging/exchange/exchange_pipes.hpp"
#include "averaging/files/slurry_reader.hpp"
#include "averaging/grids/box_grid.hpp"
#include "averaging/values/solids_window.hpp"

/// @file
/// What a run of balls and a flow tell each other: first who they are, then fields in turn. The flow asks for
/// the balls of a time and gives the forces that act until then; the balls answer with what they are then.
/// Every message is packed and unpacked here; `unpack` functions throw ExchangeError for a message of another
/// length. Times are the flow's, s.

namespace millfoam::averaging {

/// The first message of the flow.
struct FlowOffer {
  bool polydispersity = false;  ///< a ball of diameter d feels the exchange of its own size
  double time = 0;              ///< at which it begins
  std::string program;          ///< with its version

  /// Of its message.
  static constexpr char kind[] = "flow";
};

/// The answer of the balls.
struct BallsOffer {
  BoxGrid grid;                            ///< on which solids and forces are given
  double time0 = 0;                        ///< DEM time at flow time 0, s
  std::optional<double> angular_velocity;  ///< of the mill about z, rad/s
  std::string program;                     ///< with its version
  std::string mill;                        ///< fingerprint of the mill's averages

  /// Of its message.
  static constexpr char kind[] = "balls";
};

/// Forces, and the time for which the flow asks the balls.
struct ForcesUntil {
  double time = 0;    ///< until which they act
  double torque = 0;  ///< of the flow's cells on all balls about +z, N m
  BallFields fields;  ///< on the balls' grid

  /// Of its message.
  static constexpr char kind[] = "forces";
};

/// The balls at a time.
struct SolidsAt {
  double time = 0;       ///< of the DEM step that is nearest to the one that was asked for
  double deposited = 0;  ///< volume of the balls in the grid, m^3
  SolidsWindow fields;   ///< on the balls' grid

  /// Of its message.
  static constexpr char kind[] = "solids";
};

/// Kind of the message by which the flow ends the exchange; it has no content.
inline constexpr char exchange_end[] = "end";

/// As a message.
ExchangeMessage pack(const FlowOffer& offer);
/// As a message.
ExchangeMessage pack(const BallsOffer& offer);
/// As a message.
ExchangeMessage pack(const ForcesUntil& forces);
/// As a message.
ExchangeMessage pack(const SolidsAt& solids);

/// Back from a message.
FlowOffer unpack_flow_offer(const ExchangeMessage& message);
/// Back from a message.
BallsOffer unpack_balls_offer(const ExchangeMessage& message);
/// Back from a message, for a grid of so many voxels.
ForcesUntil unpack_forces(const ExchangeMessage& message, std::size_t voxels);
/// Back from a message, for a grid of so many voxels.
SolidsAt unpack_solids(const ExchangeMessage& message, std::size_t voxels);

}  // namespace millfoam::averaging
