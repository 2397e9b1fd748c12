// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "averaging/dumps/dump_series.hpp"
#include "averaging/run/average_request.hpp"
#include "averaging/run/cell_setup.hpp"
#include "averaging/statistics/time_windows.hpp"

namespace millfoam::averaging {

/// A text that differs between any two runs that could give different results: the settings, and the names,
/// sizes and times of change of the input files.
std::string signature(const AverageRequest& request, const RunSettings& settings,
                      const std::vector<WindowPlan>& plans, const std::vector<DumpFile>& dumps);

}  // namespace millfoam::averaging
