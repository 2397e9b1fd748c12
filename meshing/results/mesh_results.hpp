// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "meshing/mill/mill_reader.hpp"
#include "meshing/mill_mesh/openings.hpp"
#include "meshing/volume/mesh_quality.hpp"
#include "meshing/walls/wall_surface.hpp"

namespace millfoam::meshing {

/// Writes `mesh.json` of a case: cells, quality against its limits, areas of the openings, and the DEM time
/// `time` (s) that the mesh is turned to. Layout: FORMATS.md.
void write_mesh_results(const MillDescription& description, const VolumeMesh& mesh,
                        const MeshQuality& quality, const Openings& openings, double time,
                        const std::filesystem::path& case_folder,
                        const QualityLimits& limits = QualityLimits());

/// Writes `walls/walls.json`: where the walls come from, the box and the volume (m^3) that they enclose.
/// Without a description they come from CAD and belong to no fingerprint.
void write_wall_results(const std::optional<MillDescription>& description, const WallSurface& walls,
                        double volume, const std::filesystem::path& walls_folder);

/// DEM time to which a flow's mesh is turned.
struct FlowBegin {
  double time = 0;   ///< s
  std::string note;  ///< a sentence where it may still change; otherwise empty
};

/// When the flow of a case begins: at `time0_s` of its folder's `solids.json`. While there is none of this
/// mill's averages, at `averages.start`, or at 0 where that is `steady`. Averages without a fingerprint may
/// be any mill's. A flow without balls begins at `averages.start`, or 0. Throws std::runtime_error for a
/// solids.json that cannot be read or has no time0_s, and, where `averages.start` is `steady`, for one of
/// another mill's averages.
FlowBegin start_of_flow(const Mill& mill, const std::filesystem::path& case_folder);

}  // namespace millfoam::meshing
