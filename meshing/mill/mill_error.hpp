// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace millfoam::meshing {

/// A `mill.yaml` that cannot be used; the message is "file:line: key 'a.b' = value: expected …", or
/// "--set a.b=value: key …" for a value of the command line.
class MillError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace millfoam::meshing
