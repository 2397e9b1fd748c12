// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>

#include "averaging/files/solids_file.hpp"

namespace millfoam::averaging {

/// Finished windows on their way to a solids file: a plain file to which rows are only ever appended, each
/// with its own checksum. Unlike an HDF5 file it stays readable whenever the program that writes it is
/// killed. All members throw SolidsFileError.
class WindowJournal {
 public:
  /// Whether a journal of the run `id` is there with at least `rows` rows for windows of `cells` cells.
  static bool holds(const std::filesystem::path& path, std::size_t id, std::size_t cells,
                    bool inside_fractions, std::size_t rows);

  /// Opens a journal, keeping its first `rows` rows and dropping others. With no rows it starts a new
  /// one and drops the old one; with some, the old one must hold them (`holds`).
  /// @param path  of the journal
  /// @param id  of the run, so that no other run's windows are taken for its own
  /// @param cells  of a window's fields
  /// @param inside_fractions  whether windows have them
  /// @param rows  finished windows to keep, 0 for a new journal
  WindowJournal(const std::filesystem::path& path, std::size_t id, std::size_t cells, bool inside_fractions,
                std::size_t rows);
  ~WindowJournal();
  /// Takes over the open file; `other` must not be used any more.
  WindowJournal(WindowJournal&& other) noexcept;
  WindowJournal& operator=(WindowJournal&&) = delete;
  WindowJournal(const WindowJournal&) = delete;
  WindowJournal& operator=(const WindowJournal&) = delete;

  std::size_t rows() const { return rows_; }  ///< number of windows in it

  /// Appends the next window. Every field must have the size of `cells`.
  void append(const WindowAverage& window);

  /// Waits until what was appended is on the disk.
  void sync();

  /// Window `row`, from 0. Throws when its checksum is wrong.
  WindowAverage read(std::size_t row) const;

 private:
  void write_all(const void* data, std::size_t size);

  std::filesystem::path path_;
  bool inside_fractions_;
  std::size_t row_bytes_;
  int file_ = -1;
  std::size_t rows_ = 0;
};

}  // namespace millfoam::averaging
