// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace millfoam::averaging {

/// The name of the .xdmf beside a solids file: NAME.xdmf for NAME.h5.
/// Throws SolidsFileError when the solids file itself is called so.
std::filesystem::path xdmf_path(const std::filesystem::path& solids_file);

/// Writes NAME.xdmf beside the complete solids file NAME.h5, so that ParaView shows its fields per voxel,
/// with the windows as time-steps at the DEM times at which they begin. Returns its name. Throws
/// SolidsFileError when the solids file cannot be read or the .xdmf cannot be written.
std::filesystem::path write_xdmf(const std::filesystem::path& solids_file);

}  // namespace millfoam::averaging
