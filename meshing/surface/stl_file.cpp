// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/surface/stl_file.hpp"

#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "meshing/files/text_numbers.hpp"

namespace millfoam::meshing {
namespace {

constexpr std::size_t header_size = 84;  // 80 characters and the number of triangles
constexpr std::size_t triangle_size = 50;

/// First words of lines that say nothing more.
const std::set<std::string> structural_words{"", "solid", "endsolid", "outer", "endloop", "endfacet"};

/// A number of a binary file, which STL defines as little-endian, like the machines that OpenFOAM runs on.
template <typename Number>
Number number_at(const std::string& bytes, std::size_t offset) {
  Number number;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

bool is_binary(const std::string& bytes) {
  return bytes.size() >= header_size &&
         bytes.size() == header_size + triangle_size * number_at<std::uint32_t>(bytes, header_size - 4);
}

std::string in_small_letters(std::string word) {
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

/// As text begins; blank files have no triangles in either form.
bool begins_with_solid(const std::string& bytes) {
  const auto begin = bytes.find_first_not_of(" \t\r\n");
  return begin == std::string::npos || in_small_letters(bytes.substr(begin, 5)) == "solid";
}

class Reader {
 public:
  Reader(std::string file, const std::string& group, double scale, PolygonSet& set)
      : file_(std::move(file)), group_(group_index(set, group)), scale_(scale), set_(set) {}

  void read_binary(const std::string& bytes) {
    for (std::size_t at = header_size; at < bytes.size(); at += triangle_size) {
      begin_triangle(0);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        Eigen::Vector3d point;
        for (std::size_t axis = 0; axis < 3; ++axis)
          point[static_cast<int>(axis)] = number_at<float>(bytes, at + 12 + 12 * corner + 4 * axis);
        if (!point.allFinite())
          refuse(": triangle " + std::to_string(count_), "a coordinate that is not finite");
        add_corner(point);
      }
    }
  }

  void read_text(const std::string& text) {
    std::istringstream lines(text);
    int number = 0;
    std::size_t corners = 3;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      const std::string at = ':' + std::to_string(number);
      std::istringstream words(line);
      std::string keyword;
      words >> keyword;
      const std::string as_written = keyword;
      keyword = in_small_letters(keyword);
      if (keyword == "facet") {
        if (corners != 3)
          refuse(at, "the facet before this has " + std::to_string(corners) +
                         (corners == 1 ? " corner" : " corners") + ": expected 3");
        begin_triangle(number);
        corners = 0;
      } else if (keyword == "vertex") {
        if (++corners > 3) refuse(at, "a fourth corner of a facet: expected 3");
        add_corner(read_corner(words, at));
      } else if (structural_words.count(keyword) == 0) {
        refuse(at, "'" + as_written + "': expected the text of an STL file");
      }
    }
    if (corners != 3) refuse(':' + std::to_string(number), "the file ends within a facet");
  }

  int count() const { return count_; }

  [[noreturn]] void refuse(const std::string& at, const std::string& what) const {
    throw PolygonError(file_ + at + ": " + what);
  }

 private:
  void begin_triangle(int line) {
    ++count_;
    set_.polygons.push_back({{}, group_, line, count_});
  }

  Eigen::Vector3d read_corner(std::istringstream& words, const std::string& at) const {
    Eigen::Vector3d point;
    for (double& x : point) {
      std::string word;
      words >> word;
      const auto number = to_number(word);
      if (!number) refuse(at, "'" + word + "': expected three coordinates, finite numbers");
      x = *number;
    }
    return point;
  }

  void add_corner(const Eigen::Vector3d& point) {
    set_.polygons.back().points.push_back(static_cast<int>(set_.points.size()));
    set_.points.push_back(scale_ * point);
  }

  std::string file_;
  int group_;
  double scale_;
  PolygonSet& set_;
  int count_ = 0;
};

}  // namespace

void read_stl(const std::filesystem::path& file, const std::string& group, double scale, PolygonSet& set) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  Reader reader(file.string(), group, scale, set);
  if (!stream.is_open() || stream.bad()) reader.refuse("", "cannot be read");
  if (is_binary(bytes)) {
    reader.read_binary(bytes);
  } else if (bytes.find('\0') < header_size) {
    // No text holds a zero; the number of triangles in a binary header does, below 16 millions
    const std::string there = ": there are " + std::to_string(bytes.size()) + " bytes, expected ";
    if (bytes.size() < header_size)
      reader.refuse("", "is cut short" + there + "at least the 84 of a binary STL's header");
    const std::size_t triangles = number_at<std::uint32_t>(bytes, header_size - 4);
    const std::size_t needed = header_size + triangle_size * triangles;
    reader.refuse("", (bytes.size() < needed ? "is cut short" : "is too long") + there +
                          std::to_string(needed) + " for the " + std::to_string(triangles) +
                          " triangles announced in its header");
  } else if (begins_with_solid(bytes)) {
    reader.read_text(bytes);
  } else {
    reader.refuse("", "is no STL file: expected 'solid', or a binary file with a header of 84 bytes");
  }
  if (reader.count() == 0) reader.refuse("", "has no triangles");
}

}  // namespace millfoam::meshing
