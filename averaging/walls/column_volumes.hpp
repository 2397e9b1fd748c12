// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace millfoam::averaging {

/// Volumes below a surface in columns of equal slabs, out of pieces of the surface that lie in one slab each.
class ColumnVolumes {
 public:
  /// @param columns  number of columns
  /// @param slabs    in each of them
  ColumnVolumes(std::size_t columns, std::size_t slabs) : slabs_(slabs), pieces_(columns * (slabs + 1)) {}

  /// Adds a piece that lies in slab number `slab`, or beyond the last one.
  /// @param column  number of the column, from 0
  /// @param slab    from 0; the number of slabs means beyond the last one
  /// @param area    of its projection along the column, m^2, positive where the surface looks upwards
  /// @param volume  between it and the bottom of the slab, m^3, with the area's sign; of no use beyond the
  /// last
  void add(std::size_t column, std::size_t slab, double area, double volume) {
    Piece& sum = pieces_[column * (slabs_ + 1) + slab];
    sum.area += area;
    sum.volume += volume;
  }

  /// Calls `take(slab, volume)` for the slabs of a column: what is below the pieces in it, and the whole slab
  /// below those above it.
  template <typename Take>
  void for_each_slab(std::size_t column, double height, Take&& take) const {
    const Piece* const slab = &pieces_[column * (slabs_ + 1)];
    double above = slab[slabs_].area;
    for (std::size_t s = slabs_; s-- > 0;) {
      take(s, slab[s].volume + height * above);
      above += slab[s].area;
    }
  }

 private:
  struct Piece {
    double area = 0;
    double volume = 0;
  };
  std::size_t slabs_;
  std::vector<Piece> pieces_;  ///< [columns][slabs + 1]
};

/// A volume between 0 and that of the voxel, without the round-off at either end.
inline double without_round_off(double volume, double voxel) {
  const double round_off = 1e-12 * voxel;
  if (volume < round_off) return 0;
  return volume > voxel - round_off ? voxel : volume;
}

}  // namespace millfoam::averaging
