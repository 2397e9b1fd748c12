// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/surface/face_edges.hpp"

#include <tuple>

namespace millfoam::surface {

EdgeTable table_of(std::vector<FaceSide> sides) {
  std::sort(sides.begin(), sides.end(), [](const FaceSide& a, const FaceSide& b) {
    return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
  });
  EdgeTable table;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool is_new = i == 0 || sides[i].low != sides[i - 1].low || sides[i].high != sides[i - 1].high;
    if (is_new) table.begin.push_back(i);
  }
  table.begin.push_back(sides.size());
  table.sides = std::move(sides);
  return table;
}

}  // namespace millfoam::surface
