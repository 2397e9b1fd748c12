// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "meshing/mill/mill.hpp"

namespace millfoam::meshing {

/// Largest overlap over the smaller diameter that the softened modulus is chosen for where `mill.yaml` says
/// neither a modulus nor an overlap. Chosen by cases/studies/softening: against stiffer balls the charge's
/// power is 3 % less and its maps are 1 % apart; Brosh, Kalman & Levy accept up to 0.15.
inline constexpr double default_largest_overlap = 0.07;

/// Names that `materials.ball` and `materials.wall` know.
std::vector<std::string> material_names();

/// Names of contacts, "glass-glass" and so on: a ball's material first.
std::vector<std::string> contact_names();

/// A material of that name. Glass: M. Malahe, MSc thesis, University of Cape Town, 2012 (shear modulus 26.42
/// GPa, Poisson's ratio 0.23). The others are walls, of which only Poisson's ratio enters the dry run: usual
/// values of handbooks. Throws std::out_of_range for another name.
Material named_material(const std::string& name);

/// The contact of that name, as published in the same thesis. Throws std::out_of_range for another name.
Contact named_contact(const std::string& name);

}  // namespace millfoam::meshing
