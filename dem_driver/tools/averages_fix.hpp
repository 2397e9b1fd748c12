// SPDX-License-Identifier: GPL-3.0-or-later
// For millLiggghts only: includes LIGGGHTS.
#pragma once

#include <liggghts/lammps.h>

#include <exception>
#include <string>

namespace millfoam::dem_driver {

/// Ends the program on all ranks, with the error in the log.
using Stop = void (*)(const std::exception&);

/// Puts a fix that makes averages in the place of the fix `name`, which the deck has just made: LIGGGHTS
/// calls it at each record, on every rank with its own balls, with the velocities of the whole step, as dumps
/// have them. At a step other than the run's first one, the averages resume from their state after this step.
/// LIGGGHTS owns it.
/// @param order  file of the averages, read_averages_order
/// @param stop  called with what is thrown at a record, because no exception may pass through LIGGGHTS
/// Throws as read_averages_order and LiveAverages.
void make_averages(LAMMPS_NS::LAMMPS& liggghts, const std::string& name, const std::string& order, Stop stop);

}  // namespace millfoam::dem_driver
