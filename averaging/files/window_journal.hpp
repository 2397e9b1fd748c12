// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>

#include "averaging/files/solids_file.hpp"

namespace millfoam::averaging {

/// Finished windows on their way to a solids file: a plain file to which rows are only ever appended, each
/// with its own checksum. Unlike an HDF5 file it stays readable whenever the program that writes it is
/// killed; rows that were cut are dropped when it is opened again. All members throw SolidsFileError.
class WindowJournal {
 public:
  /// Opens a journal for windows of `cells` cells, keeping up to `rows` whole rows that are there; the file
  /// is made when it is not there. Throws when fewer than `rows` whole rows are there.
  WindowJournal(const std::filesystem::path& path, std::size_t cells, bool inside_fractions,
                std::size_t rows);
  ~WindowJournal();
  WindowJournal(WindowJournal&& other) noexcept;
  WindowJournal& operator=(WindowJournal&&) = delete;
  WindowJournal(const WindowJournal&) = delete;
  WindowJournal& operator=(const WindowJournal&) = delete;

  std::size_t rows() const { return rows_; }

  /// Appends the next window. Every field must have the size of `cells`.
  void append(const WindowAverage& window);

  /// Waits until what was appended is on the disk.
  void sync();

  /// Window `row`, from 0. Throws when its checksum is wrong.
  WindowAverage read(std::size_t row) const;

 private:
  std::size_t row_bytes() const;

  std::filesystem::path path_;
  std::size_t cells_;
  bool inside_fractions_;
  int file_ = -1;
  std::size_t rows_ = 0;
};

}  // namespace millfoam::averaging
