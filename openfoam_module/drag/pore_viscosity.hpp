// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// @file
/// The viscosity with which a Bingham slurry drags on a bed, when it is taken in the bed's pores.
///
/// The averaged flow's own shear rate says nothing of the pores: in a bed that carries its slurry along it is
/// near zero while the slurry between the balls shears at hundreds per second.

namespace millfoam::drag {

/// Shear stress tau = yield_stress + plastic_viscosity * rate where the slurry yields.
struct BinghamSlurry {
  double yield_stress;       ///< Pa
  double plastic_viscosity;  ///< Pa s
};

/// Shear rate in the pores (1/s), 12 phi v/(e d), of a bed of solidity phi and ball diameter d (m), e = 1 -
/// phi, at interstitial slip v = |u_s - u_f| (m/s): the rate 8 v/D of a Newtonian fluid at the wall of a tube
/// of the pores' hydraulic diameter D = 4 e/(6 phi/d). A bed's concept: it goes to 0 with phi, though a lone
/// ball shears its slurry at a rate of the order of v/d.
double pore_shear_rate(double phi, double slip, double diameter);

/// Apparent viscosity (Pa s) mu + tau0/rate at the pores' shear rate, at most `cap` (Pa s, not below the
/// plastic viscosity mu); use it both in Re and in beta.
///
/// Without slip the rate is 0 and so the apparent viscosity unbounded: there, and down to the slip at which
/// mu + tau0/rate = cap, it is the cap. It falls continuously with the slip from the cap to mu, so the drag
/// beta v goes to 0 with v: the cap makes the unyielded slurry creep through the bed instead of locking it.
/// The cap that fits the flow's own regularisation is its viscosity at rest: viscosityRatio * mu for the
/// bi-viscosity form, mu + m tau0 for Papanastasiou's, whose curve lies up to a factor 1 - 1/e = 0.63 lower
/// in its yield part where m times the rate is 1.
double pore_viscosity(const BinghamSlurry& slurry, double shear_rate, double cap);

}  // namespace millfoam::drag
