// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/drag/nonspherical.hpp"

#include <cassert>
#include <cmath>

namespace millfoam::drag {

namespace {

/// C_D Re/24 of a single ball: Hölzer & Sommerfeld's drag over Stokes's.
double single_ball(double re, const Shape& shape) {
  const double laminar = 8 / std::sqrt(shape.crosswise_sphericity) + 16 / std::sqrt(shape.sphericity);
  const double transition = 3 * std::sqrt(re) / std::pow(shape.sphericity, 0.75);
  const double logarithm = -std::log10(shape.sphericity);
  const double turbulent = 0.42 * std::pow(10.0, 0.4 * std::pow(logarithm, 0.2)) / shape.crosswise_sphericity;
  return (laminar + transition + turbulent * re) / 24;
}

}  // namespace

double hoelzer_sommerfeld(double phi, double re, const Shape& shape) {
  assert(shape.sphericity > 0 && shape.sphericity <= 1 && shape.crosswise_sphericity > 0);
  // Di Felice's law is a single sphere's drag times his function of the voidage.
  return single_ball(re, shape) * di_felice(phi, re) / di_felice(0, re);
}

double drag_over_mean(double re, const Shape& shape, const std::vector<ShapeShare>& bed) {
  assert(!bed.empty());
  double mean = 0;
  for (const ShapeShare& part : bed) mean += part.share * single_ball(re, part.shape);
  return single_ball(re, shape) / mean;
}

const Law& hoelzer_sommerfeld_law() {
  static const Law law = {"HoelzerSommerfeld",
                          [](double phi, double re) {
                            return hoelzer_sommerfeld(phi, re, {1, 1});
                          },
                          "Hölzer & Sommerfeld 2008", find_law("DiFelice").range};
  return law;
}

double exchange_coefficient(const Shape& shape, double phi, double slip, double diameter,
                            const Fluid& fluid) {
  if (phi <= 0) return 0;
  const double factor = hoelzer_sommerfeld(phi, reynolds(phi, slip, diameter, fluid), shape);
  return exchange_from_factor(phi, diameter, fluid.viscosity, factor);
}

}  // namespace millfoam::drag
