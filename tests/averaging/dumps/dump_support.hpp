// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "averaging/dumps/dump_reader.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {

/// Balls of numbers short and long, with ids in any order, some left out.
inline std::vector<Particle> random_balls(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Particle> balls(count);
  long long id = 0;
  for (Particle& ball : balls) {
    ball.id = id += 1 + static_cast<long long>(random() % 3);
    ball.position = {number(random), number(random) * 1e-5, number(random) * 1e5};
    ball.velocity = {0, number(random) * 1e-300, number(random)};
    ball.radius = 1e-3 + std::abs(number(random));
  }
  std::shuffle(balls.begin(), balls.end(), random);
  return balls;
}

/// Expects the same balls, to the last bit.
inline void expect_same(const std::vector<Particle>& found, const std::vector<Particle>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  std::size_t different = 0;
  for (std::size_t p = 0; p < found.size(); ++p) {
    const Particle &a = found[p], &b = expected[p];
    different +=
        a.id == b.id && a.position == b.position && a.velocity == b.velocity && a.radius == b.radius ? 0 : 1;
  }
  EXPECT_EQ(different, 0U);
}

/// The text with its numbers as LIGGGHTS prints them, "%g".
inline std::string short_text(const std::vector<Particle>& balls) {
  std::ostringstream text;
  text << "ITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n"
       << balls.size() << "\nITEM: ATOMS id x y z vx vy vz radius \n";
  for (const Particle& p : balls) {
    text << p.id;
    for (const double value : p.position) text << ' ' << value;
    for (const double value : p.velocity) text << ' ' << value;
    text << ' ' << p.radius << " \n";
  }
  return text.str();
}

}  // namespace millfoam::averaging
