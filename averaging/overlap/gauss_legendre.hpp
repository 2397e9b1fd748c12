// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace millfoam::averaging {

/// A place in [-1, 1] and what it counts for.
struct QuadratureNode {
  double place;   ///< in [-1, 1]
  double weight;  ///< all weights add up to 2
};

/// The rule of n nodes that integrates polynomials up to degree 2n - 1 exactly over [-1, 1]; n at least 1.
/// Newton's method on the Legendre polynomial (Press et al., Numerical Recipes, 4.6).
std::vector<QuadratureNode> gauss_legendre(int n);

/// A Gauss-Legendre rule of n nodes for functions f that are analytic but for roots at the ends, (1 -+
/// x)^(k/2): with x = (3 u - u^3)/2, 1 -+ x goes as (1 -+ u)^2 and f becomes analytic in u. Polynomials up to
/// degree (2n - 3)/3 remain exact.
std::vector<QuadratureNode> gauss_legendre_with_roots(int n);

}  // namespace millfoam::averaging
