// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace millfoam::averaging {

/// What happens on the way.
struct AverageProgress {
  std::function<void(std::size_t done, std::size_t of)> records;  ///< as records are averaged
  std::function<void(const std::string& sentence)> note;          ///< records left out, windows not full
};

}  // namespace millfoam::averaging
