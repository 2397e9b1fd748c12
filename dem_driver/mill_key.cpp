// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/mill_key.hpp"

namespace millfoam::dem_driver {

KeyError::KeyError(const std::string& key, const std::string& value, const std::string& expected)
    : std::runtime_error("key '" + key + "' = " + value + ": expected " + expected), key_(key) {}

}  // namespace millfoam::dem_driver
