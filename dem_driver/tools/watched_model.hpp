// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "dem_driver/contact_work.hpp"

namespace LAMMPS_NS {
class Atom;
class FixMeshSurface;
}  // namespace LAMMPS_NS

namespace millfoam::dem_driver {

/// A contact as the contact model has computed it in this step.
struct Seen {
  int ball = 0;   ///< index of the ball, which is the first body
  int other = 0;  ///< of the second one, or not used
  double energy = 0;
  ContactForce contact;
};

/// One at a wall.
struct SeenAtWall : Seen {
  LAMMPS_NS::FixMeshSurface* part = nullptr;
  int triangle = 0;
  std::array<double, 3> velocity = {};  ///< of the wall
  std::array<double, 3> point = {};     ///< lab frame
};

/// What the contact model hands over during a step, on each rank. Of two balls on two ranks, the rank of the
/// ball with the lower id has the contact.
class Collector {
 public:
  /// From now on takes the contacts of these balls; before, none.
  void follow(const LAMMPS_NS::Atom* atom) { atom_ = atom; }
  /// The balls whose contacts are followed, or null.
  const LAMMPS_NS::Atom* followed() const { return atom_; }
  void clear() {
    balls.clear();
    walls.clear();
  }
  std::vector<Seen> balls;        ///< of two balls
  std::vector<SeenAtWall> walls;  ///< of a ball and a triangle of a wall

 private:
  const LAMMPS_NS::Atom* atom_ = nullptr;
};

/// The only one: LIGGGHTS makes its contact models itself, so they cannot be given another.
Collector& collector();

/// Adds the surface model `watched` (deck.hpp) to LIGGGHTS' library: the contact model of the decks, which
/// also hands its contacts to `collector`. To be called before the deck is read.
void add_watched_model();

}  // namespace millfoam::dem_driver
