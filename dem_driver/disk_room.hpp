// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/dem_plan.hpp"

namespace millfoam::dem_driver {

/// Bytes that the dumps, of contacts too, the restart file and the averages made in the run need at least,
/// from step `begin` on.
double least_disk(const DemPlan& plan, long begin);

/// Throws std::runtime_error with both numbers when the rest of the run, from step `begin` on, cannot fit on
/// the disk, although the dumps after that step are removed first.
void require_room(const CaseFolder& folder, const DemPlan& plan, long begin);

/// "the disk is full, 0 MB are free" when there is less room than a dump of so many balls may need, else
/// "… MB are free on the disk: …" with what may limit a file otherwise.
std::string free_in_words(const std::filesystem::path& folder, long balls);

}  // namespace millfoam::dem_driver
