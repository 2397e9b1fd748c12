// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/dump_header.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace millfoam::averaging {

namespace {

constexpr std::string_view item = "ITEM: ";
constexpr std::string_view atoms = "ATOMS ";
constexpr std::string_view bounds = "BOX BOUNDS";

bool starts_with(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

/// The beginning of a line, for a message.
std::string quoted(std::string_view line) {
  return "'" + std::string(line.substr(0, 60)) + "'";
}

std::string_view next_line(TextLines& lines, const char* expected) {
  const std::optional<std::string_view> line = lines.next();
  if (!line) throw truncated(lines, expected);
  return *line;
}

/// What follows "ITEM: " on the next line.
std::string_view next_title(TextLines& lines, const char* expected) {
  const std::string_view line = next_line(lines, expected);
  if (!starts_with(line, item)) {
    throw DumpError(lines.place() + quoted(line) + ", expected a line that begins with 'ITEM: '");
  }
  return line.substr(item.size());
}

template <typename Value>
void require_once(const TextLines& lines, const std::optional<Value>& value, const char* title) {
  if (value) throw DumpError(lines.place() + "'ITEM: " + title + "' appears twice before the particles");
}

long long next_count(TextLines& lines, const char* what) {
  const std::string_view line = next_line(lines, what);
  std::string_view rest = line;
  const auto value = as_number<long long>(take_word(rest));
  if (!value || *value < 0 || !take_word(rest).empty()) {
    throw DumpError(lines.place() + what + " is " + quoted(line) + ", expected a whole number, not negative");
  }
  return *value;
}

/// Whether a word has a letter of LIGGGHTS' command boundary for each of two ends.
bool is_flag(std::string_view word) {
  return word.size() == 2 && word.find_first_not_of("pfsm") == std::string_view::npos;
}

/// @param flags  what follows the item's name: for each axis those of its two ends, behind the names of tilts
DumpBox read_box(TextLines& lines, std::string_view flags) {
  DumpBox box;
  std::vector<std::string_view> words;
  for (std::string_view word = take_word(flags); !word.empty(); word = take_word(flags))
    words.push_back(word);
  const bool has_flags = words.size() >= 3 && std::all_of(words.end() - 3, words.end(), is_flag);
  for (std::size_t axis = 0; axis < 3 && has_flags; ++axis) box.flags[axis] = words[words.size() - 3 + axis];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string_view line = next_line(lines, "the bounds of the box along x, y and z");
    std::string_view rest = line;
    const auto lower = as_number<double>(take_word(rest));
    const auto upper = as_number<double>(take_word(rest));
    if (!lower || !upper || !std::isfinite(*lower) || !std::isfinite(*upper)) {
      throw DumpError(lines.place() + "box bounds are " + quoted(line) + ", expected two numbers");
    }
    box.lower[axis] = *lower;
    box.upper[axis] = *upper;
    box.tilted = box.tilted || !take_word(rest).empty();
  }
  return box;
}

/// LAMMPS writes the units on request (`dump_modify units yes`).
void require_si(TextLines& lines) {
  const std::string_view line = next_line(lines, "the units");
  std::string_view rest = line;
  if (take_word(rest) != "si" || !take_word(rest).empty()) {
    throw DumpError(lines.place() + "the units are " + quoted(line) + ", expected si (m, s)");
  }
}

/// Reads an item other than the particles. `title` is what follows "ITEM: ".
void read_item(TextLines& lines, std::string_view title, DumpHeader& header) {
  if (title == "TIMESTEP") {
    require_once(lines, header.step, "TIMESTEP");
    header.step = next_count(lines, "the time-step");
  } else if (title == "NUMBER OF ATOMS") {
    require_once(lines, header.count, "NUMBER OF ATOMS");
    header.count = next_count(lines, "the number of atoms");
  } else if (starts_with(title, bounds)) {
    // The bounds are read into the same text
    const std::string flags(title.substr(bounds.size()));
    require_once(lines, header.box, "BOX BOUNDS");
    header.box = read_box(lines, flags);
  } else if (title == "UNITS") {
    require_si(lines);
  } else {
    while (!lines.at_end() && !starts_with(lines.peek(), "ITEM:")) next_line(lines, "a whole line");
  }
}

}  // namespace

DumpError truncated(TextLines& lines, const std::string& expected) {
  return DumpError(lines.place() +
                   (lines.at_end() ? "the text ends here" : "the text ends within this line") +
                   ", expected " + expected + "; the dump is truncated");
}

DumpHeader read_header(TextLines& lines) {
  DumpHeader header;
  while (true) {
    const std::string_view title = next_title(lines, "'ITEM: ATOMS' and the particles");
    if (!starts_with(title, atoms)) {
      read_item(lines, title, header);
      continue;
    }
    const char* const missing = !header.step ? "TIMESTEP" : !header.count ? "NUMBER OF ATOMS" : nullptr;
    if (missing != nullptr) {
      throw DumpError(lines.place() + "'ITEM: " + missing + "' is missing before the particles");
    }
    header.columns = title.substr(atoms.size());
    return header;
  }
}

long long read_step(TextLines& lines) {
  DumpHeader header;
  while (!header.step) {
    const std::string_view title = next_title(lines, "'ITEM: TIMESTEP'");
    if (starts_with(title, atoms)) {
      throw DumpError(lines.place() + "'ITEM: TIMESTEP' is missing before the particles");
    }
    read_item(lines, title, header);
  }
  return *header.step;
}

std::optional<long long> read_count(TextLines& lines) {
  DumpHeader header;
  try {
    while (!header.count) {
      const std::string_view title = next_title(lines, "'ITEM: NUMBER OF ATOMS'");
      if (starts_with(title, atoms)) break;
      read_item(lines, title, header);
    }
  } catch (const DumpError&) {
    // Who reads the record refuses it
    return std::nullopt;
  }
  return header.count;
}

}  // namespace millfoam::averaging
