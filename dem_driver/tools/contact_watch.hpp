// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace millfoam::dem_driver {

/// From now on follows every contact in every step and writes the segments of contact_record.hpp into the
/// present folder.
/// @param order  contacts.json
/// Throws std::runtime_error naming a file that cannot be read or written, and where the walls in LIGGGHTS
/// are not those of the files.
void watch_contacts(LAMMPS_NS::LAMMPS& liggghts, const std::filesystem::path& order);

}  // namespace millfoam::dem_driver
