// SPDX-License-Identifier: GPL-3.0-or-later
// In the place of watched_model.cpp and contact_watch.cpp where balls are superquadrics: mill.yaml refuses
// statistics of their contacts.
#include <stdexcept>

#include "dem_driver/tools/contact_watch.hpp"
#include "dem_driver/tools/watched_model.hpp"

namespace millfoam::dem_driver {

void add_watched_model() {}

void watch_contacts(LAMMPS_NS::LAMMPS&, const std::filesystem::path& order) {
  throw std::runtime_error(order.string() + ": contacts of superquadrics are not followed, expected spheres");
}

}  // namespace millfoam::dem_driver
