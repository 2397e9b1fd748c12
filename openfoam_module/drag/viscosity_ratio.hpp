// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace millfoam::drag {

/// Largest viscosity of a Bingham slurry over its plastic one, where nobody gives it: in mills, cases and
/// tools.
inline constexpr double usual_viscosity_ratio = 1000;

}  // namespace millfoam::drag
