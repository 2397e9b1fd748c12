// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "averaging/values/particle.hpp"

namespace millfoam::averaging {

/// The places of two particles of one id, the lower place first; nothing when all ids differ. Its cost is
/// linear in the number of particles for ids as dense as LIGGGHTS gives them, that of sorting for any others.
std::optional<std::pair<std::size_t, std::size_t>> find_duplicates(const std::vector<Particle>& particles);

}  // namespace millfoam::averaging
