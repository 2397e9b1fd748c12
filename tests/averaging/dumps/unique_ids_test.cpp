// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/unique_ids.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

namespace millfoam::averaging {
namespace {

TEST(UniqueIds, DuplicatesAreFoundAmongDenseAndSparseIds) {
  const auto with_ids = [](const std::vector<long long>& ids) {
    std::vector<Particle> particles(ids.size());
    for (std::size_t p = 0; p < ids.size(); ++p) particles[p].id = ids[p];
    return particles;
  };
  constexpr long long least = std::numeric_limits<long long>::min(),
                      most = std::numeric_limits<long long>::max();
  EXPECT_FALSE(find_duplicates(with_ids({})));
  EXPECT_FALSE(find_duplicates(with_ids({5})));
  EXPECT_FALSE(find_duplicates(with_ids({3, 1, 2, -4})));
  EXPECT_FALSE(find_duplicates(with_ids({least, most, 0})));
  EXPECT_EQ(find_duplicates(with_ids({3, 1, 2, 1})), std::pair(std::size_t{1}, std::size_t{3}));
  EXPECT_EQ(find_duplicates(with_ids({most, least, 0, most})), std::pair(std::size_t{0}, std::size_t{3}));
}

}  // namespace
}  // namespace millfoam::averaging
