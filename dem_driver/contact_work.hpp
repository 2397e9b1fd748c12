// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace millfoam::dem_driver {

/// What a contact takes from the motion of its two bodies, J. Over a whole contact, from first touch to
/// separation, each part is dissipated. Before that, it includes the energy of the contact's springs.
struct ContactWork {
  double normal = 0;      ///< of the force along the normal
  double tangential = 0;  ///< of the tangential force, with its torque
  double rolling = 0;     ///< of the rest of the torque, rolling friction
  /// The sum of the three, J.
  double total() const { return normal + tangential + rolling; }
  /// Adds the parts of another.
  ContactWork& operator+=(const ContactWork& other) {
    normal += other.normal;
    tangential += other.tangential;
    rolling += other.rolling;
    return *this;
  }
};

/// The force of a contact on its first body, which is a ball. The second one, a ball or a wall, feels the
/// opposite force.
struct ContactForce {
  std::array<double, 3> normal = {};     ///< unit vector from the second body to the first
  double push = 0;                       ///< the force along the normal, N; positive: pushes apart
  std::array<double, 3> force = {};      ///< whole force, N
  std::array<double, 3> torque = {};     ///< whole torque, N m
  std::array<double, 3> arm = {};        ///< from the first centre to the point at which the force acts, m
  std::array<double, 3> other_arm = {};  ///< of the second centre, m; 0 of a wall
};

/// The motion of the two bodies of a contact.
struct ContactMotion {
  std::array<double, 3> velocity = {};  ///< of the first body less that of the second, m/s; of a wall, at the
                                        ///< contact
  std::array<double, 3> spin = {};      ///< of the first, rad/s
  std::array<double, 3> other_spin = {};  ///< of the second, rad/s; 0 of a wall
};

/// The tangential part of the force, N.
std::array<double, 3> tangential_force(const ContactForce& contact);

/// The work of one step, -(F . v + T . w) dt, in three parts. It is exact for the velocity Verlet method,
/// whose force of step n changes the kinetic energy between the half steps before and after n, if the motion
/// is that of the whole step n, and the force is the one that LIGGGHTS applied at n.
/// @param contact  the force
/// @param motion  of its bodies
/// @param timestep  dt, s
ContactWork work_of(const ContactForce& contact, const ContactMotion& motion, double timestep);

}  // namespace millfoam::dem_driver
