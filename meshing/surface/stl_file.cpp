// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/surface/stl_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "meshing/files/text_numbers.hpp"

namespace millfoam::surface {
namespace {

constexpr std::size_t header_size = 84;  // 80 characters and the number of triangles
constexpr std::size_t triangle_size = 50;

[[noreturn]] void refuse(const std::string& place, const std::string& what) {
  throw SurfaceError(place + ": " + what);
}

/// A number of a binary file, which STL defines as little-endian, like the machines that OpenFOAM runs on.
template <typename Number>
Number number_at(const std::string& bytes, std::size_t offset) {
  Number number;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

bool is_whole_binary(const std::string& bytes) {
  return bytes.size() >= header_size &&
         bytes.size() == header_size + triangle_size * number_at<std::uint32_t>(bytes, header_size - 4);
}

/// What is wrong with a binary file of another length.
[[noreturn]] void refuse_length(const std::string& bytes, const std::string& file) {
  const std::string there = ": there are " + std::to_string(bytes.size()) + " bytes, expected ";
  if (bytes.size() < header_size)
    refuse(file, "is cut short" + there + "at least the 84 of a binary STL's header");
  const std::size_t triangles = number_at<std::uint32_t>(bytes, header_size - 4);
  const std::size_t needed = header_size + triangle_size * triangles;
  refuse(file, (bytes.size() < needed ? "is cut short" : "is too long") + there + std::to_string(needed) +
                   " for the " + std::to_string(triangles) + " triangles announced in its header");
}

std::vector<StlTriangle> read_binary(const std::string& bytes, const std::string& file) {
  std::vector<StlTriangle> triangles;
  for (std::size_t at = header_size; at < bytes.size(); at += triangle_size) {
    StlTriangle& triangle = triangles.emplace_back();
    std::size_t place = at + 12;  // behind the normal
    for (Eigen::Vector3d& corner : triangle.corners) {
      for (double& x : corner) {
        x = static_cast<double>(number_at<float>(bytes, place));
        place += sizeof(float);
      }
      if (!corner.allFinite())
        refuse(file + ": triangle " + std::to_string(triangles.size()), "a coordinate that is not finite");
    }
  }
  return triangles;
}

bool is_blank(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0;
}

/// Takes the next word off the front of a line; empty when there is none.
std::string_view take_word(std::string_view& line) {
  const auto begin = std::find_if_not(line.begin(), line.end(), is_blank);
  const auto end = std::find_if(begin, line.end(), is_blank);
  const auto before = static_cast<std::size_t>(begin - line.begin());
  const auto length = static_cast<std::size_t>(end - begin);
  const std::string_view word = line.substr(before, length);
  line.remove_prefix(before + length);
  return word;
}

std::string in_small_letters(std::string_view word) {
  std::string small(word);
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return small;
}

/// Text: "solid NAME", then the facets, and "endsolid NAME"; any number of solids.
class TextReader {
 public:
  TextReader(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  std::vector<StlTriangle> read() && {
    while (next_line()) {
      if (in_solid_) {
        take_line_of_solid();
      } else {
        require("solid", "'solid', or a binary file with a header of 84 bytes");
        in_solid_ = true;
      }
    }
    if (step_ > 0) refuse_here("the file ends within a facet");
    if (in_solid_) refuse_here("is cut short: the text ends here, expected 'endsolid'");
    return std::move(triangles_);
  }

 private:
  /// First words of the lines of a facet.
  static constexpr std::array<const char*, 7> facet{"facet",  "outer",   "vertex",  "vertex",
                                                    "vertex", "endloop", "endfacet"};
  static constexpr std::size_t first_corner = 2;
  static constexpr std::size_t after_corners = 5;

  /// Goes to the next line that is not blank and takes its first word; false at the end.
  bool next_line() {
    word_ = {};
    while (!text_.empty()) {
      const std::size_t end = text_.find('\n');
      rest_ = text_.substr(0, end);
      text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
      ++number_;
      word_ = take_word(rest_);
      if (!word_.empty()) break;
    }
    keyword_ = in_small_letters(word_);
    return !word_.empty();
  }

  void take_line_of_solid() {
    if (step_ == 0 && keyword_ == "endsolid") {
      in_solid_ = false;
      return;
    }
    const std::size_t corners = step_ - first_corner;
    if (keyword_ == "facet" && step_ > 0 && step_ < after_corners)
      refuse_here("the facet before this has " + std::to_string(step_ < first_corner ? 0 : corners) +
                  (corners == 1 ? " corner" : " corners") + ": expected 3");
    if (keyword_ == "vertex" && step_ == after_corners) refuse_here("a fourth corner of a facet: expected 3");
    require(facet[step_], step_ == 0 ? "'facet' or 'endsolid'" : '\'' + std::string(facet[step_]) + '\'');
    if (step_ == 0) triangles_.push_back({{}, number_});
    if (keyword_ == "vertex") triangles_.back().corners[corners] = read_corner();
    step_ = (step_ + 1) % facet.size();
  }

  Eigen::Vector3d read_corner() {
    Eigen::Vector3d corner;
    for (double& x : corner) {
      const std::string_view word = take_word(rest_);
      const auto number = to_number(word);
      if (!number) refuse_here(quoted(word) + ": expected three coordinates, finite numbers");
      x = *number;
    }
    const std::string_view more = take_word(rest_);
    if (!more.empty()) refuse_here(quoted(more) + " after three coordinates: expected the end of the line");
    return corner;
  }

  void require(std::string_view keyword, const std::string& expected) const {
    if (keyword_ != keyword) refuse_here(quoted(word_) + ": expected " + expected);
  }

  static std::string quoted(std::string_view word) { return '\'' + std::string(word.substr(0, 60)) + '\''; }

  [[noreturn]] void refuse_here(const std::string& what) const {
    refuse(file_ + ':' + std::to_string(number_), what);
  }

  std::string_view text_;  ///< what is left of it
  std::string file_;
  int number_ = 0;  ///< of the present line, from 1
  std::string_view word_;
  std::string_view rest_;  ///< of the present line
  std::string keyword_;    ///< the word in small letters
  bool in_solid_ = false;
  std::size_t step_ = 0;  ///< in `facet`
  std::vector<StlTriangle> triangles_;
};

std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse(file.string(), "cannot be opened");
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) refuse(file.string(), "cannot be read to its end");
  return bytes;
}

std::vector<StlTriangle> read_any(const std::string& bytes, const std::string& file) {
  if (is_whole_binary(bytes)) return read_binary(bytes, file);
  // No text holds a zero; the number of triangles in a binary header does, below 16 millions
  const std::size_t zero = bytes.find('\0');
  if (zero < header_size) refuse_length(bytes, file);
  if (zero != std::string::npos)
    refuse(file, "has a zero at byte " + std::to_string(zero) + ": expected a text, or a whole binary file");
  return TextReader(bytes, file).read();
}

}  // namespace

std::vector<StlTriangle> read_stl(const std::filesystem::path& file) {
  std::vector<StlTriangle> triangles = read_any(read_bytes(file), file.string());
  if (triangles.empty()) refuse(file.string(), "has no triangles");
  return triangles;
}

}  // namespace millfoam::surface
