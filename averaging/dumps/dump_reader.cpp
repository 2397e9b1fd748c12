// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/dump_reader.hpp"

#include <system_error>

#include "averaging/dumps/dump_header.hpp"
#include "averaging/dumps/dump_input.hpp"
#include "averaging/dumps/dump_rows.hpp"
#include "averaging/dumps/text_lines.hpp"
#include "averaging/dumps/whole_gzip.hpp"

namespace millfoam::averaging {

ParticleRecord parse_dump(std::string_view text, const std::string& name) {
  TextLines lines(text, name);
  return read_record(lines, text.size());
}

ParticleRecord read_dump(const std::filesystem::path& file) {
  thread_local WholeGzip gzip;
  if (const auto text = gzip.inflate(file)) return parse_dump(*text, file.string());
  DumpInput input(file);
  TextLines lines = input.lines();
  std::error_code unknown;
  const std::uintmax_t bytes = std::filesystem::file_size(file, unknown);
  return read_record(lines, unknown ? 0 : static_cast<std::size_t>(bytes));
}

}  // namespace millfoam::averaging
