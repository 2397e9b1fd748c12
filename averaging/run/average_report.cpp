// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "averaging/run/average_run.hpp"
#include "averaging/files/solids_layout.hpp"

namespace millfoam::averaging {

namespace {

template <typename... Arguments>
std::string formatted(const char* format, Arguments... arguments) {
  char line[200];
  std::snprintf(line, sizeof line, format, arguments...);
  return line;
}

double percent(double part, double whole) {
  return whole > 0 ? 100 * part / whole : 0;
}

/// The row of one column of the ledger: its mean over the windows, and the window where its share of the
/// particle volume (of the volume itself: its value) is farthest from the mean.
std::string ledger_row(const AverageSummary& summary, const layout::LedgerColumn& column) {
  const std::vector<Ledger>& ledgers = summary.ledgers;
  Ledger mean;
  for (const Ledger& ledger : ledgers) {
    mean.volume_in += ledger.volume_in / static_cast<double>(ledgers.size());
    mean.*column.value +=
        column.value == &Ledger::volume_in ? 0 : ledger.*column.value / static_cast<double>(ledgers.size());
  }
  const auto share = [&](const Ledger& ledger) {
    return percent(ledger.*column.value,
                   column.value == &Ledger::volume_in ? mean.volume_in : ledger.volume_in);
  };
  const auto distance = [&](const Ledger& ledger) { return std::abs(share(ledger) - share(mean)); };
  const auto worst = std::max_element(ledgers.begin(), ledgers.end(), [&](const Ledger& a, const Ledger& b) {
    return distance(a) < distance(b);
  });
  const auto window = static_cast<std::size_t>(worst - ledgers.begin());
  return formatted("%-12s %14.6e %12.4f %14.4f  window %zu, from %g s\n", column.name, mean.*column.value,
                   share(mean), share(*worst), window, summary.windows[window].begin);
}

/// What the laws of drag need of an averaging volume, where it is missed.
std::string advice(const AverageSummary& summary) {
  std::string text;
  if (summary.balls_per_occupied_voxel < 8) {
    text +=
        "advice: fewer than the 8 to 64 balls per averaging volume that the drag laws were derived on: "
        "coarser "
        "voxels would suit them better\n";
  } else if (summary.balls_per_occupied_voxel > 64) {
    text +=
        "advice: more than the 8 to 64 balls per averaging volume that the drag laws were derived on: finer "
        "voxels "
        "would show more\n";
  }
  if (summary.largest_solidity >= 1) {
    text +=
        "warning: the largest solidity leaves no room for the fluid, a flow will refuse it: use voxels "
        "larger than "
        "the balls\n";
  } else if (summary.largest_solidity > 0.74) {
    text +=
        "advice: the largest solidity is above that of the densest packing of equal spheres, 0.74: the "
        "voxels are "
        "small for the balls, or the balls overlap\n";
  }
  return text;
}

}  // namespace

std::string report(const AverageSummary& summary) {
  std::string text = formatted("%-12s %14s %12s %14s\n", "ledger", "mean, m3", "mean, %", "farthest, %");
  for (const layout::LedgerColumn& column : layout::ledger) text += ledger_row(summary, column);
  text += formatted("%zu records in %zu windows from %g to %g s\n", summary.dumps, summary.windows.size(),
                    summary.windows.front().begin, summary.windows.back().end);
  text += formatted("solidity where occupied: mean %.4f, largest %.4f\n", summary.occupied_solidity,
                    summary.largest_solidity);
  text += formatted("balls per occupied voxel: mean %.3g\n", summary.balls_per_occupied_voxel);
  return text + advice(summary);
}

}  // namespace millfoam::averaging
