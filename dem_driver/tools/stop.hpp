// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>

namespace millfoam::dem_driver {

/// Ends millLiggghts on all ranks, with the error in the log as one of LIGGGHTS.
[[noreturn]] void stop(const std::exception& error);

}  // namespace millfoam::dem_driver
