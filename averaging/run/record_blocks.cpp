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
    const std::size_t records = *std::next(cut) - *cut;
    // Of equal length, so that the threads that share them wait little for each other.
    const std::size_t parts = (records + largest - 1) / largest;
    for (std::size_t n = 0; n < parts; ++n) {
      blocks.push_back({*cut + n * records / parts, *cut + (n + 1) * records / parts});
    }
  }
  return blocks;
}

}  // namespace millfoam::averaging
