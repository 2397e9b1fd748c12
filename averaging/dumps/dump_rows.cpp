// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/dump_rows.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "averaging/dumps/bounding_radius.hpp"
#include "averaging/dumps/dump_error.hpp"
#include "averaging/dumps/quick_number.hpp"
#include "averaging/dumps/unique_ids.hpp"
#include "meshing/files/text_numbers.hpp"

namespace millfoam::averaging {

namespace {

/// m/s. A ball that is faster is not one of a mill: its square and those of sums must stay numbers.
constexpr double largest_velocity = 1e6;

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

const char* pass_blanks(const char* text) {
  while (is_blank(*text)) ++text;
  return text;
}

/// Passes over a word; the text continues at least to a line end.
const char* pass_word(const char* text) {
  while (!is_blank(*text) && *text != '\n' && *text != '\r') ++text;
  return text;
}

/// Any finite number, as `as_number` reads it; null when none begins here.
const char* read_long_number(const char* word, const char* end, double& value) {
  const auto [stopped, failure] = std::from_chars(word, end, value);
  return failure == std::errc{} && std::isfinite(value) ? stopped : nullptr;
}

}  // namespace

DumpRows::DumpRows(const DumpHeader& header, TextLines& lines)
    : lines_(lines),
      columns_(find_columns(header.columns, lines.place())),
      count_(static_cast<std::size_t>(*header.count)) {
  if (columns_.scaled && !header.box) {
    refuse(lines.line(), "the positions are scaled, but 'ITEM: BOX BOUNDS' is missing before them");
  }
  if (columns_.scaled && header.box->tilted) {
    refuse(lines.line(),
           "scaled positions in a tilted (triclinic) box cannot be read: dump 'x y z' instead of 'xs ys zs'");
  }
  // Positions that are not scaled go through the same arithmetic, in a box that changes nothing.
  box_.upper = {1, 1, 1};
  if (columns_.scaled) box_ = *header.box;
}

void DumpRows::read(ParticleRecord& record) {
  const std::size_t first_line = lines_.line() + 1;
  while (true) {
    read_quick_rows(record);
    if (record.particles.size() == count_) break;
    const std::optional<std::string_view> line = lines_.next();
    if (!line) {
      throw truncated(lines_, "particle " + std::to_string(record.particles.size() + 1) + " of " +
                                  std::to_string(count_));
    }
    read_carefully(*line);
    append(lines_.line(), record);
  }
  if (const auto twins = find_duplicates(record.particles)) {
    refuse(first_line + twins->second, "particle " + std::to_string(record.particles[twins->first].id) +
                                           " appears twice, also on line " +
                                           std::to_string(first_line + twins->first));
  }
}

void DumpRows::read_quick_rows(ParticleRecord& record) {
  const std::string_view text = lines_.whole_lines();
  const char* const end = text.data() + text.size();
  const char* place = text.data();
  std::size_t rows = 0;
  while (record.particles.size() < count_ && place < end) {
    const char* const next = read_quickly(place, end);
    if (next == nullptr) break;
    place = next;
    append(lines_.line() + ++rows, record);
  }
  lines_.skip(static_cast<std::size_t>(place - text.data()), rows);
}

const char* DumpRows::read_quickly(const char* text, const char* end) {
  for (const int quantity : columns_.quantity) {
    text = pass_blanks(text);
    const char* const word = text;
    if (quantity < 0) {
      text = pass_word(word);
      if (text == word) return nullptr;
    } else if (quantity == quantity_id) {
      text = QuickNumber::read(word, end, row_.id);
    } else {
      double& value = row_.values[static_cast<std::size_t>(quantity)];
      text = QuickNumber::read(word, end, value);
      if (text == nullptr) text = read_long_number(word, end, value);
    }
    if (text == nullptr || !(is_blank(*text) || *text == '\n' || *text == '\r')) return nullptr;
  }
  text = pass_blanks(text);
  if (*text == '\r') ++text;
  return *text == '\n' ? text + 1 : nullptr;
}

void DumpRows::read_carefully(std::string_view line) {
  std::size_t words = 0;
  for (const int quantity : columns_.quantity) {
    const std::string_view word = take_word(line);
    if (word.empty()) {
      refuse(lines_.line(), "this row has " + std::to_string(words) + " values, expected " +
                                std::to_string(columns_.quantity.size()));
    }
    ++words;
    if (quantity == quantity_id) {
      const auto id = as_number<long long>(word);
      if (!id) refuse(lines_.line(), "column 'id' is '" + std::string(word) + "', expected a whole number");
      row_.id = *id;
    } else if (quantity > 0) {
      const auto place = static_cast<std::size_t>(quantity);
      row_.values[place] = column_value(word, place);
    }
  }
  if (!take_word(line).empty()) {
    refuse(lines_.line(), "this row has more values, expected " + std::to_string(words));
  }
}

double DumpRows::column_value(std::string_view word, std::size_t quantity) const {
  const auto value = as_number<double>(word);
  if (!value || !std::isfinite(*value)) {
    refuse(lines_.line(), "column '" + columns_.name[quantity] + "' is '" + std::string(word) +
                              "', expected a finite number");
  }
  return *value;
}

void DumpRows::append(std::size_t line, ParticleRecord& record) const {
  const auto& values = row_.values;
  Particle particle;
  particle.id = row_.id;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double position = values[quantity_position + axis];
    particle.position[axis] =
        columns_.scaled ? box_.lower[axis] + position * (box_.upper[axis] - box_.lower[axis]) : position;
    particle.velocity[axis] = values[quantity_velocity + axis];
    if (std::abs(particle.velocity[axis]) > largest_velocity) {
      refuse(line, "column '" + columns_.name[quantity_velocity + axis] + "' is " +
                       exact(particle.velocity[axis]) + ", expected a velocity of at most " +
                       exact(largest_velocity) + " m/s");
    }
    if (!std::isfinite(particle.position[axis])) {
      refuse(line, "column '" + columns_.name[quantity_position + axis] + "' is " + exact(position) +
                       ", too large for the box");
    }
  }
  particle.radius = values[quantity_radius];
  if (columns_.shapes) {
    record.shapes.push_back(shape(line));
    particle.radius = bounding_radius(record.shapes.back());
  }
  if (!(particle.radius > 0 && std::isfinite(particle.radius))) {
    refuse(line, "radius is " + exact(particle.radius) + ", expected a positive length in m");
  }
  record.particles.push_back(particle);
}

Superquadric DumpRows::shape(std::size_t line) const {
  const auto& values = row_.values;
  const auto require_least = [&](std::size_t quantity, bool fine, const char* expected) {
    if (!fine) {
      refuse(line, "column '" + columns_.name[quantity] + "' is " + exact(values[quantity]) + ", expected " +
                       expected);
    }
    return values[quantity];
  };
  Superquadric shape;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t quantity = quantity_half_axes + axis;
    shape.half_axes[axis] = require_least(quantity, values[quantity] > 0, "a positive half axis in m");
  }
  for (std::size_t n = 0; n < 2 && !columns_.name[quantity_blockiness].empty(); ++n) {
    const std::size_t quantity = quantity_blockiness + n;
    shape.blockiness[n] = require_least(quantity, values[quantity] >= 2, "2 or more: a convex particle");
  }
  std::copy_n(values.begin() + quantity_quaternion, 4, shape.quaternion.begin());
  const auto& [w, x, y, z] = shape.quaternion;
  const double norm = std::hypot(std::hypot(w, x), std::hypot(y, z));
  // What LIGGGHTS writes is of length 1 to its printed digits; anything far from it is not a rotation.
  if (!(norm > 0.5 && norm < 2)) {
    refuse(line, "the quaternion 'quat1 quat2 quat3 quat4' has the length " + exact(norm) + ", expected 1");
  }
  for (double& component : shape.quaternion) component /= norm;
  return shape;
}

void DumpRows::refuse(std::size_t line, const std::string& reason) const {
  throw DumpError(lines_.place(line) + reason);
}

ParticleRecord read_record(TextLines& lines, std::size_t bytes) {
  constexpr std::size_t shortest_row = 16;
  const DumpHeader header = read_header(lines);
  ParticleRecord record;
  record.step = *header.step;
  record.particles.reserve(std::min(static_cast<std::size_t>(*header.count), bytes / shortest_row + 1));
  DumpRows(header, lines).read(record);
  if (!lines.at_end()) {
    const bool second = lines.peek().substr(0, 5) == "ITEM:";
    throw DumpError(lines.place(lines.line() + 1) +
                    (second ? "a second record begins, expected one record in a file"
                            : "more rows than the header's " + std::to_string(*header.count)));
  }
  return record;
}

}  // namespace millfoam::averaging
