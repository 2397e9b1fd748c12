// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Drag of a bed of equal spheres on the fluid in its pores: one pure function per published correlation, all
/// brought to one convention, and the table of them.
///
/// Symbols: phi solidity of the bed, e = 1 - phi voidage, d diameter (m), v interstitial slip |u_s - u_f|
/// (m/s), rho and mu the fluid's density (kg/m^3) and viscosity (Pa s).
///
///     Re   = rho e v d / mu                     Reynolds number on the diameter and the superficial slip
///     F    = (drag + the sphere's share of the mean pressure gradient) / (3 pi mu d e v)
///     beta = 18 mu phi e^2 F / d^2              exchange coefficient, kg/(m^3 s)
///     -dp/dx = beta v / e = 18 mu phi e F v/d^2 pressure gradient in a fixed bed, Pa/m
///
/// Correlations published as drag alone (Ergun, Wen-Yu, Beetstra) are divided by e; Hill-Koch-Ladd and
/// Benyahia are published as totals.
namespace millfoam::drag {

/// Ergun 1952, Chem. Eng. Prog. 48:89. Dense beds; goes to 0 with phi.
double ergun(double phi, double re);

/// Wen & Yu 1966, Chem. Eng. Prog. Symp. Ser. 62:100. Dilute, phi <= 0.2; the friction factor is constant
/// above Re 1000.
double wen_yu(double phi, double re);

/// Gidaspow's combination: Ergun for phi > 0.2, else Wen-Yu; jumps there by 1.15 (Re 0) to 3.75 (Re 1000)
/// times.
double ergun_wen_yu(double phi, double re);

/// Hill, Koch & Ladd 2001, J. Fluid Mech. 448:213 and 448:243. Re below about 200; the inertial part was
/// fitted for phi >= 0.0953 and extrapolates below.
double hill(double phi, double re);

/// Benyahia, Syamlal & O'Brien 2006, Powder Technol. 162:166: Hill-Koch-Ladd extended to all phi and Re.
double benyahia(double phi, double re);

/// Beetstra, van der Hoef & Kuipers 2007, AIChE J. 53:489. Fitted for phi 0.1 to 0.6 and Re 20 to 1000.
double beetstra(double phi, double re);

/// A correlation by its name.
struct Law {
  std::string_view name;                    ///< as the user writes it
  double (*factor)(double phi, double re);  ///< F(phi, Re) for 0 <= phi < 1, Re >= 0
  std::string_view reference;               ///< author and year
};

/// Every law, in the order in which tables and plots show them.
const std::vector<Law>& laws();

/// The law of that name. Throws std::invalid_argument, naming the known ones, when there is none.
const Law& find_law(std::string_view name);

/// A fluid as the drag sees it.
struct Fluid {
  double density;    ///< kg/m^3
  double viscosity;  ///< Pa s; for a Bingham slurry its plastic viscosity
};

/// Reynolds number rho e v d / mu for slip v >= 0 (m/s) and diameter d (m).
double reynolds(double phi, double slip, double diameter, const Fluid& fluid);

/// Exchange coefficient beta (kg/(m^3 s)) from F; 0 where there are no solids.
double exchange_from_factor(double phi, double diameter, double viscosity, double factor);

/// Exchange coefficient beta (kg/(m^3 s)) of a bed of solidity phi and diameter d (m) at slip v (m/s).
double exchange_coefficient(const Law& law, double phi, double slip, double diameter, const Fluid& fluid);

}  // namespace millfoam::drag
