// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

namespace millfoam::meshing {

/// The body |x/a|^N + |y/b|^N + |z/c|^N <= 1 in its own frame: an ellipsoid for N = 2, a box for N without
/// end. LIGGGHTS' two blockinesses are both N; the roundness n is 2/N.
///
/// The functions below expect positive half axes and a blockiness from `least_blockiness` to
/// `most_blockiness`.
struct Superquadric {
  std::array<double, 3> half_axes = {};  ///< a, b, c, m
  double blockiness = 2;                 ///< N
};

/// Below it, LIGGGHTS' search for the point of contact fails: the surface has edges of infinite curvature.
inline constexpr double least_blockiness = 2;
/// Above it, the body has edges that no time-step resolves, and the quadratures here lose their digits.
inline constexpr double most_blockiness = 12;

/// Volume, m^3: (2/N)^2 2 a b c B(1/N, 2/N + 1) B(1/N, 1/N + 1), with the beta function B.
/// A. Jaklic, A. Leonardis & F. Solina, Segmentation and Recovery of Superquadrics (2000), eq. 2.60.
double volume(const Superquadric& body);

/// Principal moments of inertia about x, y, z over the mass, m^2: sums of two mean squares of coordinates,
/// ⟨x^2⟩ = a^2 Γ(3/N) Γ(3/N + 1)/(Γ(1/N) Γ(5/N + 1)). A ball has 2/5 R^2. (The Dirichlet integral.)
std::array<double, 3> inertia_over_mass(const Superquadric& body);

/// Area of the surface, m^2, by quadrature over the directions from the centre; right to 1e-6.
double surface(const Superquadric& body);

/// Surface of the sphere of equal volume over that of the body; 1 for a sphere. The body is convex, so by
/// Cauchy's theorem its mean cross-section over all directions is a quarter of its surface: this is also the
/// crosswise sphericity of a body in random orientation, the cross-section of the sphere of equal volume over
/// that mean.
double sphericity(const Superquadric& body);

/// Area of the body's shadow along a direction, m^2. `along` is the direction in the body's frame, of any
/// length above 0.
double cross_section(const Superquadric& body, const std::array<double, 3>& along);

/// Mean curvature of the surface where the ray from the centre in a direction leaves the body, 1/m:
/// (|∇S|^2 tr H - ∇S^T H ∇S)/(2 |∇S|^3), of S = Σ|x/a|^N and its Hessian H. A sphere has 1/R.
/// `direction` is that of the ray in coordinates over the half axes, of any length above 0.
double mean_curvature(const Superquadric& body, const std::array<double, 3>& direction);

/// The least radius of curvature, m: 1 over the largest mean curvature of the surface.
double least_radius_of_curvature(const Superquadric& body);

/// Radius of the smallest sphere about the centre that holds the body, m: (Σ a^(2N/(N-2)))^((N-2)/(2N)), the
/// largest half axis for N = 2.
double bounding_radius(const Superquadric& body);

/// The same shape with the volume of a sphere of a diameter, m.
Superquadric scaled_to(const Superquadric& body, double diameter);

}  // namespace millfoam::meshing
