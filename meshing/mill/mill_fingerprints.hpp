// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "meshing/mill/mill.hpp"

namespace millfoam::meshing {

/// The numbers of the materials and contacts, by the keys of `materials`, with units in their names.
nlohmann::ordered_json materials_numbers(const Mill& mill);

/// The fingerprints of a mill.
/// @param keys  values of all keys of its description
/// @param mill  the same, read
MillFingerprints fingerprints(const nlohmann::ordered_json& keys, const Mill& mill);

/// An object with the keys walls, charge, averages and flow.
nlohmann::ordered_json to_json(const MillFingerprints& fingerprints);

}  // namespace millfoam::meshing
