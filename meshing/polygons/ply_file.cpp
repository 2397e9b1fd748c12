// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/polygons/ply_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include "meshing/files/text_numbers.hpp"

namespace millfoam::meshing {
namespace {

enum class Format { ascii, little_endian, big_endian };
enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

const std::map<std::string, Type> type_names{
    {"char", Type::int8},      {"int8", Type::int8},       {"uchar", Type::uint8},
    {"uint8", Type::uint8},    {"short", Type::int16},     {"int16", Type::int16},
    {"ushort", Type::uint16},  {"uint16", Type::uint16},   {"int", Type::int32},
    {"int32", Type::int32},    {"uint", Type::uint32},     {"uint32", Type::uint32},
    {"float", Type::float32},  {"float32", Type::float32}, {"double", Type::float64},
    {"float64", Type::float64}};

struct Property {
  std::string name;
  Type type = Type::float32;
  bool is_list = false;
  Type count_type = Type::uint8;
};

/// Whether a property holds the points around a face.
bool names_points(const Property& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

struct Element {
  std::string name;
  long count = 0;
  std::vector<Property> properties;
};

template <typename Number>
double number_of(const char* bytes) {
  Number value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

struct Decoder {
  std::size_t size;
  double (*decode)(const char*);
};

Decoder decoder(Type type) {
  switch (type) {
    case Type::int8:
      return {1, number_of<std::int8_t>};
    case Type::uint8:
      return {1, number_of<std::uint8_t>};
    case Type::int16:
      return {2, number_of<std::int16_t>};
    case Type::uint16:
      return {2, number_of<std::uint16_t>};
    case Type::int32:
      return {4, number_of<std::int32_t>};
    case Type::uint32:
      return {4, number_of<std::uint32_t>};
    case Type::float32:
      return {4, number_of<float>};
    case Type::float64:
      return {8, number_of<double>};
  }
  return {8, number_of<double>};
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : stream_(file, std::ios::binary) {
    set_.source = file.string();
    if (!stream_) throw PolygonError(set_.source + ": cannot be read");
    size_ = static_cast<double>(std::filesystem::file_size(file));
  }

  PolygonSet run() && {
    read_header();
    for (const Element& element : elements_) {
      for (long i = 0; i < element.count; ++i) read_item(element, i);
    }
    if (set_.polygons.empty()) throw PolygonError(set_.source + ": has no faces (element 'face')");
    require_points_in_range();
    return std::move(set_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    const bool in_text = in_header_ || format_ == Format::ascii;
    throw PolygonError(set_.source + (in_text ? ':' + std::to_string(line_) : "") + ": " + item_ + what);
  }

  std::istringstream next_line(const std::string& expected) {
    std::string text;
    ++line_;
    if (!std::getline(stream_, text)) refuse("the file ends: expected " + expected);
    if (!text.empty() && text.back() == '\r') text.pop_back();
    return std::istringstream(text);
  }

  Type type_of(const std::string& name) const {
    const auto found = type_names.find(name);
    if (found == type_names.end()) refuse("type '" + name + "': expected a PLY type such as float or uchar");
    return found->second;
  }

  void read_header() {
    std::string keyword;
    if (!(next_line("'ply'") >> keyword) || keyword != "ply") refuse("expected 'ply' in the first line");
    bool has_format = false;
    while (keyword != "end_header") {
      std::istringstream words = next_line("'end_header'");
      keyword.clear();
      words >> keyword;
      if (keyword == "format") {
        read_format(words);
        has_format = true;
      } else if (keyword == "element") {
        read_element(words);
      } else if (keyword == "property") {
        read_property(words);
      }
    }
    if (!has_format) refuse("the header has no 'format'");
    for (const Element& element : elements_) {
      const bool lists_points =
          std::any_of(element.properties.begin(), element.properties.end(), names_points);
      if (element.name == "face" && !lists_points)
        refuse("the header's element 'face' has no list 'vertex_indices' or 'vertex_index'");
    }
    in_header_ = false;
  }

  void read_format(std::istringstream& words) {
    std::string name;
    words >> name;
    if (name == "ascii") {
      format_ = Format::ascii;
    } else if (name == "binary_little_endian") {
      format_ = Format::little_endian;
    } else if (name == "binary_big_endian") {
      format_ = Format::big_endian;
    } else {
      refuse("format '" + name + "': expected ascii, binary_little_endian or binary_big_endian");
    }
  }

  void read_element(std::istringstream& words) {
    Element element;
    if (!(words >> element.name >> element.count) || element.count < 0 ||
        static_cast<double>(element.count) > size_)
      refuse("expected 'element NAME COUNT' with a count that the file's size allows");
    elements_.push_back(std::move(element));
  }

  void read_property(std::istringstream& words) {
    if (elements_.empty()) refuse("a property before the first element");
    Property property;
    std::string type;
    words >> type;
    if (type == "list") {
      property.is_list = true;
      words >> type;
      property.count_type = type_of(type);
      words >> type;
    }
    property.type = type_of(type);
    if (!(words >> property.name)) refuse("a property without a name");
    elements_.back().properties.push_back(std::move(property));
  }

  double read_number(Type type, std::istringstream& words) {
    if (format_ == Format::ascii) {
      std::string word;
      words >> word;
      const auto number = to_number(word);
      if (!number) refuse("'" + word + "': expected a finite number");
      return *number;
    }
    const Decoder of_type = decoder(type);
    std::array<char, 8> bytes{};
    if (!stream_.read(bytes.data(), static_cast<std::streamsize>(of_type.size))) refuse("the file ends here");
    // The machines that OpenFOAM runs on are little-endian.
    if (format_ == Format::big_endian) std::reverse(bytes.begin(), bytes.begin() + of_type.size);
    const double number = of_type.decode(bytes.data());
    if (!std::isfinite(number)) refuse("expected a finite number, not nan or inf");
    return number;
  }

  void read_item(const Element& element, long i) {
    item_ = element.name + ' ' + std::to_string(i + 1) + ": ";
    std::istringstream words;
    if (format_ == Format::ascii) words = next_line(element.name + ' ' + std::to_string(i + 1));
    std::map<std::string, double> values;
    Polygon polygon;
    for (const Property& property : element.properties) {
      if (!property.is_list) {
        values[property.name] = read_number(property.type, words);
        continue;
      }
      const double count = read_number(property.count_type, words);
      if (!(count >= 0 && count <= size_)) refuse("a list longer than the file");
      const bool is_face = names_points(property);
      for (int k = 0; k < static_cast<int>(count); ++k) {
        const double value = read_number(property.type, words);
        if (is_face) polygon.points.push_back(to_index(value, "point", "an index"));
      }
    }
    if (element.name == "vertex") add_point(values);
    if (element.name == "face") add_face(std::move(polygon), values);
    item_.clear();
  }

  int to_index(double value, const std::string& what, const std::string& expected) const {
    if (!(value >= 0 && value < 2147483647 && value == std::floor(value)))
      refuse(what + ' ' + shown(value) + ": expected " + expected + " from 0");
    return static_cast<int>(value);
  }

  void add_point(const std::map<std::string, double>& values) {
    Eigen::Vector3d point;
    for (const auto& [axis, name] : {std::pair{0, "x"}, {1, "y"}, {2, "z"}}) {
      const auto found = values.find(name);
      if (found == values.end()) refuse(std::string("expected a property '") + name + "'");
      point[axis] = found->second;
    }
    set_.points.push_back(point);
  }

  void add_face(Polygon polygon, const std::map<std::string, double>& values) {
    const auto patch = values.find("patch");
    std::string name = default_group;
    if (patch != values.end())
      name = "patch" + std::to_string(to_index(patch->second, "patch", "a whole number"));
    polygon.group = group_index(set_, name);
    polygon.line = format_ == Format::ascii ? line_ : 0;
    set_.polygons.push_back(std::move(polygon));
  }

  void require_points_in_range() const {
    const auto count = static_cast<int>(set_.points.size());
    for (std::size_t f = 0; f < set_.polygons.size(); ++f) {
      for (int p : set_.polygons[f].points) {
        if (p >= count)
          throw PolygonError(place(set_, static_cast<int>(f)) + ": point " + std::to_string(p) +
                             ": expected an index from 0 to " + std::to_string(count - 1));
      }
    }
  }

  std::ifstream stream_;
  double size_ = 0;
  PolygonSet set_;
  std::vector<Element> elements_;
  Format format_ = Format::ascii;
  bool in_header_ = true;
  std::string item_;
  int line_ = 0;
};

}  // namespace

PolygonSet read_ply(const std::filesystem::path& file) {
  return Reader(file).run();
}

}  // namespace millfoam::meshing
