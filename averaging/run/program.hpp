// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "millfoam_version.hpp"

namespace millfoam::averaging {

/// The name that files carry and --version prints: millAverage and the version it was built from.
inline std::string program() {
  return std::string("millAverage ") + version();
}

}  // namespace millfoam::averaging
