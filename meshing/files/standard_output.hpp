// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <iostream>
#include <stdexcept>

namespace millfoam {

/// For the end of a program. Throws std::runtime_error where what it printed to its standard output, through
/// std::cout or stdout, was not written, as on a full disk.
inline void require_printed() {
  std::cout.flush();
  const bool flushed = std::fflush(stdout) == 0;
  if (std::cout && flushed && std::ferror(stdout) == 0) return;
  throw std::runtime_error("standard output: cannot be written: the disk is full, or nothing reads it");
}

}  // namespace millfoam
