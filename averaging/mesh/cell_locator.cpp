// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/cell_locator.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "averaging/values/as_index.hpp"

namespace millfoam::averaging {

namespace {

using Eigen::Array3i;
using Eigen::Vector3d;

/// Place along Morton's curve, by 10 bits of each whole coordinate: near in space is near along it.
std::uint32_t morton(const Array3i& place) {
  std::uint32_t code = 0;
  for (int bit = 0; bit < 10; ++bit) {
    for (int axis = 0; axis < 3; ++axis) {
      code |= ((static_cast<std::uint32_t>(place[axis]) >> bit) & 1U) << (3 * bit + axis);
    }
  }
  return code;
}

/// Numbers 0 to n - 1 in rising order of `place(i)` along Morton's curve.
template <typename Place>
std::vector<int> spatial_order(std::size_t n, Place&& place) {
  std::vector<std::pair<std::uint32_t, int>> keyed;
  keyed.reserve(n);
  for (int i = 0; as_index(i) < n; ++i) keyed.emplace_back(morton(place(i)), i);
  std::sort(keyed.begin(), keyed.end());
  std::vector<int> order;
  order.reserve(n);
  for (const auto& [code, i] : keyed) order.push_back(i);
  return order;
}

std::vector<int> order_of_cells(const MeshGeometry& geometry) {
  const Eigen::AlignedBox3d& box = geometry.box();
  const double scale = 1023 / box.sizes().maxCoeff();
  return spatial_order(geometry.cells(), [&](int cell) -> Array3i {
    return ((geometry.centres()[as_index(cell)] - box.min()) * scale).cast<int>();
  });
}

/// Depth of a coarse voxel that some cells meet.
int depth_for(std::size_t cells) {
  constexpr std::size_t crowd = 20;
  return cells > 16 * crowd ? 4 : cells > 2 * crowd ? 3 : cells > crowd ? 2 : 1;
}

}  // namespace

struct CellLocator::Filling {
  int first;                 ///< where the coarse voxel's codes begin
  int depth;                 ///< of the coarse voxel
  Array3i origin;            ///< of the coarse voxel, in smallest fine voxels
  std::vector<int> lists{};  ///< places of the lists made for this coarse voxel
};

CellLocator::CellLocator(std::shared_ptr<const MeshGeometry> geometry)
    : geometry_(std::move(geometry)), containment_(*geometry_, order_of_cells(*geometry_)) {
  lay_grid();
  list_cells();
  voxels_.resize(voxel_begin_.size() - 1);
  // What is near in space is put near in memory, so that coherent points find it in the caches.
  const auto place = [this](int v) -> Array3i {
    return {v % shape_[0], v / shape_[0] % shape_[1], v / (shape_[0] * shape_[1])};
  };
  for (const int v : spatial_order(voxels_.size(), place)) fill_voxel(place(v));
  codes_.shrink_to_fit();
  lists_.shrink_to_fit();
}

void CellLocator::lay_grid() {
  const Eigen::AlignedBox3d& box = geometry_->box();
  const double margin = 1e-9 * box.diagonal().norm();
  lower_ = box.min().array() - margin;
  const Vector3d extent = box.sizes().array() + 2 * margin;
  const double edge = std::cbrt(extent.prod() / static_cast<double>(geometry_->cells()));
  constexpr double most_along_an_axis = 1e5;
  shape_ = (extent / edge).array().round().max(1).min(most_along_an_axis).cast<int>();
  limit_ = shape_.cast<double>() * (1 << deepest);
  per_metre_ = limit_ / extent.array();
}

void CellLocator::list_cells() {
  const Vector3d size = double(1 << deepest) * per_metre_.cwiseInverse();
  const Eigen::Vector3f half = (size / 2 * (1 + 1e-6)).cast<float>();
  std::vector<std::array<int, 2>> found;  // coarse voxel, cell
  for (int cell = 0; as_index(cell) < geometry_->cells(); ++cell) {
    const Eigen::AlignedBox3d& box = geometry_->boxes()[as_index(cell)];
    const Array3i low = ((box.min() - lower_).array() / size.array() - 1e-6).cast<int>().max(0);
    const Array3i high = ((box.max() - lower_).array() / size.array() + 1e-6).cast<int>().min(shape_ - 1);
    for (int k = low[2]; k <= high[2]; ++k) {
      for (int j = low[1]; j <= high[1]; ++j) {
        for (int i = low[0]; i <= high[0]; ++i) {
          const Vector3d middle = lower_ + size.cwiseProduct(Vector3d(i + 0.5, j + 0.5, k + 0.5));
          const CellContainment::LocalPoint local = containment_.local(middle);
          if (containment_.test_box(cell, local, half) == CellContainment::Answer::outside) continue;
          found.push_back({static_cast<int>(index({i, j, k})), cell});
        }
      }
    }
  }
  voxel_begin_.assign(as_index(shape_.prod()) + 1, 0);
  for (const auto& [voxel, cell] : found) ++voxel_begin_[as_index(voxel) + 1];
  for (std::size_t v = 1; v < voxel_begin_.size(); ++v) voxel_begin_[v] += voxel_begin_[v - 1];
  voxel_cells_.resize(found.size());
  std::vector<int> next(voxel_begin_.begin(), voxel_begin_.end() - 1);
  for (const auto& [voxel, cell] : found) voxel_cells_[as_index(next[as_index(voxel)]++)] = cell;
}

void CellLocator::fill_voxel(const Array3i& voxel) {
  const std::size_t v = index(voxel);
  const std::vector<int> cells(voxel_cells_.begin() + voxel_begin_[v],
                               voxel_cells_.begin() + voxel_begin_[v + 1]);
  if (cells.empty()) return;
  const int depth = depth_for(cells.size());
  const auto first = codes_.size();
  codes_.resize(first + (std::size_t{1} << (3 * depth)), outside);
  Filling filling{static_cast<int>(first), depth, voxel * (1 << deepest)};
  fill(filling, filling.origin, deepest, cells);
  const bool all_the_same = std::all_of(codes_.begin() + filling.first, codes_.end(),
                                        [&](int code) { return code == codes_[first]; });
  if (all_the_same) {
    voxels_[v] = {codes_[first], 0};
    codes_.resize(first);
  } else {
    voxels_[v] = {filling.first, depth};
  }
}

/// Fills the cube of 2^level smallest fine voxels along an edge at `corner`.
void CellLocator::fill(Filling& filling, const Array3i& corner, int level, const std::vector<int>& cells) {
  const Vector3d half = per_metre_.cwiseInverse() * (double(1 << level) / 2);
  const Vector3d middle = lower_ + corner.cast<double>().matrix().cwiseQuotient(per_metre_) + half;
  const CellContainment::LocalPoint local = containment_.local(middle);
  const Eigen::Vector3f reach = (half * (1 + 1e-6)).cast<float>();
  std::vector<int> meeting;
  int code = outside;
  for (const int cell : cells) {
    const CellContainment::Answer answer = containment_.test_box(cell, local, reach);
    if (answer == CellContainment::Answer::inside) code = cell;
    if (answer == CellContainment::Answer::unclear) meeting.push_back(cell);
  }
  const int finest = deepest - filling.depth;
  const bool known = code != outside || meeting.empty();
  if (!known && level > finest) {
    const int step = 1 << (level - 1);
    for (int child = 0; child < 8; ++child) {
      fill(filling, corner + step * Array3i(child & 1, (child >> 1) & 1, child >> 2), level - 1, meeting);
    }
    return;
  }
  if (!known) code = list_code(filling, meeting);
  const Array3i from = (corner - filling.origin) / (1 << finest);
  const int count = 1 << (level - finest);
  for (int k = from[2]; k < from[2] + count; ++k) {
    for (int j = from[1]; j < from[1] + count; ++j) {
      const int row = filling.first + (((k << filling.depth) + j) << filling.depth) + from[0];
      std::fill_n(codes_.begin() + row, count, code);
    }
  }
}

int CellLocator::list_code(Filling& filling, const std::vector<int>& cells) {
  const int count = static_cast<int>(cells.size());
  for (const int place : filling.lists) {
    if (lists_[as_index(place)] != count) continue;
    if (std::equal(cells.begin(), cells.end(), lists_.begin() + place + 1)) return -2 - place;
  }
  const int place = static_cast<int>(lists_.size());
  lists_.push_back(count);
  lists_.insert(lists_.end(), cells.begin(), cells.end());
  filling.lists.push_back(place);
  return -2 - place;
}

int CellLocator::choose(const Vector3d& point, int hint, int list) const {
  const CellContainment::LocalPoint local = containment_.local(point);
  if (hint >= 0 && containment_.test(hint, local) == CellContainment::Answer::inside) return hint;
  const int* begin = lists_.data() + list + 1;
  const int* end = begin + begin[-1];
  thread_local std::vector<int> unclear;
  unclear.clear();
  for (const int* cell = begin; cell != end; ++cell) {
    if (*cell == hint) continue;
    const CellContainment::Answer answer = containment_.test(*cell, local);
    if (answer == CellContainment::Answer::inside) return *cell;
    if (answer == CellContainment::Answer::unclear) unclear.push_back(*cell);
  }
  if (hint >= 0 && std::binary_search(begin, end, hint)) {
    unclear.insert(std::upper_bound(unclear.begin(), unclear.end(), hint), hint);
  }
  return unclear.empty() ? outside : containment_.first_holding(*geometry_, point, unclear);
}

void CellLocator::candidates(const Eigen::AlignedBox3d& box, std::vector<int>& cells) const {
  cells.clear();
  const Eigen::Array3d scale = per_metre_.array() / (1 << deepest);
  const Eigen::Array3d low = ((box.min() - lower_).array() * scale).floor();
  const Eigen::Array3d high = ((box.max() - lower_).array() * scale).floor();
  const Eigen::Array3d last = shape_.cast<double>() - 1;
  if (!((high >= 0).all() && (low <= last).all())) return;
  const Array3i from = low.max(0).cast<int>(), to = high.min(last).cast<int>();
  for (int k = from[2]; k <= to[2]; ++k) {
    for (int j = from[1]; j <= to[1]; ++j) {
      for (int i = from[0]; i <= to[0]; ++i) {
        const std::size_t v = index({i, j, k});
        cells.insert(cells.end(), voxel_cells_.begin() + voxel_begin_[v],
                     voxel_cells_.begin() + voxel_begin_[v + 1]);
      }
    }
  }
}

}  // namespace millfoam::averaging
