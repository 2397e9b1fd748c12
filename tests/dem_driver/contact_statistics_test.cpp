// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/contact_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <utility>

namespace millfoam::dem_driver {
namespace {

double touches_of(const ContactSums& sums, int kind) {
  double touches = 0;
  for (const BinSums& bin : sums.of(kind).bins) touches += bin.touches;
  return touches;
}

double collisions_of(const ContactSums& sums, int kind) {
  double collisions = 0;
  for (const BinSums& bin : sums.of(kind).bins) collisions += bin.collisions;
  return collisions;
}

TEST(ContactWorkOf, ABallThatSlidesOnAWallLosesForceTimesSlip) {
  ContactForce contact;
  contact.normal = {0, 1, 0};
  contact.push = 2;
  contact.force = {-0.5, 2, 0};  // the wall brakes the slip along x
  contact.arm = {0, -0.01, 0};
  contact.torque = {0, 0, -0.005};  // arm x force of the tangential part, no rolling friction
  const ContactMotion sliding{{0.3, 0, 0}, {0, 0, 0}, {}};
  const ContactWork work = work_of(contact, sliding, 0.1);
  EXPECT_NEAR(work.tangential, 0.5 * 0.3 * 0.1, 1e-15);
  EXPECT_NEAR(work.normal, 0, 1e-15);
  EXPECT_NEAR(work.rolling, 0, 1e-15);
}

TEST(ContactWorkOf, ABallThatRollsWithoutSlipLosesRollingFrictionOnly) {
  ContactForce contact;
  contact.normal = {0, 1, 0};
  contact.push = 2;
  contact.force = {-0.5, 2, 0};
  contact.arm = {0, -0.01, 0};
  contact.torque = {0, 0, -0.005 + 0.0007};
  const ContactMotion rolling{{0.3, 0, 0}, {0, 0, -30}, {}};
  const ContactWork work = work_of(contact, rolling, 0.1);
  EXPECT_NEAR(work.tangential, 0, 1e-15);
  EXPECT_NEAR(work.rolling, 0.0007 * 30 * 0.1, 1e-15);
}

TEST(ContactWorkOf, ItIsWhatForceAndTorqueTakeFromBothBodies) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&] { return std::array<double, 3>{number(random), number(random), number(random)}; };
  const auto dot = [](const auto& a, const auto& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  ContactForce contact;
  contact.normal = {2.0 / 3, 1.0 / 3, -2.0 / 3};
  contact.push = 3;
  const auto slide = vector();
  const double along = dot(slide, contact.normal);
  for (std::size_t k = 0; k < 3; ++k)
    contact.force[k] = slide[k] - along * contact.normal[k] + 3 * contact.normal[k];
  contact.arm = vector();  // of a ball that is no sphere, not along the normal
  contact.other_arm = vector();
  const auto roll = vector(), velocity = vector(), spin = vector(), other_spin = vector();
  const auto cross = [](const auto& a, const auto& b) {
    return std::array<double, 3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                 a[0] * b[1] - a[1] * b[0]};
  };
  const auto torque = cross(contact.arm, contact.force),
             other_torque = cross(contact.other_arm, contact.force);
  double power = dot(contact.force, velocity);
  for (std::size_t k = 0; k < 3; ++k) {
    contact.torque[k] = torque[k] + roll[k];
    power += contact.torque[k] * spin[k] - (other_torque[k] + roll[k]) * other_spin[k];
  }
  EXPECT_NEAR(work_of(contact, {velocity, spin, other_spin}, 0.1).total(), -0.1 * power, 1e-14);
}

TEST(ContactKinds, EveryPairOfClassesAndEveryWallHasItsOwn) {
  const ContactKinds kinds(3, 2);
  std::set<int> seen;
  for (int first = 0; first < 3; ++first) {
    for (int second = first; second < 3; ++second) {
      const int kind = kinds.of_balls(second, first);
      EXPECT_EQ(kind, kinds.of_balls(first, second));
      EXPECT_EQ(kinds.bodies(kind).first, first);
      EXPECT_EQ(kinds.bodies(kind).second, second);
      seen.insert(kind);
    }
    for (int part = 0; part < 2; ++part) {
      const int kind = kinds.of_wall(first, part);
      EXPECT_EQ(kinds.bodies(kind).first, first);
      EXPECT_EQ(kinds.bodies(kind).second, -1 - part);
      seen.insert(kind);
    }
  }
  EXPECT_EQ(static_cast<int>(seen.size()), kinds.size());
  EXPECT_EQ(*seen.rbegin(), kinds.size() - 1);
}

TEST(EnergyBin, ItsEdgesHoldItsEnergies) {
  EXPECT_EQ(energy_bin(-1), 0);
  EXPECT_EQ(energy_bin(0), 0);
  EXPECT_EQ(energy_bin(std::nan("")), 0);
  EXPECT_EQ(energy_bin(1e9), energy_bins - 1);
  EXPECT_NEAR(energy_edge(energy_edges - 1), 1000, 1e-9);
  for (int edge = 0; edge < energy_edges; ++edge) {
    EXPECT_EQ(energy_bin(1.0001 * energy_edge(edge)), edge + 1);
    EXPECT_EQ(energy_bin(0.9999 * energy_edge(edge)), edge);
  }
}

TEST(ContactStatistics, ACollisionIsCountedOnceWithTheWorkOfAllItsSteps) {
  ContactStatistics statistics(ContactKinds(1, 1));
  for (int step = 0; step < 3; ++step) {
    statistics.add(4, 9, 0, step == 0 ? 2e-6 : 5e-9, {1e-7, 2e-7, 3e-8});
    statistics.end_step();
    EXPECT_EQ(collisions_of(statistics.sums, 0), 0);
  }
  statistics.end_step();
  const KindSums sums = statistics.sums.of(0);
  EXPECT_EQ(sums.bins[static_cast<std::size_t>(energy_bin(2e-6))].touches, 1);
  EXPECT_EQ(touches_of(statistics.sums, 0), 1);
  const BinSums& ended = sums.bins[static_cast<std::size_t>(energy_bin(3 * 3.3e-7))];
  EXPECT_EQ(ended.collisions, 1);
  EXPECT_NEAR(ended.work.normal, 3e-7, 1e-18);
  EXPECT_NEAR(sums.work.total(), 3 * 3.3e-7, 1e-18);
  EXPECT_TRUE(statistics.open().empty());
}

TEST(ContactStatistics, TwoTrianglesOfOnePartAreOneContactAndTwoPartsAreTwo) {
  const ContactKinds kinds(1, 2);
  ContactStatistics statistics(kinds);
  statistics.add(4, -1, kinds.of_wall(0, 0), 1e-6, {});
  statistics.add(4, -1, kinds.of_wall(0, 0), 1e-6, {});
  statistics.add(4, -2, kinds.of_wall(0, 1), 1e-6, {});
  statistics.end_step();
  EXPECT_EQ(statistics.open().size(), 2U);
  EXPECT_EQ(touches_of(statistics.sums, kinds.of_wall(0, 0)), 1);
  EXPECT_EQ(touches_of(statistics.sums, kinds.of_wall(0, 1)), 1);
}

TEST(ContactStatistics, ContactsOfTheFirstStepAreNoTouches) {
  ContactStatistics statistics(ContactKinds(1, 0));
  statistics.count_touches(false);
  statistics.add(1, 2, 0, 1e-6, {});
  statistics.end_step();
  statistics.count_touches(true);
  statistics.add(1, 3, 0, 1e-6, {});
  statistics.end_step();
  EXPECT_EQ(touches_of(statistics.sums, 0), 1);
  EXPECT_EQ(collisions_of(statistics.sums, 0), 1);
}

TEST(ContactStatistics, AContactThatGoesToAnotherRankContinuesThere) {
  ContactStatistics here{ContactKinds(1, 0)}, there{ContactKinds(1, 0)};
  here.add(1, 2, 0, 1e-6, {1e-6, 0, 0});
  here.add(1, 3, 0, 1e-6, {5e-6, 0, 0});
  here.end_step();
  there.end_step();
  for (const auto& contact : here.take([](const OpenContact& open) { return open.other == 2; }))
    there.put(contact);
  EXPECT_EQ(here.open().size(), 1U);
  there.add(1, 2, 0, 1e-9, {2e-6, 0, 0});
  there.end_step();
  there.end_step();
  EXPECT_EQ(touches_of(there.sums, 0), 0);
  EXPECT_NEAR(there.sums.of(0).bins[static_cast<std::size_t>(energy_bin(3e-6))].work.normal, 3e-6, 1e-18);
}

/// Thousands of contacts that come and go at random, against a plain list.
TEST(ContactStatistics, ManyContactsAreFollowedAsInAPlainList) {
  std::mt19937 random(3);
  ContactStatistics statistics(ContactKinds(1, 0));
  std::set<std::pair<int, int>> open;
  double begun = 0, ended = 0;
  for (int step = 0; step < 300; ++step) {
    std::set<std::pair<int, int>> now;
    for (const auto& pair : open)
      if (random() % 10 > 0) now.insert(pair);
    for (int i = 0; i < 100; ++i) {
      const int first = static_cast<int>(random() % 500);
      now.insert({first, first + 1 + static_cast<int>(random() % 20)});
    }
    for (const auto& pair : now) {
      statistics.add(pair.first, pair.second, 0, 1e-6, {1e-6, 0, 0});
      begun += static_cast<double>(1 - open.count(pair));
    }
    for (const auto& pair : open) ended += static_cast<double>(1 - now.count(pair));
    statistics.end_step();
    open = now;
    std::set<std::pair<int, int>> followed;
    for (const OpenContact& contact : statistics.open()) followed.insert({contact.ball, contact.other});
    ASSERT_EQ(followed, open);
  }
  EXPECT_EQ(touches_of(statistics.sums, 0), begun);
  EXPECT_EQ(collisions_of(statistics.sums, 0), ended);
}

}  // namespace
}  // namespace millfoam::dem_driver
