// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace millfoam::averaging {

/// Where the particles' volume went, m^3: volume_in = deposited + outside.
struct Ledger {
  double volume_in = 0;  ///< of all particles
  double deposited = 0;  ///< in the grid's cells
  double outside = 0;    ///< beyond the grid
  double clipped = 0;    ///< of the deposited: moved to neighbours, from within walls or above a cap
};

/// Adds another ledger, entry by entry.
inline Ledger& operator+=(Ledger& ledger, const Ledger& other) {
  ledger.volume_in += other.volume_in;
  ledger.deposited += other.deposited;
  ledger.outside += other.outside;
  ledger.clipped += other.clipped;
  return ledger;
}

}  // namespace millfoam::averaging
