// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "averaging/grids/box_grid.hpp"
#include "averaging/dumps/dump_reader.hpp"
#include "averaging/files/solids_file.hpp"
#include "averaging/overlap/sphere_template.hpp"

namespace millfoam::averaging {

/// Sums over the particles of one record, per voxel of a grid of n voxels. V is the part of a particle's
/// volume in the voxel, d its diameter, v its velocity.
struct RecordSums {
  std::vector<double> volume;                 ///< [n] sum V, m^3
  std::vector<double> momentum;               ///< [n][3] sum V v, m^4/s
  std::vector<double> volume_over_diameter;   ///< [n] sum V/d, m^2
  std::vector<double> volume_times_diameter;  ///< [n] sum V d, m^4
  std::vector<double> volume_times_speed2;    ///< [n] sum V |v|^2, m^5/s^2
  Ledger ledger;                              ///< of this record
  double balls = 0;  ///< number of balls deposited, a part of a ball counting as that part

  explicit RecordSums(std::size_t voxels);
};

/// Adds a sphere: the voxel gets the share of its volume that the share of the template's points in it is.
/// What lies outside the grid goes to the ledger; along periodic axes the points come in on the other side. A
/// sphere wholly in one voxel gives it exactly its volume.
///
/// The template's coordinates along an axis do not depend on those along the others, so the points in a voxel
/// are a block of the lattice, counted by a table: the cost is a few look-ups per voxel met, whatever the
/// template's size.
void deposit(const BoxGrid& grid, const SphereTemplate& points, const Particle& particle, RecordSums& sums);

/// The sums over all particles of a record.
RecordSums sample_record(const BoxGrid& grid, const SphereTemplate& points, const ParticleRecord& record);

}  // namespace millfoam::averaging
