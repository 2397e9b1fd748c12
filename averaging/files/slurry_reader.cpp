// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/slurry_reader.hpp"

#include <cmath>
#include <functional>
#include <sstream>
#include <variant>

#include "averaging/files/grid_io.hpp"
#include "averaging/files/hdf5_file.hpp"
#include "averaging/files/hdf5_io.hpp"
#include "averaging/files/slurry_file.hpp"

namespace millfoam::averaging {

namespace {

constexpr int version_with_balls = 2;
constexpr const char* again = "run the flow again";

/// Throws unless the file is a complete slurry.h5 with forces on balls.
void check_file(hid_t root) {
  const std::string format = hdf5::read_text_attribute(root, "format");
  if (format == "millfoam-slurry" && hdf5::read_int_attribute(root, "version", 1)[0] == 1)
    throw hdf5::Error(std::string("is of version 1, which has no forces on balls (group /balls), expected "
                                  "version 2: ") +
                      again);
  hdf5::check_format(root, "millfoam-slurry", {version_with_balls}, again);
  if (!hdf5::has(root, "balls"))
    throw hdf5::Error(
        "has no forces on balls (group /balls), because its flow had no balls; expected a flow "
        "with flow.balls in slurryFoam");
}

BallFieldsHeader read_header(hid_t root) {
  const hdf5::Handle balls = hdf5::open_group(root, "balls");
  BallFieldsHeader header;
  if (hdf5::has_attribute(root, "mill_flow")) header.mill_flow = hdf5::read_text_attribute(root, "mill_flow");
  header.polydispersity = hdf5::read_int_attribute(balls.get(), "polydispersity", 1)[0] != 0;
  // forces.h5 of a coupled mill has the mean alone
  if (hdf5::has(root, "window"))
    header.windows = static_cast<std::size_t>(hdf5::dimensions(root, "window/begin").at(0));
  return header;
}

std::string triple(double x, double y, double z) {
  std::ostringstream text;
  text << '(' << x << ", " << y << ", " << z << ')';
  return text.str();
}

/// Throws where a field has a value that is not finite in a voxel with fluid, or not one for each voxel.
void check_field(const std::vector<double>& values, const std::string& name, std::size_t width,
                 const std::vector<double>& inside, const BoxGrid& grid) {
  if (values.size() != width * grid.size())
    throw hdf5::Error("'" + name + "' has " + std::to_string(values.size()) + " numbers, expected " +
                      std::to_string(width * grid.size()) + ": " + again);
  if (const auto voxel = not_finite(values, width, inside))
    throw hdf5::Error("'" + name + "' is not finite in " + voxel_in_words(grid, *voxel) +
                      "; expected a number: " + again);
}

}  // namespace

struct SlurryReader::File {
  std::filesystem::path path;
  hdf5::Handle handle;
  BoxGrid grid;
  BallFieldsHeader header;
  std::vector<double> begin, end;  ///< of the windows, DEM time, s

  explicit File(const std::filesystem::path& place)
      : path(place),
        handle(hdf5::open_file(place, "slurryFoam")),
        grid(read_box(handle.get())),
        header(read_header(handle.get())) {
    if (header.windows == 0) return;
    begin = hdf5::read_all(handle.get(), "window/begin");
    end = hdf5::read_all(handle.get(), "window/end");
  }

  static BoxGrid read_box(hid_t root) {
    check_file(root);
    const hdf5::Handle group = hdf5::open_group(root, "grid");
    return std::get<BoxGrid>(hdf5::read_grid(group.get()));
  }

  /// All fields; `read` gives the values of a data set that is in the file under `inside_at` or in `balls`.
  void read_fields(const std::string& inside_at, const std::string& balls,
                   const std::function<std::vector<double>(const std::string&)>& read,
                   BallFields& fields) const {
    fields.inside = read(inside_at);
    check_field(fields.inside, inside_at, 1, std::vector<double>(grid.size(), 1.0), grid);
    const auto take = [&](const char* name, std::size_t width) {
      std::vector<double> values = read(balls + name);
      check_field(values, balls + name, width, fields.inside, grid);
      return values;
    };
    fields.pressure_force = take("pressure_force", 3);
    fields.exchange = take("exchange", 1);
    fields.drag_force = take("drag_force", 3);
    fields.solidity = take("solidity", 1);
    fields.diameter = take("diameter", 1);
  }
};

std::optional<std::size_t> not_finite(const std::vector<double>& values, std::size_t width,
                                      const std::vector<double>& inside) {
  for (std::size_t at = 0; at < values.size(); ++at)
    if (!std::isfinite(values[at]) && inside[at / width] != 0) return at / width;
  return std::nullopt;
}

std::string voxel_in_words(const BoxGrid& grid, std::size_t voxel) {
  const auto [nx, ny, nz] = grid.shape();
  const auto row = static_cast<int>(voxel / static_cast<std::size_t>(nx));
  const VoxelIndex index{static_cast<int>(voxel % static_cast<std::size_t>(nx)), row % ny, row / ny};
  const Vector3 centre = grid.centre(index);
  return "voxel x y z = " + triple(index[0], index[1], index[2]) + ", whose centre is " +
         triple(centre[0], centre[1], centre[2]) + " m";
}

SlurryReader::SlurryReader(const std::filesystem::path& path)
    : file_(hdf5::naming_file<SlurryFileError>(path, [&] { return std::make_unique<File>(path); })) {}

SlurryReader::~SlurryReader() = default;

SlurryReader::SlurryReader(SlurryReader&&) noexcept = default;

const BoxGrid& SlurryReader::grid() const {
  return file_->grid;
}

const BallFieldsHeader& SlurryReader::header() const {
  return file_->header;
}

const std::filesystem::path& SlurryReader::path() const {
  return file_->path;
}

std::array<double, 2> SlurryReader::span() const {
  return {file_->begin.front(), file_->end.back()};
}

double SlurryReader::middle(std::size_t window) const {
  return (file_->begin.at(window) + file_->end.at(window)) / 2;
}

BallFields SlurryReader::mean() const {
  return hdf5::naming_file<SlurryFileError>(file_->path, [&] {
    const hid_t root = file_->handle.get();
    if (!hdf5::has(root, "mean") || !hdf5::has(root, "mean/balls"))
      throw hdf5::Error(std::string("has no mean over the run (group /mean/balls), because the flow ended "
                                    "before flow.averages.start: ") +
                        again);
    BallFields fields;
    file_->read_fields(
        "mean/insideFraction", "mean/balls/",
        [&](const std::string& name) { return hdf5::read_all(root, name); }, fields);
    return fields;
  });
}

BallFields SlurryReader::window(std::size_t number) const {
  return hdf5::naming_file<SlurryFileError>(file_->path, [&] {
    BallFields fields;
    file_->read_fields(
        "grid/insideFraction", "balls/",
        [&](const std::string& name) { return hdf5::read_row(file_->handle.get(), name, number); }, fields);
    return fields;
  });
}

std::optional<double> slurry_begin(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) return std::nullopt;
  try {
    return hdf5::naming_file<SlurryFileError>(path, [&]() -> std::optional<double> {
      const hdf5::Handle file = hdf5::open_file(path);
      if (hdf5::read_int_attribute(file.get(), "complete", 1)[0] != 1) return std::nullopt;
      const hdf5::Handle windows = hdf5::open_group(file.get(), "window");
      const std::vector<double> begins = hdf5::read_all(windows.get(), "begin");
      if (begins.empty()) return std::nullopt;
      return begins.front() - hdf5::read_double_attribute(file.get(), "time0", 1)[0];
    });
  } catch (const SlurryFileError&) {
    return std::nullopt;
  }
}

}  // namespace millfoam::averaging
