// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/wall_check.hpp"

#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>

#include "meshing/polygons/stl_polygons.hpp"

namespace millfoam::dem_driver {

namespace {

constexpr std::size_t binary_header = 84;  // 80 characters and the number of triangles

[[noreturn]] void refuse(const std::string& place, const std::string& found, const std::string& expected) {
  throw std::runtime_error(place + ": " + found + ", expected " + expected);
}

std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || !std::filesystem::is_regular_file(file))
    refuse(file.string(), "cannot be read", "an STL file of a wall");
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) refuse(file.string(), "cannot be read to its end", "an STL file of a wall");
  if (bytes.empty()) refuse(file.string(), "is empty", "an STL file of a wall");
  return bytes;
}

/// The first word, by which LIGGGHTS distinguishes text and binary files.
std::string first_word(const std::string& text) {
  const std::string blanks = " \t\r\n\f";
  const auto begin = text.find_first_not_of(blanks);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_first_of(blanks + '\0', begin) - begin);
}

void check_binary(const std::string& bytes, const std::string& name) {
  if (first_word(bytes) == "solid")
    refuse(name, "is a binary STL whose header begins with 'solid'",
           "another header, because LIGGGHTS reads such a file as text");
}

/// Of a text: the last line that is not blank, and the lines with which LIGGGHTS takes a triangle as
/// complete.
struct TextEnd {
  std::string line;
  int number = 0;  ///< of that line, from 1
  int endfacets = 0;
};

TextEnd read_end(const std::string& text) {
  TextEnd end;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::string word = first_word(line);
    if (word.empty()) continue;
    end.line = line.substr(line.find(word), 60);
    end.number = number;
    if (word == "endfacet") ++end.endfacets;
  }
  return end;
}

TextEnd check_text(const std::string& text, const std::string& name) {
  const std::string word = first_word(text);
  if (word != "solid")
    refuse(name, "begins with '" + word.substr(0, 60) + "'",
           "the word 'solid' of a text STL, or a binary STL");
  const auto zero = text.find('\0');
  if (zero != std::string::npos)
    refuse(name, "has a zero at byte " + std::to_string(zero), "nothing but text after 'solid'");
  TextEnd end = read_end(text);
  if (first_word(end.line) != "endsolid")
    refuse(name + ':' + std::to_string(end.number), "is cut short: it ends with '" + end.line + "'",
           "'endsolid' at the end of a text STL");
  return end;
}

}  // namespace

meshing::PolygonSet read_wall(const std::filesystem::path& file) {
  const std::string bytes = read_bytes(file), name = file.string();
  // No text holds a zero; the number of triangles in a binary header does, below 16 millions.
  const bool binary = bytes.find('\0') < binary_header;
  TextEnd end;
  if (!binary) end = check_text(bytes, name);
  meshing::PolygonSet wall;
  meshing::add_stl(file, meshing::default_group, 1, wall);
  if (binary) check_binary(bytes, name);
  const std::size_t triangles = wall.polygons.size();
  if (!binary && static_cast<std::size_t>(end.endfacets) != triangles)
    refuse(
        name,
        std::to_string(triangles) + " triangles and " + std::to_string(end.endfacets) + " lines 'endfacet'",
        "one such line, in small letters, for each triangle");
  return wall;
}

}  // namespace millfoam::dem_driver
