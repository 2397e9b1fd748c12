// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "averaging/run/cell_setup.hpp"
#include "averaging/statistics/record_sums.hpp"

namespace millfoam::averaging {

/// A grid that holds less than this share of its volume in balls was given in another unit of length.
inline constexpr double smallest_fill = 1e-6;

/// Why a grid cannot be meant for the balls of a record: more than `largest_outside` of their volume lies
/// outside of it or of its walls, or they fill less than `smallest_fill` of it. Empty when neither, and for a
/// record without balls. The sentence has the extents of both. Throws as `sum_record`, naming the record.
/// @param setup  the grid or mesh
/// @param record  the balls
/// @param time  of the record, s
/// @param name  of the record, for the sentence
/// @param largest_outside  share of the balls' volume, 0 to 1
std::string misfit(const CellSetup& setup, const ParticleRecord& record, double time, const std::string& name,
                   double largest_outside);

/// The same where only the sums over the balls are known: the sentence has the grid's extents alone.
/// @param setup  of the grid
/// @param sums  of the record, with the cells' volumes inside the walls
/// @param name  of the record, for the sentence
/// @param largest_outside  share of the balls' volume, 0 to 1
std::string misfit(const CellSetup& setup, const RecordSums& sums, const std::string& name,
                   double largest_outside);

}  // namespace millfoam::averaging
