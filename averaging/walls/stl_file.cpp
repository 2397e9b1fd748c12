// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/walls/stl_file.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>

#include "averaging/dumps/text_lines.hpp"
#include "averaging/walls/surface.hpp"

namespace millfoam::averaging {

namespace {

constexpr std::size_t binary_header = 84;
constexpr std::size_t binary_triangle = 50;

std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream input(file, std::ios::binary);
  if (!input) throw SurfaceError(file.string() + ": cannot open this file");
  std::string bytes{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  if (input.bad()) throw SurfaceError(file.string() + ": cannot be read to its end");
  return bytes;
}

template <typename Value>
Value value_at(const std::string& bytes, std::size_t place) {
  Value value{};
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

std::size_t binary_count(const std::string& bytes) {
  return bytes.size() < binary_header ? 0 : value_at<std::uint32_t>(bytes, binary_header - 4);
}

/// A binary file may begin with "solid" too; its length tells, or a zero, which no text holds.
bool is_binary(const std::string& bytes) {
  if (bytes.size() == binary_header + binary_triangle * binary_count(bytes)) return true;
  return bytes.find('\0') != std::string::npos;
}

std::vector<StlTriangle> read_binary(const std::string& bytes, const std::string& name) {
  const std::size_t count = binary_count(bytes), expected = binary_header + binary_triangle * count;
  if (bytes.size() != expected) {
    const std::string what = bytes.size() < binary_header
                                 ? "the header of a binary STL"
                                 : "the " + std::to_string(count) + " triangles announced in its header";
    throw SurfaceError(name + (bytes.size() < expected ? ": is cut short" : ": is too long") +
                       ": there are " + std::to_string(bytes.size()) + " bytes, expected " +
                       std::to_string(expected) + " for " + what);
  }
  std::vector<StlTriangle> triangles(count);
  std::size_t place = binary_header;
  for (StlTriangle& triangle : triangles) {
    place += 12;  // the normal
    for (Eigen::Vector3d& corner : triangle) {
      for (double& coordinate : corner) {
        coordinate = static_cast<double>(value_at<float>(bytes, place));
        if (!std::isfinite(coordinate)) {
          throw SurfaceError(name + ": the coordinate at byte " + std::to_string(place) +
                             " is not finite, expected a length in m");
        }
        place += 4;
      }
    }
    place += 2;  // the attribute
  }
  return triangles;
}

/// ASCII: "solid NAME", then of each triangle "facet normal X Y Z", "outer loop", three times
/// "vertex X Y Z", "endloop", "endfacet", and "endsolid NAME".
class AsciiStl {
 public:
  AsciiStl(const std::string& text, const std::string& name) : lines_(std::string_view(text), name) {}

  std::vector<StlTriangle> read() {
    while (next_line()) {
      if (keyword_ != "solid") refuse("'solid'");
      read_solid();
    }
    return std::move(triangles_);
  }

 private:
  /// Goes to the next line that is not blank and takes its first word; false at the end.
  bool next_line() {
    for (auto line = lines_.next(); line; line = lines_.next()) {
      line_ = *line;
      rest_ = *line;
      keyword_ = take_word(rest_);
      if (!keyword_.empty()) return true;
    }
    return false;
  }

  void expect(std::string_view keyword, const char* what) {
    if (!next_line()) {
      throw SurfaceError(lines_.place() + "the text ends here, expected " + what + "; the file is cut");
    }
    if (keyword_ != keyword) refuse(what);
  }

  void read_solid() {
    while (true) {
      if (!next_line()) {
        throw SurfaceError(lines_.place() + "the text ends here, expected 'endsolid'; the file is cut");
      }
      if (keyword_ == "endsolid") return;
      if (keyword_ != "facet") refuse("'facet' or 'endsolid'");
      expect("outer", "'outer loop'");
      StlTriangle& triangle = triangles_.emplace_back();
      for (Eigen::Vector3d& corner : triangle) {
        expect("vertex", "'vertex X Y Z'");
        for (double& coordinate : corner) coordinate = read_coordinate();
        if (!take_word(rest_).empty()) refuse("'vertex X Y Z'");
      }
      expect("endloop", "'endloop'");
      expect("endfacet", "'endfacet'");
    }
  }

  double read_coordinate() {
    std::string_view word = take_word(rest_);
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    const std::optional<double> value = as_number<double>(word);
    if (!value || !std::isfinite(*value)) refuse("'vertex X Y Z' of finite lengths in m");
    return *value;
  }

  [[noreturn]] void refuse(const char* expected) const {
    throw SurfaceError(lines_.place() + "'" + std::string(line_.substr(0, 60)) + "', expected " + expected +
                       " of an ASCII STL");
  }

  TextLines lines_;
  std::string_view line_;
  std::string_view rest_;
  std::string_view keyword_;
  std::vector<StlTriangle> triangles_;
};

}  // namespace

std::vector<StlTriangle> read_stl(const std::filesystem::path& file) {
  std::string bytes = read_bytes(file);
  const auto read = [&] {
    if (is_binary(bytes)) return read_binary(bytes, file.string());
    if (!bytes.empty() && bytes.back() != '\n') bytes += '\n';
    return AsciiStl(bytes, file.string()).read();
  };
  std::vector<StlTriangle> triangles = read();
  if (triangles.empty()) throw SurfaceError(file.string() + ": no triangle, expected an STL file of a wall");
  return triangles;
}

}  // namespace millfoam::averaging
