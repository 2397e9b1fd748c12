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
/// Correlations published as drag only (Ergun, Wen-Yu, Beetstra, Di Felice, Rong, Tang) are divided by e;
/// Hill-Koch-Ladd, Benyahia and Tenneti are published as totals, Fand, Kozeny-Carman and Darcy as pressure
/// gradients.
///
/// Each function is defined for 0 <= phi < 1 and every Re >= 0. The range in which it is valid is in its
/// comment and, for programs, in the table. The limits are those usually quoted for the publication. Where
/// the publication gives words only, they were chosen here, and the comment says so.
namespace millfoam::drag {

/// Ergun 1952, Chem. Eng. Prog. 48:89. Dense beds; goes to 0 with phi.
/// Range: phi >= 0.2, the chosen number being Gidaspow's, who leaves Ergun there.
double ergun(double phi, double re);

/// Fand, Kim, Lam & Phan 1987, J. Fluids Eng. 109:268. Ergun's form with other constants in the regimes of
/// Darcy (Re <= 2.3), Forchheimer (5 to 80) and turbulence (Re >= 120); goes to 0 with phi. In the two gaps,
/// which the publication leaves open, F is linear in ln Re between their ends: a choice made here.
/// Range: phi >= 0.55, chosen as the loosest random packing (Onoda & Liniger 1990, Phys. Rev. Lett. 64:2727),
/// for it was measured on packed spheres. The gaps in Re count as within.
double fand(double phi, double re);

/// Kozeny & Carman's viscous bed with Carman's constant 5 (Carman 1937, Trans. Inst. Chem. Eng. 15:150); goes
/// to 0 with phi.
/// Range: phi >= 0.4 and Re <= 2.3; chosen, because it is only the limit Re -> 0: Hill, Koch & Ladd's beds
/// follow it from phi 0.4 on, and 2.3 is the end of Fand's regime without inertia.
double kozeny_carman(double phi, double re);

/// The same with the constant 25/6, that is Ergun's 150: Darcy's law as Cleary uses it; goes to 0 with phi.
/// Range: phi >= 0.2 as Ergun and Re <= 2.3 as Kozeny-Carman, both chosen.
double darcy(double phi, double re);

/// Wen & Yu 1966, Chem. Eng. Prog. Symp. Ser. 62:100. The friction factor is constant above Re 1000.
/// Range: phi <= 0.2.
double wen_yu(double phi, double re);

/// Gidaspow's combination: Ergun for phi > 0.2, else Wen-Yu; jumps there by 1.15 (Re 0) to 3.75 (Re 1000)
/// times. Range: all.
double ergun_wen_yu(double phi, double re);

/// Hill, Koch & Ladd 2001, J. Fluid Mech. 448:213 and 448:243.
/// Range: phi >= 0.0953, below which the inertial part is extrapolated, and Re <= 200 (100 on the radius).
double hill(double phi, double re);

/// Benyahia, Syamlal & O'Brien 2006, Powder Technol. 162:166: Hill-Koch-Ladd extended to all phi and Re.
/// Range: all.
double benyahia(double phi, double re);

/// Beetstra, van der Hoef & Kuipers 2007, AIChE J. 53:489.
/// Range: phi 0.1 to 0.6 and Re 20 to 1000, where it was fitted; its limit at Re 0 was found apart.
double beetstra(double phi, double re);

/// Di Felice 1994, Int. J. Multiphase Flow 20:153. Goes to 0.96 where dilute and slow. Range: all.
double di_felice(double phi, double re);

/// Rong, Dong & Yu 2013, Chem. Eng. Sci. 99:44: Di Felice's form fitted to resolved flows through packed
/// beds of equal spheres of a wide range of porosity. Goes to 0.96 where dilute and slow.
/// Range: phi >= 0.2; chosen, as for Ergun.
double rong(double phi, double re);

/// Tang, Peters, Kuipers, Kriebitzsch & van der Hoef 2015, AIChE J. 61:688.
/// Range: phi <= 0.6 and Re <= 1000. Far beyond it F is negative, where its term linear in Re is: at phi 0.60
/// from Re 34910 on, at 0.65 from 10640, at 0.70 from 5480; and below phi 0.05 from Re 1e5 or more.
double tang(double phi, double re);

/// Tenneti, Garg & Subramaniam 2011, Int. J. Multiphase Flow 37:1072.
/// Range: phi <= 0.5 and Re <= 300.
double tenneti(double phi, double re);

/// Where a correlation is valid: both ends included, 0 and infinity where an end is open.
struct Range {
  double phi_min,  ///< smallest solidity
      phi_max;     ///< largest solidity
  double re_min,   ///< smallest Reynolds number
      re_max;      ///< largest Reynolds number
};

/// Whether (phi, Re) lies in the range. Where there are no solids there is no drag: phi = 0 is within every
/// range.
bool within(const Range& range, double phi, double re);

/// A correlation by its name.
struct Law {
  std::string_view name;                    ///< as the user writes it
  double (*factor)(double phi, double re);  ///< F(phi, Re) for 0 <= phi < 1, Re >= 0
  std::string_view reference;               ///< author and year
  Range range;                              ///< where it is valid
};

/// Every law, in the order in which tables and plots show them.
const std::vector<Law>& laws();

/// The law of that name. Throws std::invalid_argument, naming the known ones, when there is none.
const Law& find_law(std::string_view name);

/// A fluid as the drag sees it.
struct Fluid {
  double density;    ///< kg/m^3
  double viscosity;  ///< Pa s; for a slurry that is not Newtonian see FlowCurve
};

/// Reynolds number rho e v d / mu for slip v >= 0 (m/s) and diameter d (m). At rest it is 0, also in a fluid
/// without viscosity: a slurry that thickens with the shear rate has none there, and its drag goes to 0.
double reynolds(double phi, double slip, double diameter, const Fluid& fluid);

/// Exchange coefficient beta (kg/(m^3 s)) from F; 0 where there are no solids.
double exchange_from_factor(double phi, double diameter, double viscosity, double factor);

/// Exchange coefficient beta (kg/(m^3 s)) of a bed of solidity phi and diameter d (m) at slip v (m/s).
double exchange_coefficient(const Law& law, double phi, double slip, double diameter, const Fluid& fluid);

/// Factor on beta, taken at the Sauter mean diameter, for a mixture of sizes: 1 + 0.064 e d43/d32 with
/// d32 = sum V / sum(V/d) and d43 = sum(V d) / sum V over the balls of volume V (m). It is the sum over the
/// sizes of van der Hoef, Beetstra & Kuipers 2005 (J. Fluid Mech. 528:233) and Beetstra et al. 2007,
/// F_i = (e y + phi y^2 + 0.064 e y^3) F with y = d_i/d32. The term in y^3 is a fit to mixtures and does not
/// vanish for one size: there the factor is 1 + 0.064 e, not 1.
double polydispersity_factor(double phi, double d32, double d43);

}  // namespace millfoam::drag
