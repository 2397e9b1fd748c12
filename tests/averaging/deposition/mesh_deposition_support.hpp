// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "averaging/mesh/moving_mesh.hpp"
#include "tests/averaging/deposition/deposition_support.hpp"
#include "tests/averaging/drum_support.hpp"

namespace millfoam::averaging {

/// The drum with its inside warped; its boundary stays where it is.
inline TestMesh warped_drum() {
  const TestMesh flat = drum();
  TestMesh mesh = warped(flat, 0.0009);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Eigen::Vector3d& p = flat.points[i];
    const bool inside = p.head<2>().norm() < 0.99 * drum_radius && p.z() > 1e-9 && p.z() < drum_length - 1e-9;
    if (!inside) mesh.points[i] = p;
  }
  return mesh;
}

template <typename Method>
Method at_rest(const TestMesh& mesh, int points = 12, std::optional<double> period = std::nullopt) {
  Method deposition(std::make_unique<RigidMesh>(prepare(mesh.topology, mesh.points), parse_motion({}), 0.0),
                    points, period);
  deposition.begin_record(0);
  return deposition;
}

template <typename Method>
Method turning(const TestMesh& mesh, const std::vector<std::string>& motion, double reference_time,
               double time) {
  Method deposition(
      std::make_unique<RigidMesh>(prepare(mesh.topology, mesh.points), parse_motion(motion), reference_time));
  deposition.begin_record(time);
  return deposition;
}

inline Particle ball_at(const Eigen::Vector3d& centre, double of_radius) {
  return {1, {centre.x(), centre.y(), centre.z()}, {}, of_radius};
}

inline void expect_same(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t c = 0; c < a.size(); ++c) ASSERT_NEAR(a[c], b[c], tolerance) << "cell " << c;
}

/// Balls wholly in the drum, of many sizes.
inline std::vector<Particle> balls_in_drum(int count, double smallest, double largest) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> either(-1, 1), exponent(std::log(smallest), std::log(largest));
  std::vector<Particle> balls;
  while (static_cast<int>(balls.size()) < count) {
    const double r = std::exp(exponent(random)), reach = 0.97 * drum_radius - r;
    const Eigen::Vector3d centre(reach * either(random), reach * either(random),
                                 drum_length / 2 + (drum_length / 2 - r) * either(random));
    if (centre.head<2>().norm() < reach) balls.push_back(ball_at(centre, r));
  }
  return balls;
}

}  // namespace millfoam::averaging
