// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "dem_driver/case_folder.hpp"

namespace millfoam::dem_driver {

/// Makes the folders and removes dumps, contacts, run file, results, restart files, states of averages and
/// histories of an earlier run, so that two runs never mix. Nothing else is removed. Returns the number of
/// dumps removed.
std::size_t prepare_folders(const CaseFolder& folder);

}  // namespace millfoam::dem_driver
