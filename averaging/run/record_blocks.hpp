// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "averaging/statistics/time_windows.hpp"

namespace millfoam::averaging {

/// Records [first, last) that are averaged in one go by one thread.
struct RecordBlock {
  std::size_t first = 0;  ///< number of the first record
  std::size_t last = 0;   ///< number of the one after the last
};

/// Cuts the records that the plans use into blocks, such that every window of every plan is made of whole
/// blocks. Results are merged block by block in this order, so they do not depend on how many threads or
/// ranks share the blocks.
/// @param plans    windows of each requested length
/// @param largest  number of records in a block, at most
std::vector<RecordBlock> plan_blocks(const std::vector<WindowPlan>& plans, std::size_t largest);

}  // namespace millfoam::averaging
