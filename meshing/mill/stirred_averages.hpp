// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meshing/mill/mill.hpp"
#include "meshing/mill/yaml_section.hpp"

namespace millfoam::meshing {

/// The keys frame, radial, azimuthal and axial of a stirred mill's `averages`. By default rings turn with the
/// impeller, and have edges of about a ball along r, z and, at two thirds of the radius, around the axis.
/// `diameter` is that of the largest balls, m. Throws MillError for impossible numbers.
Rings read_rings(const Section& in, const Geometry& geometry, double diameter);

}  // namespace millfoam::meshing
