// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/polygons/obj_file.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "meshing/files/output_file.hpp"
#include "meshing/files/text_numbers.hpp"

namespace millfoam::meshing {
namespace {

/// What a hand-made file may hold besides points, faces and groups.
const std::set<std::string> passed_over{
    "vn", "vt", "vp", "o",   "s",          "usemtl", "mtllib",   "usemap",   "maplib",
    "l",  "p",  "mg", "lod", "shadow_obj", "bevel",  "c_interp", "d_interp", "trace_obj"};

/// Second word of a group whose patch is not a wall.
constexpr const char* open_word = "patch";

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : stream_(file) {
    set_.source = file.string();
    if (!stream_) throw PolygonError(set_.source + ": cannot be read");
  }

  PolygonSet run() && {
    std::string text;
    while (next(text)) read_line(text);
    if (set_.polygons.empty()) throw PolygonError(set_.source + ": has no faces (lines that begin with 'f')");
    return std::move(set_);
  }

 private:
  /// The next line, joined with those after it as long as they end in a backslash.
  bool next(std::string& text) {
    std::string part;
    line_ = last_line_ + 1;
    text.clear();
    while (std::getline(stream_, part)) {
      ++last_line_;
      if (!part.empty() && part.back() == '\r') part.pop_back();
      const bool goes_on = !part.empty() && part.back() == '\\';
      if (goes_on) part.back() = ' ';
      text += part;
      if (!goes_on) return true;
    }
    return !text.empty();
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw PolygonError(set_.source + ':' + std::to_string(line_) + ": " + what);
  }

  void read_line(const std::string& text) {
    std::istringstream words(text.substr(0, text.find('#')));
    std::string keyword;
    if (!(words >> keyword) || passed_over.count(keyword) > 0) return;
    if (keyword == "v") {
      read_point(words);
    } else if (keyword == "f") {
      read_face(words);
    } else if (keyword == "g") {
      std::string name, type;
      group_ = group_index(set_, words >> name ? name : default_group);
      if (words >> type && type == open_word) set_.open.insert(name);
    } else {
      refuse("'" + keyword + "': expected v, f, g or another keyword of a polygonal OBJ file");
    }
  }

  void read_point(std::istringstream& words) {
    Eigen::Vector3d point;
    for (double& x : point) {
      std::string word;
      words >> word;
      const auto number = to_number(word);
      if (!number) refuse("'" + word + "': expected three coordinates, finite numbers");
      x = *number;
    }
    set_.points.push_back(point);
  }

  void read_face(std::istringstream& words) {
    if (group_ < 0) group_ = group_index(set_, default_group);
    Polygon polygon{{}, group_, line_};
    for (std::string word; words >> word;) polygon.points.push_back(point_of(word));
    set_.polygons.push_back(std::move(polygon));
  }

  int point_of(const std::string& word) const {
    const auto count = static_cast<int>(set_.points.size());
    int index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error != std::errc() || (end != word.data() + word.size() && *end != '/'))
      refuse("'" + word + "': expected the index of a point");
    const int from_zero = index < 0 ? count + index : index - 1;
    if (from_zero < 0 || from_zero >= count)
      refuse("point " + word + ": expected an index from 1 to " + std::to_string(count) +
             ", the number of points so far");
    return from_zero;
  }

  std::ifstream stream_;
  PolygonSet set_;
  int group_ = -1;
  int line_ = 0;
  int last_line_ = 0;
};

void write_faces(std::ostream& out, const VolumeMesh& mesh, int start, int size) {
  for (int f = start; f < start + size; ++f) {
    out << 'f';
    for (int p : mesh.faces[static_cast<std::size_t>(f)]) out << ' ' << p + 1;
    out << '\n';
  }
}

}  // namespace

PolygonSet read_obj(const std::filesystem::path& file) {
  return Reader(file).run();
}

void write_obj(const VolumeMesh& mesh, const std::filesystem::path& file) {
  write_file(file, [&](std::ostream& out) {
    out << "# faces of a mesh in m: a group for each patch ('patch': no wall), and those between two cells\n";
    for (const Eigen::Vector3d& point : mesh.points) out << "v " << exact(point) << '\n';
    for (const Patch& patch : mesh.patches) {
      out << "g " << patch.name << (patch.open ? std::string(" ") + open_word : "") << '\n';
      write_faces(out, mesh, patch.start, patch.size);
    }
    out << "g " << internal_group << '\n';
    write_faces(out, mesh, 0, static_cast<int>(mesh.neighbour.size()));
  });
}

}  // namespace millfoam::meshing
