// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/superquadric.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

using Vector = std::array<double, 3>;

/// Media of Ssebunnya (PhD thesis, University of Cape Town, 2024): half axes in mm and roundness 2/N, in
/// three groups; each has the volume of a sphere of 5 mm.
const std::vector<std::vector<Superquadric>> groups = {{{{2.57101, 2.41675, 2.49388}, 2 / 0.991672},
                                                        {{2.57103, 2.36533, 2.36533}, 2 / 0.915794},
                                                        {{2.51628, 2.26466, 2.26466}, 2 / 0.8}},
                                                       {{{2.55251, 2.27199, 2.16959}, 2 / 0.771858},
                                                        {{2.55265, 2.27215, 2.04212}, 2 / 0.702743},
                                                        {{2.55236, 2.09295, 2.09295}, 2 / 0.633496},
                                                        {{2.55269, 2.04215, 2.04215}, 2 / 0.571429}},
                                                       {{{2.79573, 1.95701, 1.84550}, 2 / 0.5},
                                                        {{2.69998, 2.07897, 1.75496}, 2 / 0.464596},
                                                        {{2.69955, 1.91636, 1.83533}, 2 / 0.408560},
                                                        {{2.50021, 1.87528, 1.97526}, 2 / 0.367778},
                                                        {{2.70274, 2.00172, 1.67844}, 2 / 0.333333}}};

std::vector<Superquadric> all_shapes() {
  std::vector<Superquadric> shapes{{{2.5, 2.5, 2.5}, 2}};
  for (const auto& group : groups) shapes.insert(shapes.end(), group.begin(), group.end());
  return shapes;
}

/// The shape's value at a point: 1 on the surface.
double value_at(const Superquadric& body, const Vector& x) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += std::pow(std::abs(x[i]) / body.half_axes[i], body.blockiness);
  return sum;
}

/// An eighth of the surface in triangles: the faces of a cube, drawn to the surface along rays.
/// @param parts  along an edge
std::vector<std::array<Vector, 3>> triangles(const Superquadric& body, int parts) {
  const auto at = [&](std::size_t face, int i, int k) {
    Vector x{};
    x[face] = 1;
    x[(face + 1) % 3] = static_cast<double>(i) / parts;
    x[(face + 2) % 3] = static_cast<double>(k) / parts;
    for (std::size_t c = 0; c < 3; ++c) x[c] *= body.half_axes[c];
    const double scale = std::pow(value_at(body, x), -1 / body.blockiness);
    return Vector{x[0] * scale, x[1] * scale, x[2] * scale};
  };
  std::vector<std::array<Vector, 3>> all;
  for (std::size_t face = 0; face < 3; ++face)
    for (int i = 0; i < parts; ++i)
      for (int k = 0; k < parts; ++k) {
        all.push_back({at(face, i, k), at(face, i + 1, k), at(face, i + 1, k + 1)});
        all.push_back({at(face, i, k), at(face, i + 1, k + 1), at(face, i, k + 1)});
      }
  return all;
}

/// Twice a triangle's area, along its normal.
Vector normal_of(const std::array<Vector, 3>& t) {
  Vector u, v;
  for (std::size_t c = 0; c < 3; ++c) {
    u[c] = t[1][c] - t[0][c];
    v[c] = t[2][c] - t[0][c];
  }
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// A sum over an eighth in triangles, without its error of second order.
double extrapolated(const Superquadric& body, const std::function<double(const std::array<Vector, 3>&)>& of) {
  const auto sum = [&](int parts) {
    double total = 0;
    for (const auto& triangle : triangles(body, parts)) total += of(triangle);
    return total;
  };
  return (4 * sum(64) - sum(32)) / 3;
}

double triangulated_surface(const Superquadric& body) {
  return 8 * extrapolated(body, [](const auto& triangle) {
           const Vector n = normal_of(triangle);
           return std::hypot(n[0], n[1], n[2]) / 2;
         });
}

TEST(Superquadric, ASphereHasTheClosedForms) {
  const double r = 0.003;
  const Superquadric sphere{{r, r, r}, 2};
  EXPECT_NEAR(volume(sphere) / (4 * pi / 3 * r * r * r), 1, 1e-12);
  EXPECT_NEAR(surface(sphere) / (4 * pi * r * r), 1, 1e-6);
  for (const double inertia : inertia_over_mass(sphere)) EXPECT_NEAR(inertia / (0.4 * r * r), 1, 1e-12);
  EXPECT_NEAR(sphericity(sphere), 1, 1e-6);
  EXPECT_NEAR(cross_section(sphere, {1, 2, -3}) / (pi * r * r), 1, 1e-6);
  EXPECT_NEAR(least_radius_of_curvature(sphere) / r, 1, 1e-9);
  EXPECT_DOUBLE_EQ(bounding_radius(sphere), r);
}

// An ellipsoid of revolution, of which all is known: half axes 3, 2, 2
TEST(Superquadric, AnEllipsoidHasTheClosedForms) {
  const Superquadric body{{3, 2, 2}, 2};
  const double eccentricity = std::sqrt(1 - 4.0 / 9);
  EXPECT_NEAR(surface(body) / (2 * pi * (4 + 6 / eccentricity * std::asin(eccentricity))), 1, 1e-6);
  EXPECT_NEAR(volume(body), 4 * pi / 3 * 12, 1e-9);
  EXPECT_NEAR(inertia_over_mass(body)[1], (9.0 + 4) / 5, 1e-12);
  EXPECT_NEAR(cross_section(body, {1, 0, 0}) / (4 * pi), 1, 1e-6);
  EXPECT_NEAR(cross_section(body, {0, 0, 5}) / (6 * pi), 1, 1e-6);
  // Both curvatures at the tip are a/b^2
  EXPECT_NEAR(least_radius_of_curvature(body), 4.0 / 3, 1e-8);
  EXPECT_DOUBLE_EQ(bounding_radius(body), 3);
}

// Every coordinate on the rays of a cube's faces: independent of the quadratures over angles
TEST(Superquadric, VolumeSurfaceAndInertiaAreThoseOfTriangles) {
  for (const Superquadric& body : all_shapes()) {
    EXPECT_NEAR(volume(body) / (pi / 6 * 125), 1, 1e-4);
    EXPECT_NEAR(surface(body) / triangulated_surface(body), 1, 1e-4);
    const double cones = extrapolated(body, [](const auto& t) {
      const Vector n = normal_of(t);
      return (n[0] * t[0][0] + n[1] * t[0][1] + n[2] * t[0][2]) / 6;
    });
    EXPECT_NEAR(8 * cones / volume(body), 1, 1e-4);
    // Mean square of x in a tetrahedron from the centre: 2/20 of the sum of squares and products
    const auto mean_square = [&](std::size_t c) {
      return 8 / volume(body) * extrapolated(body, [&](const auto& t) {
               const Vector n = normal_of(t);
               const double x = t[0][c], y = t[1][c], z = t[2][c];
               return (n[0] * t[0][0] + n[1] * t[0][1] + n[2] * t[0][2]) / 6 *
                      (x * x + y * y + z * z + x * y + y * z + z * x) / 10;
             });
    };
    const auto inertia = inertia_over_mass(body);
    EXPECT_NEAR(inertia[2] / (mean_square(0) + mean_square(1)), 1, 1e-4);
    EXPECT_NEAR(inertia[0] / (mean_square(1) + mean_square(2)), 1, 1e-4);
    double farthest = 0;
    for (const auto& t : triangles(body, 64))
      for (const Vector& x : t) farthest = std::max(farthest, std::hypot(x[0], x[1], x[2]));
    EXPECT_NEAR(bounding_radius(body) / farthest, 1, 3e-4);
  }
}

// The shadow of the triangles: each of the two sides has its area
TEST(Superquadric, AShadowIsThatOfTriangles) {
  for (const Superquadric& body : all_shapes())
    for (const Vector& w : {Vector{0, 0, 1}, Vector{0.6, 0, 0.8}, Vector{0.48, 0.6, 0.64}}) {
      double sum = 0;
      for (const auto& triangle : triangles(body, 64)) {
        const Vector n = normal_of(triangle);
        for (const int sx : {-1, 1})
          for (const int sy : {-1, 1})
            for (const int sz : {-1, 1})
              sum += std::abs(sx * n[0] * w[0] + sy * n[1] * w[1] + sz * n[2] * w[2]);
      }
      EXPECT_NEAR(cross_section(body, w) / (sum / 4), 1, 1e-3);
    }
}

TEST(Superquadric, MeanShadowIsAQuarterOfTheSurface) {
  for (const Superquadric& body : {groups[0][0], groups[1][1], groups[2][4]}) {
    constexpr int parts = 24;
    double sum = 0;
    for (int i = 0; i < parts; ++i)
      for (int k = 0; k < parts; ++k) {
        const double z = (i + 0.5) / parts, r = std::sqrt(1 - z * z), angle = pi / 2 * (k + 0.5) / parts;
        sum += cross_section(body, {r * std::cos(angle), r * std::sin(angle), z});
      }
    EXPECT_NEAR(sum / (parts * parts) / (surface(body) / 4), 1, 1e-3);
  }
}

// As published, to the digits that are printed
TEST(Superquadric, PublishedGroupsHaveTheirSphericityAndCurvature) {
  const double sphericities[] = {0.996, 0.975, 0.922};
  const double radii[] = {1.73, 1.10, 0.58};
  double farthest = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    double sum = 0, least = 1e9;
    for (const Superquadric& body : groups[g]) {
      sum += sphericity(body);
      least = std::min(least, least_radius_of_curvature(body));
      farthest = std::max(farthest, bounding_radius(body));
    }
    EXPECT_NEAR(sum / static_cast<double>(groups[g].size()), sphericities[g], 5e-4);
    EXPECT_NEAR(least, radii[g], 6e-3);
  }
  EXPECT_NEAR(farthest, 3.19, 5e-3);
}

// Mean curvature: half the divergence of the unit normal, here by differences
TEST(Superquadric, MeanCurvatureIsHalfTheDivergenceOfTheNormal) {
  const Superquadric body = groups[2][4];
  const auto unit_gradient = [&](const Vector& x, std::size_t component) {
    Vector g;
    for (std::size_t i = 0; i < 3; ++i)
      g[i] = std::pow(x[i] / body.half_axes[i], body.blockiness - 1) / body.half_axes[i];
    return g[component] / std::hypot(g[0], g[1], g[2]);
  };
  for (const Vector& direction : {Vector{1, 1, 1}, Vector{0.3, 0.8, 0.5}, Vector{0.9, 0.2, 0.4}}) {
    Vector x;
    for (std::size_t i = 0; i < 3; ++i) x[i] = direction[i] * body.half_axes[i];
    const double scale = std::pow(value_at(body, x), -1 / body.blockiness);
    for (double& coordinate : x) coordinate *= scale;
    constexpr double step = 1e-5;
    double divergence = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      Vector ahead = x, behind = x;
      ahead[i] += step;
      behind[i] -= step;
      divergence += (unit_gradient(ahead, i) - unit_gradient(behind, i)) / (2 * step);
    }
    EXPECT_NEAR(mean_curvature(body, direction), divergence / 2, 1e-6);
  }
}

TEST(Superquadric, ScalingKeepsTheShape) {
  const Superquadric scaled = scaled_to({{3, 2, 1}, 4}, 0.005);
  EXPECT_NEAR(volume(scaled) / (pi / 6 * 0.005 * 0.005 * 0.005), 1, 1e-12);
  EXPECT_NEAR(scaled.half_axes[0] / scaled.half_axes[2], 3, 1e-12);
  EXPECT_DOUBLE_EQ(scaled.blockiness, 4);
}

}  // namespace
}  // namespace millfoam::meshing
