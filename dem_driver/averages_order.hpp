// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "averaging/run/live_averages.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// Averages that are made while the mill turns.
struct OrderedAverages {
  std::string id;  ///< `averages_id`
  /// Without outputs, which millDem writes when the run is complete; its files as they are found from the
  /// order's folder.
  averaging::AverageRequest request;
};

/// What millLiggghts needs besides the deck to make averages.
struct AveragesOrder {
  averaging::LiveRun run;                 ///< of which averages are made
  std::vector<OrderedAverages> averages;  ///< at least one
};

/// Identifies what a request averages and how: a hash of its settings and of the bytes of the files that it
/// reads, 16 hexadecimal digits. The outputs' names do not change it.
std::string averages_id(const averaging::AverageRequest& request);

/// The files of averages in the folder of an order.
/// @param dem  the folder
/// @param number  of the averages, from 0
averaging::LiveFiles averages_files(const std::filesystem::path& dem, std::size_t number);

/// Writes `dem/averages.json` (FORMATS.md), which appears whole or not at all; paths in it are relative to
/// its folder. Throws std::runtime_error naming the file.
void write_averages_order(const std::filesystem::path& file, const meshing::Mill& mill,
                          const AveragesOrder& order);

/// Reads it back. Throws std::runtime_error naming the file, and the key that is missing or wrong.
AveragesOrder read_averages_order(const std::filesystem::path& file);

}  // namespace millfoam::dem_driver
