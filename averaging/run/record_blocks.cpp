// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/record_blocks.hpp"

#include <algorithm>
#include <iterator>
#include <set>

namespace millfoam::averaging {

std::vector<RecordBlock> plan_blocks(const std::vector<WindowPlan>& plans, std::size_t largest) {
  std::set<std::size_t> cuts;
  std::vector<bool> used;
  for (const WindowPlan& plan : plans) {
    for (const WindowSpan& span : plan.windows) {
      const std::size_t last = span.first_record + span.records;
      cuts.insert({span.first_record, last});
      used.resize(std::max(used.size(), last), false);
      std::fill(used.begin() + static_cast<std::ptrdiff_t>(span.first_record),
                used.begin() + static_cast<std::ptrdiff_t>(last), true);
    }
  }
  std::vector<RecordBlock> blocks;
  for (auto cut = cuts.begin(); std::next(cut) != cuts.end(); ++cut) {
    if (!used[*cut]) continue;
    for (std::size_t first = *cut; first < *std::next(cut); first += largest) {
      blocks.push_back({first, std::min(first + largest, *std::next(cut))});
    }
  }
  return blocks;
}

}  // namespace millfoam::averaging
