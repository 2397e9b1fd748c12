// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace millfoam::averaging {

/// Dumps that cannot be used; the message begins with "file:line:" or the file's name.
class DumpError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace millfoam::averaging
