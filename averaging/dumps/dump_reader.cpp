// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/dump_reader.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "averaging/dumps/text_lines.hpp"

namespace millfoam::averaging {

namespace {

constexpr std::array<std::string_view, 8> required_columns{"id", "x", "y", "z", "vx", "vy", "vz", "radius"};

DumpError truncated(const TextLines& lines, const std::string& expected) {
  return DumpError(lines.place() +
                   (lines.at_end() ? "the text ends here" : "the text ends within this line") +
                   ", expected " + expected + "; the dump is truncated");
}

std::string_view next_line(TextLines& lines, const char* expected) {
  const std::optional<std::string_view> line = lines.next();
  if (!line) throw truncated(lines, expected);
  return *line;
}

long long next_count(TextLines& lines, const char* what) {
  std::string_view line = next_line(lines, what);
  const std::string text(line);
  const auto value = as_number<long long>(take_word(line));
  if (!value || *value < 0 || !take_word(line).empty()) {
    throw DumpError(lines.place() + what + " is '" + text + "', expected a whole number, not negative");
  }
  return *value;
}

void skip_box_bounds(TextLines& lines) {
  for (int axis = 0; axis < 3; ++axis) {
    std::string_view line = next_line(lines, "the bounds of the box along x, y and z");
    const std::string text(line);
    const auto lower = as_number<double>(take_word(line));
    const auto upper = as_number<double>(take_word(line));
    if (!lower || !upper || !std::isfinite(*lower) || !std::isfinite(*upper)) {
      throw DumpError(lines.place() + "box bounds are '" + text + "', expected two numbers");
    }
  }
}

/// What stands in a dump before its particles.
struct Header {
  std::optional<long long> step;
  std::optional<long long> count;
  std::string columns;  ///< names, separated by blanks
};

bool starts_with(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

/// Reads an item that the particles do not depend on. `title` is what follows "ITEM: ".
void read_item(TextLines& lines, std::string_view title, Header& header) {
  if (title == "TIMESTEP") {
    header.step = next_count(lines, "the time-step");
  } else if (title == "NUMBER OF ATOMS") {
    header.count = next_count(lines, "the number of atoms");
  } else if (starts_with(title, "BOX BOUNDS")) {
    skip_box_bounds(lines);
  } else {
    while (!lines.at_end() && !starts_with(lines.peek(), "ITEM:")) next_line(lines, "a whole line");
  }
}

Header read_header(TextLines& lines) {
  constexpr std::string_view item = "ITEM: ", atoms = "ATOMS ";
  Header header;
  while (true) {
    const std::string_view line = next_line(lines, "'ITEM: ATOMS' and the particles");
    if (!starts_with(line, item)) {
      throw DumpError(lines.place() + "'" + std::string(line.substr(0, 40)) +
                      "', expected a line that begins with 'ITEM: '");
    }
    const std::string_view title = line.substr(item.size());
    if (starts_with(title, atoms)) {
      if (!header.step) throw DumpError(lines.place() + "'ITEM: TIMESTEP' is missing before the particles");
      if (!header.count)
        throw DumpError(lines.place() + "'ITEM: NUMBER OF ATOMS' is missing before the particles");
      header.columns = title.substr(atoms.size());
      return header;
    }
    read_item(lines, title, header);
  }
}

/// For each column of the file, the number of the required column that it is, or -1.
std::vector<int> match_columns(const std::string& names, const std::string& place) {
  std::vector<int> wanted;
  std::string_view rest = names;
  for (std::string_view name = take_word(rest); !name.empty(); name = take_word(rest)) {
    const auto found = std::find(required_columns.begin(), required_columns.end(), name);
    wanted.push_back(found == required_columns.end() ? -1
                                                     : static_cast<int>(found - required_columns.begin()));
  }
  for (std::size_t c = 0; c < required_columns.size(); ++c) {
    const auto times = std::count(wanted.begin(), wanted.end(), static_cast<int>(c));
    if (times == 1) continue;
    std::string message = place + "column '";
    message.append(required_columns[c]).append(times == 0 ? "' is missing" : "' is there twice");
    throw DumpError(message.append("; the columns are '").append(names).append("'"));
  }
  return wanted;
}

template <typename Number>
Number column_value(std::string_view word, std::size_t column, const char* expected, const TextLines& lines) {
  const auto value = as_number<Number>(word);
  if (!value || !std::isfinite(static_cast<double>(*value))) {
    throw DumpError(lines.place() + "column '" + std::string(required_columns[column]) + "' is '" +
                    std::string(word) + "', expected " + expected);
  }
  return *value;
}

DumpError wrong_length(const TextLines& lines, const std::string& found, std::size_t expected) {
  return DumpError(lines.place() + "this row has " + found + " values, expected " + std::to_string(expected));
}

Particle read_particle(const TextLines& lines, std::string_view line, const std::vector<int>& columns) {
  Particle particle;
  std::array<double, required_columns.size()> values{};
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::string_view word = take_word(line);
    if (word.empty()) throw wrong_length(lines, std::to_string(c), columns.size());
    if (columns[c] < 0) continue;
    const auto column = static_cast<std::size_t>(columns[c]);
    if (column == 0) {
      particle.id = column_value<long long>(word, column, "a whole number", lines);
    } else {
      values[column] = column_value<double>(word, column, "a finite number", lines);
    }
  }
  if (!take_word(line).empty()) throw wrong_length(lines, "more", columns.size());
  particle.position = {values[1], values[2], values[3]};
  particle.velocity = {values[4], values[5], values[6]};
  particle.radius = values[7];
  if (!(particle.radius > 0)) {
    throw DumpError(lines.place() + "radius is " + std::to_string(particle.radius) +
                    ", expected a positive length in m");
  }
  return particle;
}

/// A file opened by zlib, which reads plain and gzip alike.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& file)
      : name_(file.string()), file_(gzopen(file.c_str(), "rb")) {
    if (file_ == nullptr) throw DumpError(name_ + ": cannot open this file");
    gzbuffer(file_, 1U << 17);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile() { gzclose_r(file_); }

  /// Appends up to `most` bytes to `text`; returns whether there may be more.
  bool read(std::string& text, unsigned most) {
    const std::size_t before = text.size();
    text.resize(before + most);
    const int got = gzread(file_, text.data() + before, most);
    int status = Z_OK;
    const char* const reason = gzerror(file_, &status);
    // A gzip stream that stops before its end gives its last bytes and only then, as Z_BUF_ERROR, the
    // failure.
    if (got < 0 || status != Z_OK) {
      throw DumpError(name_ + ": cannot be read to its end (" + reason +
                      "); the dump is truncated or damaged");
    }
    text.resize(before + static_cast<std::size_t>(got));
    return static_cast<unsigned>(got) == most;
  }

 private:
  std::string name_;
  gzFile file_;
};

}  // namespace

ParticleRecord parse_dump(std::string_view text, const std::string& name) {
  TextLines lines(text, name);
  const Header header = read_header(lines);
  const std::vector<int> columns = match_columns(header.columns, lines.place());

  ParticleRecord record;
  record.step = *header.step;
  // A row takes 16 bytes at least: a damaged count must not reserve more than the text can hold.
  record.particles.reserve(std::min(static_cast<std::size_t>(*header.count), text.size() / 16 + 1));
  for (long long p = 0; p < *header.count; ++p) {
    const std::optional<std::string_view> line = lines.next();
    if (!line) {
      throw truncated(lines, "particle " + std::to_string(p + 1) + " of " + std::to_string(*header.count));
    }
    record.particles.push_back(read_particle(lines, *line, columns));
  }
  if (!lines.at_end()) {
    const bool second = starts_with(lines.peek(), "ITEM:");
    next_line(lines, "a whole line");
    throw DumpError(lines.place() + (second
                                         ? "a second record begins, expected one record in a file"
                                         : "more rows than the header's " + std::to_string(*header.count)));
  }
  return record;
}

ParticleRecord read_dump(const std::filesystem::path& file) {
  constexpr unsigned block = 1U << 20;
  InputFile input(file);
  std::string text;
  while (input.read(text, block)) {
  }
  return parse_dump(text, file.string());
}

long long read_dump_step(const std::filesystem::path& file) {
  constexpr unsigned block = 1U << 12;
  InputFile input(file);
  std::string text;
  input.read(text, block);
  TextLines lines(text, file.string());
  Header header;
  while (!header.step) {
    const std::string_view line = next_line(lines, "'ITEM: TIMESTEP'");
    if (!starts_with(line, "ITEM: ")) {
      throw DumpError(lines.place() + "'" + std::string(line.substr(0, 40)) + "', expected 'ITEM: TIMESTEP'");
    }
    if (starts_with(line, "ITEM: ATOMS")) {
      throw DumpError(lines.place() + "'ITEM: TIMESTEP' is missing before the particles");
    }
    read_item(lines, line.substr(6), header);
  }
  return *header.step;
}

}  // namespace millfoam::averaging
