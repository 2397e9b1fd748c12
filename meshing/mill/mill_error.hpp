// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace millfoam::meshing {

/// A `mill.yaml` that cannot be used; the message is "file:line: key 'a.b' = value: expected …", or
/// "--set a.b=value: key …" for a value of the command line.
class MillError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A path in `mill.yaml` that is no key.
class UnknownKey : public MillError {
  using MillError::MillError;
};

/// A value of `mill.yaml` that is possible for a mill, but of which no mesh or no dry run can be made. The
/// message is that of a MillError without file and line: "key 'a.b' = value: expected …".
class KeyError : public std::runtime_error {
 public:
  /// `key` is the path from the root, as in `dem.duration` or `charge.classes[1]`; an item counts from 0.
  KeyError(const std::string& key, const std::string& value, const std::string& expected)
      : std::runtime_error("key '" + key + "' = " + value + ": expected " + expected), key_(key) {}
  /// The path of the key from the root of `mill.yaml`.
  const std::string& key() const { return key_; }

 private:
  std::string key_;
};

}  // namespace millfoam::meshing
