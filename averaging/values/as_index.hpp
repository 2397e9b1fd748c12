// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace millfoam::averaging {

/// A number that is known not to be negative, as an index.
inline std::size_t as_index(int number) {
  return static_cast<std::size_t>(number);
}

}  // namespace millfoam::averaging
