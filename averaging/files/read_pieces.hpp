// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <cerrno>
#include <cstddef>

namespace millfoam::averaging {

/// Reads a range of a file by as many calls as it takes: one call of `pread` reads at most 0x7ffff000 bytes,
/// and may read fewer or be interrupted by a signal. Returns the number of bytes read, below `size` where the
/// file ends, or -1 for an error (errno).
/// @param data  [size] receives the bytes
/// @param size  of the range
/// @param begin  place of its first byte in the file
/// @param read  (void* data, std::size_t size, off_t begin) reads one piece, as `pread` of an open file
template <typename Read>
ssize_t read_pieces(void* data, std::size_t size, off_t begin, Read read) {
  char* const bytes = static_cast<char*>(data);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t got = read(bytes + done, size - done, begin + static_cast<off_t>(done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return -1;
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return static_cast<ssize_t>(done);
}

}  // namespace millfoam::averaging
