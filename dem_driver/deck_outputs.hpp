// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "dem_driver/dem_plan.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

// The parts of the deck that make LIGGGHTS write what it computes.

/// Name of the deck's fix through which the balls' averages are made. Only millLiggghts makes them.
inline constexpr char averages_fix[] = "averages";

/// Name of the deck's fix that writes the torque on each wall of a stirred mill, and of its files.
inline constexpr char part_torques_kind[] = "partTorques";

/// Number of bins of the overlaps' histograms, of equal width from 0 on.
inline constexpr int overlap_bins = 1000;
/// Upper end of these histograms over the largest ball's diameter.
inline constexpr double overlap_range = 0.2;

/// What LIGGGHTS computes of every contact, and what it prints.
void write_thermo(std::ostream& out, const DemPlan& plan);

/// Torque of the charge on the walls that turn about the axis, and in a stirred mill also on each part, mean
/// over every step of a record; kinetic and potential energy at every record; histograms of the overlaps, for
/// which LIGGGHTS computes all contacts once more. `start` is the step from which on it writes, which is in
/// the files' names.
void write_results(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan,
                   const std::vector<std::string>& parts, long start);

/// The contacts and, because LIGGGHTS writes no spin of a contact's balls, the balls at the same steps.
void write_contacts(std::ostream& out, const DemPlan& plan);

/// The balls' averages are made by millLiggghts, which finds the settings next to the deck.
void write_averages(std::ostream& out, const DemPlan& plan);

/// The balls of every record, in a folder that is made where it is missing; of superquadrics `radius` is that
/// of the sphere around one.
void write_dumps(std::ostream& out, const DemPlan& plan);

}  // namespace millfoam::dem_driver
