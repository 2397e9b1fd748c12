// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "averaging/values/particle.hpp"

namespace millfoam::averaging {

/// The part of a ball that lies in a cell.
struct Share {
  std::size_t cell = 0;
  double volume = 0;  ///< m^3, positive
};

/// How balls are shared between the cells of a grid or mesh: one class for each kind of grid and method. What
/// takes long to prepare (templates, search structures) is shared between copies; one copy serves one thread.
class CellSharing {
 public:
  virtual ~CellSharing() = default;

  /// Another one for another thread.
  virtual std::unique_ptr<CellSharing> clone() const = 0;

  /// Brings what moves to its place at a DEM time, s. Must be called before the balls of a record are shared.
  virtual void begin_record(double time) { static_cast<void>(time); }

  /// Volumes of the cells at the time of the record, [cells], m^3.
  virtual const std::vector<double>& volumes() const = 0;

  /// Shares a sphere. `shares` is overwritten; a cell may come up more than once, and always in an order that
  /// depends on nothing but the arguments. What is missing to the sphere's volume lies outside all cells.
  virtual void share(const Particle& sphere, std::vector<Share>& shares) = 0;

  /// Shares a superquadric by sampling, whatever the method for spheres; its volume is
  /// `superquadric_volume(shape)`.
  virtual void share(const Particle& particle, const Superquadric& shape, std::vector<Share>& shares) = 0;

 protected:
  CellSharing() = default;
  CellSharing(const CellSharing&) = default;
  CellSharing& operator=(const CellSharing&) = default;
};

}  // namespace millfoam::averaging
