// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// @file
/// The shear rate at which a slurry that is not Newtonian flows through small openings.
///
/// The averaged flow's own shear rate says nothing of the pores: in a bed that carries its slurry along it is
/// near zero while the slurry between the balls shears at hundreds per second.

namespace millfoam::drag {

/// Shear rate in the pores (1/s), 12 phi v/(e d), of a bed of solidity phi and ball diameter d (m), e = 1 -
/// phi, at interstitial slip v = |u_s - u_f| (m/s): the rate 8 v/D of a Newtonian fluid at the wall of a tube
/// of the pores' hydraulic diameter D = 4 e/(6 phi/d). A bed's concept: it goes to 0 with phi, though a lone
/// ball shears its slurry at a rate of the order of v/d.
double pore_shear_rate(double phi, double slip, double diameter);

/// Shear rate (1/s) at the walls of tubes of one diameter D in a layer with Darcy's coefficient 32/D^2
/// (1/m^2) for the velocity v (m/s) in the tubes: 8 v/D = v sqrt(2 darcy).
double tube_shear_rate(double darcy, double velocity);

}  // namespace millfoam::drag
