// SPDX-License-Identifier: GPL-3.0-or-later
// For sources only: no public header of this room names a JSON type.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "dem_driver/charge_plan.hpp"
#include "meshing/files/json_object.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// JSON whose keys keep the order in which they were added.
using Json = nlohmann::ordered_json;

/// A file that this room has written for millLiggghts. Throws std::runtime_error naming it when it cannot be
/// read or is of another format; what is wrong with its keys ends with the advice to run millDem again.
JsonObject read_order(const std::filesystem::path& file, const std::string& format);

/// The head of a result that `millDem` leaves: "format" ("millfoam-<what>"), "program" with its version, and
/// "mill", the fingerprints walls and charge, which are all that a dry run depends on.
Json begin_result(const std::string& what, const meshing::Mill& mill);

/// Adds angular_velocity_rad_s and sense.
void add_rotation(Json& result, const meshing::Mill& mill);

/// Adds number, diameters and masses of the charge: what is simulated, what is asked, what is left out.
void add_charge(Json& result, const meshing::Mill& mill, const ChargePlan& charge);

/// Writes it with an indent of two blanks and a line end; numbers that are not finite become null. The file
/// appears whole or not at all. Throws std::runtime_error naming it when it cannot be written.
void write_json(const std::filesystem::path& file, const Json& result);

}  // namespace millfoam::dem_driver
