// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "averaging/dumps/dump_header.hpp"
#include "averaging/dumps/dump_series.hpp"
#include "averaging/run/average_run.hpp"

namespace millfoam::averaging {

/// Compares the numbers of balls in the headers of dumps that are averaged. `note` gets a warning with the
/// first dump whose number is not that of the one before. Throws DumpError for a dump without balls between
/// such that have some.
/// @param dumps  in order of time
/// @param first  number of the first dump that is averaged
/// @param end  number after the last one
/// @param note  takes a sentence
void check_numbers_of_balls(const std::vector<DumpFile>& dumps, std::size_t first, std::size_t end,
                            const std::function<void(const std::string&)>& note);

/// Throws std::invalid_argument for a grid or mesh that repeats after another length than the balls do.
/// @param request  of the averages
/// @param box  of the dumps
/// @param name  of the dump, for the message
void require_period_of(const AverageRequest& request, const DumpBox& box, const std::string& name);

/// The warning that balls lie outside a grid that spans the dumps' period and does not repeat; empty where it
/// repeats, or spans another length, and where no volume is outside.
/// @param request  of the averages
/// @param grid  of the averages
/// @param box  of the dumps
/// @param outside  largest share of the balls' volume outside the grid, of any window
std::string missing_period(const AverageRequest& request, const Grid& grid, const DumpBox& box,
                           double outside);

}  // namespace millfoam::averaging
