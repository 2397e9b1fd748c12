// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/contact_work.hpp"

#include <cstddef>

namespace millfoam::dem_driver {

namespace {

using Triple = std::array<double, 3>;

double dot(const Triple& a, const Triple& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Triple cross(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

Triple tangential_force(const ContactForce& contact) {
  Triple tangential;
  for (std::size_t k = 0; k < 3; ++k) tangential[k] = contact.force[k] - contact.push * contact.normal[k];
  return tangential;
}

ContactWork work_of(const ContactForce& contact, const ContactMotion& motion, double timestep) {
  const Triple tangential = tangential_force(contact);
  const Triple turn = cross(motion.spin, contact.arm),
               other_turn = cross(motion.other_spin, contact.other_arm);
  const Triple of_force = cross(contact.arm, contact.force);
  Triple velocity, rolling, roll;
  for (std::size_t k = 0; k < 3; ++k) {
    velocity[k] = motion.velocity[k] + turn[k] - other_turn[k];
    // What the torque has besides that of the force acts on both bodies
    rolling[k] = contact.torque[k] - of_force[k];
    roll[k] = motion.spin[k] - motion.other_spin[k];
  }
  return {-contact.push * dot(contact.normal, velocity) * timestep, -dot(tangential, velocity) * timestep,
          -dot(rolling, roll) * timestep};
}

}  // namespace millfoam::dem_driver
