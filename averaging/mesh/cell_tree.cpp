// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/cell_tree.hpp"

#include <algorithm>
#include <numeric>

#include "averaging/values/as_index.hpp"

namespace millfoam::averaging {

namespace {

using Eigen::Array3f;
using Eigen::Vector3d;

constexpr std::size_t cells_per_leaf = 4;

/// The tree is rebuilt when its boxes overlap by this factor more than after the last build.
constexpr double worn = 1.15;

double half_surface(const Vector3d& size) {
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

Array3f as_array(const CellContainment::LocalPoint& point) {
  return {point.x, point.y, point.z};
}

}  // namespace

CellTree::CellTree(const MeshGeometry& geometry) : geometry_(geometry), containment_(geometry) {
  build();
}

void CellTree::update() {
  containment_.update(geometry_);
  if (fit() > worn * cost_) build();
}

void CellTree::build() {
  order_.resize(geometry_.cells());
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.clear();
  build_node(0, order_.size());
  cost_ = fit();
  ++builds_;
}

void CellTree::build_node(std::size_t first, std::size_t last) {
  const std::size_t number = nodes_.size();
  nodes_.emplace_back();
  if (last - first <= cells_per_leaf) {
    nodes_[number].first = static_cast<int>(first);
    nodes_[number].count = static_cast<int>(last - first);
  } else {
    Eigen::AlignedBox3d centres;
    for (std::size_t i = first; i < last; ++i)
      centres.extend(geometry_.boxes()[as_index(order_[i])].center());
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const std::size_t middle = (first + last) / 2;
    const auto begin = order_.begin();
    std::nth_element(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
                     begin + static_cast<std::ptrdiff_t>(last), [&](int a, int b) {
                       const auto& boxes = geometry_.boxes();
                       return boxes[as_index(a)].min()[axis] + boxes[as_index(a)].max()[axis] <
                              boxes[as_index(b)].min()[axis] + boxes[as_index(b)].max()[axis];
                     });
    build_node(first, middle);
    build_node(middle, last);
  }
  nodes_[number].skip = static_cast<int>(nodes_.size());
}

void CellTree::fit_leaf(Node& node) const {
  Eigen::AlignedBox3d box;
  for (int i = node.first; i < node.first + node.count; ++i)
    box.extend(geometry_.boxes()[as_index(order_[as_index(i)])]);
  // More than single precision loses, so that no point on the boundary is missed.
  const double margin = 1e-6 * geometry_.box().diagonal().norm();
  node.low = as_array(containment_.local(box.min() - Vector3d::Constant(margin)));
  node.high = as_array(containment_.local(box.max() + Vector3d::Constant(margin)));
}

/// Fits all boxes and returns their surface over that of the cells' own boxes.
double CellTree::fit() {
  double surface = 0, cells = 0;
  for (const Eigen::AlignedBox3d& box : geometry_.boxes()) cells += half_surface(box.sizes());
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    Node& node = nodes_[n];
    if (node.count > 0) {
      fit_leaf(node);
    } else {
      const Node& left = nodes_[n + 1];
      const Node& right = nodes_[as_index(left.skip)];
      node.low = left.low.min(right.low);
      node.high = left.high.max(right.high);
    }
    surface += half_surface((node.high - node.low).matrix().cast<double>());
  }
  return surface / cells;
}

int CellTree::locate(const Vector3d& point, int hint) const {
  const CellContainment::LocalPoint local = containment_.local(point);
  if (hint >= 0 && containment_.test(hint, local) == CellContainment::Answer::inside) return hint;
  const Array3f place = as_array(local);
  thread_local std::vector<int> unclear;
  unclear.clear();
  for (std::size_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    if (!node.contains(place)) {
      n = as_index(node.skip);
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      const int cell = order_[as_index(i)];
      const CellContainment::Answer answer = containment_.test(cell, local);
      if (answer == CellContainment::Answer::inside) return cell;
      if (answer == CellContainment::Answer::unclear) unclear.push_back(cell);
    }
    ++n;
  }
  if (unclear.empty()) return -1;
  std::sort(unclear.begin(), unclear.end());
  return containment_.first_holding(geometry_, point, unclear);
}

void CellTree::candidates(const Eigen::AlignedBox3d& box, std::vector<int>& cells) const {
  cells.clear();
  const Array3f low = as_array(containment_.local(box.min())), high = as_array(containment_.local(box.max()));
  for (std::size_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    if (!((high >= node.low).all() && (low <= node.high).all())) {
      n = as_index(node.skip);
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) cells.push_back(order_[as_index(i)]);
    ++n;
  }
}

}  // namespace millfoam::averaging
