// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "averaging/dumps/dump_columns.hpp"
#include "averaging/dumps/dump_header.hpp"
#include "averaging/dumps/text_lines.hpp"
#include "averaging/values/particle.hpp"

namespace millfoam::averaging {

/// Reads the rows of a dump, one for each particle, and checks their values.
class DumpRows {
 public:
  /// Finds the columns that the header names; `lines` is just behind it. Throws DumpError as `find_columns`,
  /// and for scaled positions without a box or in a tilted one.
  DumpRows(const DumpHeader& header, TextLines& lines);

  /// Appends the header's number of particles to `record`. Throws DumpError for fewer of them, a row of the
  /// wrong length, an impossible value, or two particles of one id.
  void read(ParticleRecord& record);

 private:
  /// The values of a row that are read.
  struct Row {
    long long id = 0;
    std::array<double, quantities> values{};
  };

  /// Reads a row that begins at `text`; returns the next row, or null when this one must be read carefully.
  /// `row_` may be overwritten even then.
  const char* read_quickly(const char* text, const char* end);
  void read_quick_rows(ParticleRecord& record);

  /// Reads any row. Throws DumpError when it is not one.
  void read_carefully(std::string_view line);
  double column_value(std::string_view word, std::size_t quantity) const;

  /// Checks the row's values, which are on `line`, and appends the particle.
  void append(std::size_t line, ParticleRecord& record) const;
  Superquadric shape(std::size_t line) const;
  [[noreturn]] void refuse(std::size_t line, const std::string& reason) const;

  TextLines& lines_;
  DumpColumns columns_;
  std::size_t count_;
  DumpBox box_;
  Row row_;
};

/// Reads a whole dump, of one record. Throws DumpError as `parse_dump`.
/// @param lines  at the beginning of the dump
/// @param bytes  about the length of the text: a damaged count must not reserve more than it can hold
ParticleRecord read_record(TextLines& lines, std::size_t bytes);

}  // namespace millfoam::averaging
