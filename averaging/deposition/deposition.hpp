// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "averaging/values/particle.hpp"

namespace millfoam::averaging {

/// The volume of a ball that lies in one cell.
struct Deposit {
  std::size_t cell = 0;  ///< its place in a field on the grid or mesh
  double volume = 0;     ///< m^3, positive
};

/// Deposits the volume of balls in the cells of a grid or mesh, as other codes deposit mass or charge: one
/// class for each kind of grid and method. Copies share what takes long to prepare (templates,
/// search structures); one copy serves one thread.
class Deposition {
 public:
  virtual ~Deposition() = default;

  /// Another one for another thread.
  virtual std::unique_ptr<Deposition> clone() const = 0;

  /// Brings what moves to its place at a DEM time, s. Must be called before the balls of a record are
  /// deposited. Throws what the mesh's motion throws for a time at which it is not known.
  virtual void begin_record(double time) { static_cast<void>(time); }

  /// Volumes of the cells at the time of the record, [cells], m^3.
  virtual const std::vector<double>& volumes() const = 0;

  /// Deposits a sphere.
  /// @param sphere    centre and radius in m, in the lab's frame
  /// @param deposits  overwritten; a cell may appear more than once, in an order that depends only on the
  ///                  arguments. The rest of the sphere's volume lies outside all cells.
  /// The exact methods on voxels throw as `GridAxis::cut`.
  virtual void deposit(const Particle& sphere, std::vector<Deposit>& deposits) = 0;

  /// Deposits a superquadric by sampling, with any method for spheres; its volume is
  /// `superquadric_volume(shape)`, m^3. Throws as that.
  virtual void deposit(const Particle& particle, const Superquadric& shape,
                       std::vector<Deposit>& deposits) = 0;

  /// A particle's velocity, m/s, along the directions that the fields have: x, y and z, or others where it is
  /// said so.
  virtual Vector3 field_velocity(const Particle& particle) const { return particle.velocity; }

 protected:
  Deposition() = default;
  Deposition(const Deposition&) = default;
  Deposition& operator=(const Deposition&) = default;
};

}  // namespace millfoam::averaging
