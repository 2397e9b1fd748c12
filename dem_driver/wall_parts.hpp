// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "dem_driver/case_folder.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// The wall parts of this mill: shell, lifters (if any), and for plain ends feedEnd and dischargeEnd, each of
/// which may be missing where the others close that end; of a stirred mill impeller, shell, base and lid.
/// Each file is read. Throws std::runtime_error naming the first `walls/<part>.stl` that is missing, that
/// read_wall refuses, or with which the walls are not those of this mill (require_fit).
std::vector<std::string> find_walls(const CaseFolder& folder, const meshing::Mill& mill);

/// Fingerprint (FNV-1a, 16 hexadecimal digits) of the file of each wall, by its name without `.stl`.
std::map<std::string, std::string> wall_fingerprints(const CaseFolder& folder,
                                                     const std::vector<std::string>& parts);

/// One line of comment for each wall with a checksum (FNV-1a) of its file: a deck that has them belongs to
/// these walls only.
std::string wall_checksums(const CaseFolder& folder, const std::vector<std::string>& parts);

/// Wall of a stirred mill that turns.
inline constexpr char impeller_part[] = "impeller";
/// All walls of a stirred mill.
inline constexpr const char* stirred_parts[] = {impeller_part, "shell", "base", "lid"};
/// The walls that turn: all of a tumbling mill's; of a stirred mill's the impeller alone.
std::vector<std::string> turning_parts(const meshing::Mill& mill, const std::vector<std::string>& parts);

}  // namespace millfoam::dem_driver
