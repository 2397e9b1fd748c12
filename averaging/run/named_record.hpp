// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace millfoam::averaging {

/// Does something with a record. What it throws, std::invalid_argument or std::out_of_range, names the
/// record.
/// @param name  of the record: the path of its dump
/// @param action  without arguments
template <typename Action>
void naming_record(const std::string& name, Action&& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(name + ": " + error.what());
  } catch (const std::out_of_range& error) {
    throw std::out_of_range(name + ": " + error.what());
  }
}

}  // namespace millfoam::averaging
