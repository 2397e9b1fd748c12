// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "meshing/mill/mill_reader.hpp"
#include "meshing/mill_mesh/openings.hpp"

namespace millfoam::meshing {

/// Writes `constant/millProperties`: the mill's numbers and the settings of its flow, which dictionaries of
/// the case take in with `#include`. The areas are those of `openings`, which the mesh has. `time` is the DEM
/// time, s, that the case's mesh is turned to. Entries: FORMATS.md.
void write_mill_properties(const MillDescription& description, const Openings& openings, double time,
                           const std::filesystem::path& case_folder);

}  // namespace millfoam::meshing
