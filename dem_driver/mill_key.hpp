// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace millfoam::dem_driver {

/// A value of `mill.yaml` that is possible for a mill, but of which no dry run can be made. The message is
/// that of a meshing::MillError without file and line: "key 'a.b' = value: expected …".
class KeyError : public std::runtime_error {
 public:
  /// `key` is the path from the root, as in `dem.duration` or `charge.classes[1]`; an item counts from 0.
  KeyError(const std::string& key, const std::string& value, const std::string& expected);
  /// The path of the key from the root of `mill.yaml`.
  const std::string& key() const { return key_; }

 private:
  std::string key_;
};

}  // namespace millfoam::dem_driver
