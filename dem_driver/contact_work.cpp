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
  // The torque of the tangential force is -arm (n x F) on both bodies
  const Triple lever = cross(contact.normal, tangential);
  Triple rolling, roll, turn;
  for (std::size_t k = 0; k < 3; ++k) {
    rolling[k] = contact.torque[k] + contact.arm * lever[k];
    roll[k] = motion.spin[k] - motion.other_spin[k];
    turn[k] = contact.arm * motion.spin[k] + contact.other_arm * motion.other_spin[k];
  }
  return {-contact.push * dot(contact.normal, motion.velocity) * timestep,
          -(dot(tangential, motion.velocity) - dot(lever, turn)) * timestep, -dot(rolling, roll) * timestep};
}

}  // namespace millfoam::dem_driver
