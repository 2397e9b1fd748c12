// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>

#include "dem_driver/dem_plan.hpp"
#include "dem_driver/forecast.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver {

/// Prints the mill's sense of rotation and speed, the choice of softness and time-step, and the charge.
void print_plan(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan);

/// A forecast with what it was made from.
struct MeasuredForecast {
  Forecast forecast;  ///< of the whole run
  Cost cost;          ///< measured on a trial mill
  int ranks = 1;      ///< for which both are made
};

/// Writes the same as JSON, format "millfoam-dem-plan" (FORMATS.md), with the forecast where there
/// is one. Throws std::runtime_error naming the file when it cannot be written.
void write_plan_file(const std::filesystem::path& file, const meshing::Mill& mill, const DemPlan& plan,
                     const std::optional<MeasuredForecast>& forecast = std::nullopt);

}  // namespace millfoam::dem_driver
