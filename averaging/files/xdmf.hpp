// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "averaging/grids/grid.hpp"

namespace millfoam::averaging {

/// The name of the .xdmf of a solids file: NAME.xdmf for NAME.h5.
/// Throws SolidsFileError when the solids file itself has this name.
std::filesystem::path xdmf_path(const std::filesystem::path& solids_file);

/// Throws SolidsFileError when there is something at `path` that is no file for ParaView as written here.
void require_xdmf_or_nothing(const std::filesystem::path& path);

/// A data set [window][cells], or of vectors [window][cells][3], as ParaView is to show it.
struct XdmfField {
  std::string name;      ///< that ParaView shows
  std::string data_set;  ///< its place in the file, without the first slash
  bool vector = false;   ///< three components per cell
};

/// Writes NAME.xdmf for the file of fields NAME.h5: per window, at `times` (s), the fields per cell of the
/// grid in its group /grid. Returns its name. Throws SolidsFileError when it cannot be written.
std::filesystem::path write_xdmf(const std::filesystem::path& fields_file, const std::string& title,
                                 const Grid& grid, const std::vector<double>& times,
                                 const std::vector<XdmfField>& fields);

/// Writes NAME.xdmf for the complete solids file NAME.h5, so that ParaView shows its fields per voxel,
/// with the windows as time-steps at the DEM times at which they begin. Returns its name. Throws
/// SolidsFileError when the solids file cannot be read or the .xdmf cannot be written.
std::filesystem::path write_xdmf(const std::filesystem::path& solids_file);

}  // namespace millfoam::averaging
