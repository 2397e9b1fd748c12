// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/drag/drag_laws.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace millfoam::drag {

namespace {

double cube(double x) {
  return x * x * x;
}

/// Carman's viscous limit 10 phi/e^3, to which the lattice-Boltzmann laws tend in dense beds.
double carman(double phi) {
  return 10 * phi / cube(1 - phi);
}

/// The rational fit R(c, p, q) of Hill, Koch & Ladd's low-solidity viscous drag.
double hill_rational(double phi, double c, double p, double q) {
  const double phi_ln_phi = phi > 0 ? phi * std::log(phi) : 0.0;
  return (1 + 3 * std::sqrt(phi / 2) + 135.0 / 64.0 * phi_ln_phi + c * phi) /
         (1 + 0.681 * phi + p * phi * phi + q * cube(phi));
}

/// Coefficient of the quadratic onset of inertia, phi > 0.
double hill_f1(double phi) {
  return phi <= 0.1 ? std::sqrt(2 / phi) / 40 : 0.11 + 5.1e-4 * std::exp(11.6 * phi);
}

double hill_f3(double phi) {
  return 0.0673 + 0.212 * phi + 0.0232 / std::pow(1 - phi, 5);
}

/// Benyahia's blend of a rational fit with Carman's limit below phi = 0.4.
double benyahia_viscous(double phi, double c, double p, double q) {
  if (phi >= 0.4) return carman(phi);
  const double w = phi > 0 ? std::exp(-10 * (0.4 - phi) / phi) : 0.0;
  return (1 - w) * hill_rational(phi, c, p, q) + w * carman(phi);
}

}  // namespace

double ergun(double phi, double re) {
  return (150 * phi + 1.75 * re) / (18 * cube(1 - phi));
}

double wen_yu(double phi, double re) {
  const double f = re <= 1000 ? 1 + 0.15 * std::pow(re, 0.687) : 0.44 * re / 24;
  return f * std::pow(1 - phi, -4.65);
}

double ergun_wen_yu(double phi, double re) {
  return phi > 0.2 ? ergun(phi, re) : wen_yu(phi, re);
}

double hill(double phi, double re) {
  const double re_a = re / 2;
  const double f0 = phi < 0.4 ? hill_rational(phi, 17.14, -8.48, 8.16) : carman(phi);
  const double f3 = hill_f3(phi);
  if (phi > 0) {
    const double f1 = hill_f1(phi);
    if (re_a <= f3 / f1) return f0 + f1 * re_a * re_a;
  }
  return f0 + f3 * re_a;
}

double benyahia(double phi, double re) {
  const double re_a = re / 2;
  const double f0 = benyahia_viscous(phi, 17.14, -8.48, 8.16);
  const double f2 = benyahia_viscous(phi, 17.89, -11.03, 15.41);
  const double f3 = phi < 0.0953 ? 0.9351 * phi + 0.03667 : hill_f3(phi);
  if (phi <= 0.01) {
    const bool slow = re_a <= (f2 - 1) / (3.0 / 8.0 - f3);
    return slow ? 1 + 3.0 / 8.0 * re_a : f2 + f3 * re_a;
  }
  const double f1 = hill_f1(phi);
  const double re_switch = (f3 + std::sqrt(f3 * f3 - 4 * f1 * (f0 - f2))) / (2 * f1);
  return re_a <= re_switch ? f0 + f1 * re_a * re_a : f2 + f3 * re_a;
}

double beetstra(double phi, double re) {
  const double e = 1 - phi;
  const double viscous = 10 * phi / cube(e) + e * (1 + 1.5 * std::sqrt(phi));
  if (re <= 0) return viscous;
  const double numerator = 1 / e + 3 * phi * e + 8.4 * std::pow(re, -0.343);
  const double denominator = 1 + std::pow(10.0, 3 * phi) * std::pow(re, -(1 + 4 * phi) / 2);
  return viscous + 0.413 * re / (24 * cube(e)) * numerator / denominator;
}

const std::vector<Law>& laws() {
  static const std::vector<Law> table = {
      {"Ergun", ergun, "Ergun 1952"},
      {"WenYu", wen_yu, "Wen & Yu 1966"},
      {"ErgunWenYu", ergun_wen_yu, "Gidaspow 1994"},
      {"Hill", hill, "Hill, Koch & Ladd 2001"},
      {"Benyahia", benyahia, "Benyahia, Syamlal & O'Brien 2006"},
      {"Beetstra", beetstra, "Beetstra, van der Hoef & Kuipers 2007"},
  };
  return table;
}

const Law& find_law(std::string_view name) {
  const auto& table = laws();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Law& law) { return law.name == name; });
  if (found != table.end()) return *found;
  std::string known;
  for (const Law& law : table) known += (known.empty() ? "" : ", ") + std::string(law.name);
  throw std::invalid_argument("drag law '" + std::string(name) + "' is not known; expected one of " + known);
}

double reynolds(double phi, double slip, double diameter, const Fluid& fluid) {
  return fluid.density * (1 - phi) * slip * diameter / fluid.viscosity;
}

double exchange_from_factor(double phi, double diameter, double viscosity, double factor) {
  if (phi <= 0) return 0;
  const double e = 1 - phi;
  return 18 * viscosity * phi * e * e * factor / (diameter * diameter);
}

double exchange_coefficient(const Law& law, double phi, double slip, double diameter, const Fluid& fluid) {
  if (phi <= 0) return 0;
  const double factor = law.factor(phi, reynolds(phi, slip, diameter, fluid));
  return exchange_from_factor(phi, diameter, fluid.viscosity, factor);
}

}  // namespace millfoam::drag
