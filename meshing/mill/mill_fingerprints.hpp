// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "meshing/mill/mill.hpp"

namespace millfoam::meshing {

/// FNV-1a hash of bytes, 16 hexadecimal digits: tells two states of a text apart.
std::string fingerprint(const std::string& bytes);

/// The fingerprints of a mill whose keys have these values.
MillFingerprints fingerprints(const nlohmann::ordered_json& keys);

/// An object with the keys walls, charge, averages and flow.
nlohmann::ordered_json to_json(const MillFingerprints& fingerprints);

}  // namespace millfoam::meshing
