// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace millfoam::meshing {

/// Disjoint sets of the numbers 0 to n - 1.
class UnionFind {
 public:
  /// Each of the `n` numbers is one set.
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// The root of the set that holds a number: the same for all its members.
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// Makes one set of those that hold `a` and `b`. The smaller root stays, so that the sets' order is that of
  /// their first members.
  void join(std::size_t a, std::size_t b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parent_[high] = low;
  }

  /// For each number the index of its set, counted in the order of their first members; and how many there
  /// are.
  std::pair<std::vector<int>, int> numbered() {
    std::vector<int> set(parent_.size());
    std::vector<int> of_root(parent_.size(), -1);
    int count = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i) {
      int& number = of_root[find(i)];
      if (number < 0) number = count++;
      set[i] = number;
    }
    return {std::move(set), count};
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace millfoam::meshing
