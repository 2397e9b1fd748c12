// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/drag/drag_laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace millfoam::drag {

namespace {

double cube(double x) {
  return x * x * x;
}

constexpr double open_end = std::numeric_limits<double>::infinity();
constexpr Range everywhere = {0, open_end, 0, open_end};

/// Ergun's form: `viscous` and `inertial` are his 150 and 1.75.
double ergun_form(double phi, double re, double viscous, double inertial) {
  return (viscous * phi + inertial * re) / (18 * cube(1 - phi));
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

/// Beetstra's and Tang's viscous part, van der Hoef et al. 2005.
double van_der_hoef(double phi) {
  return carman(phi) + (1 - phi) * (1 + 1.5 * std::sqrt(phi));
}

/// Di Felice's drag of a single sphere over Stokes's (Dallavalle 1948).
double dallavalle(double re) {
  const double root = 0.63 * std::sqrt(re) + 4.8;
  return root * root / 24;
}

/// Di Felice's bell in log10 Re around Re 10^1.5; 0 at rest.
double di_felice_bell(double re) {
  if (re <= 0) return 0;
  const double distance = 1.5 - std::log10(re);
  return std::exp(-distance * distance / 2);
}

/// Benyahia's blend of a rational fit with Carman's limit below phi = 0.4.
double benyahia_viscous(double phi, double c, double p, double q) {
  if (phi >= 0.4) return carman(phi);
  const double w = phi > 0 ? std::exp(-10 * (0.4 - phi) / phi) : 0.0;
  return (1 - w) * hill_rational(phi, c, p, q) + w * carman(phi);
}

}  // namespace

double ergun(double phi, double re) {
  return ergun_form(phi, re, 150, 1.75);
}

double fand(double phi, double re) {
  const auto darcy_regime = [phi](double at) { return ergun_form(phi, at, 192, 0); };
  const auto forchheimer = [phi](double at) { return ergun_form(phi, at, 182, 1.92); };
  const auto turbulent = [phi](double at) { return ergun_form(phi, at, 225, 1.61); };
  const auto bridge = [re](double from, double f_from, double to, double f_to) {
    return f_from + (f_to - f_from) * std::log(re / from) / std::log(to / from);
  };
  if (re <= 2.3) return darcy_regime(re);
  if (re < 5) return bridge(2.3, darcy_regime(2.3), 5, forchheimer(5));
  if (re <= 80) return forchheimer(re);
  if (re < 120) return bridge(80, forchheimer(80), 120, turbulent(120));
  return turbulent(re);
}

double kozeny_carman(double phi, double /*re*/) {
  return carman(phi);
}

double darcy(double phi, double /*re*/) {
  return ergun_form(phi, 0, 150, 0);
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
  // Multiplied out so that no power of Re is negative: at rest the inertial part is 0, without division by 0.
  const double numerator = re * (1 / e + 3 * phi * e) + 8.4 * std::pow(re, 1 - 0.343);
  const double power = std::pow(re, (1 + 4 * phi) / 2);
  const double onset = power / (power + std::pow(10.0, 3 * phi));
  return van_der_hoef(phi) + 0.413 / (24 * cube(e)) * numerator * onset;
}

double di_felice(double phi, double re) {
  const double chi = 3.7 - 0.65 * di_felice_bell(re);
  return dallavalle(re) * std::pow(1 - phi, -(chi + 1));
}

double rong(double phi, double re) {
  const double e = 1 - phi;
  const double chi = 2.65 * (e + 1) - (5.3 - 3.5 * e) * e * e * di_felice_bell(re);
  return dallavalle(re) * std::pow(e, -(chi + 1));
}

double tang(double phi, double re) {
  const double e = 1 - phi;
  const double e4 = e * cube(e);
  const double linear = 0.11 * phi * (1 + phi) - 0.00456 / e4;
  const double power = 0.169 * e + 0.0644 / e4;
  return van_der_hoef(phi) + (linear * re + power * std::pow(re, 1 - 0.343)) / e;
}

double tenneti(double phi, double re) {
  const double e = 1 - phi;
  const double single_sphere = 1 + 0.15 * std::pow(re, 0.687);
  const double viscous = 5.81 * phi / cube(e) + 0.48 * std::cbrt(phi) / (e * cube(e));
  const double inertial = cube(phi) * re * (0.95 + 0.61 * cube(phi) / (e * e));
  return single_sphere / cube(e) + viscous + inertial;
}

bool within(const Range& range, double phi, double re) {
  if (phi <= 0) return true;
  return phi >= range.phi_min && phi <= range.phi_max && re >= range.re_min && re <= range.re_max;
}

const std::vector<Law>& laws() {
  static const std::vector<Law> table = {
      {"Ergun", ergun, "Ergun 1952", {0.2, open_end, 0, open_end}},
      {"Fand", fand, "Fand, Kim, Lam & Phan 1987", {0.55, open_end, 0, open_end}},
      {"KozenyCarman", kozeny_carman, "Carman 1937", {0.4, open_end, 0, 2.3}},
      {"Darcy", darcy, "viscous part of Ergun 1952", {0.2, open_end, 0, 2.3}},
      {"WenYu", wen_yu, "Wen & Yu 1966", {0, 0.2, 0, open_end}},
      {"ErgunWenYu", ergun_wen_yu, "Gidaspow 1994", everywhere},
      {"Hill", hill, "Hill, Koch & Ladd 2001", {0.0953, open_end, 0, 200}},
      {"Benyahia", benyahia, "Benyahia, Syamlal & O'Brien 2006", everywhere},
      {"Beetstra", beetstra, "Beetstra, van der Hoef & Kuipers 2007", {0.1, 0.6, 20, 1000}},
      {"DiFelice", di_felice, "Di Felice 1994", everywhere},
      {"Rong", rong, "Rong, Dong & Yu 2013", {0.2, open_end, 0, open_end}},
      {"Tang", tang, "Tang, Peters, Kuipers, Kriebitzsch & van der Hoef 2015", {0, 0.6, 0, 1000}},
      {"Tenneti", tenneti, "Tenneti, Garg & Subramaniam 2011", {0, 0.5, 0, 300}},
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
  if (!(slip > 0 && fluid.viscosity > 0)) return 0;
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

double polydispersity_factor(double phi, double d32, double d43) {
  return 1 + 0.064 * (1 - phi) * d43 / d32;
}

}  // namespace millfoam::drag
