// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/slurry_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "averaging/files/grid_io.hpp"
#include "averaging/files/hdf5_file.hpp"
#include "averaging/files/hdf5_io.hpp"
#include "averaging/files/solids_file.hpp"
#include "averaging/files/xdmf.hpp"

namespace millfoam::averaging {

namespace {

constexpr const char* slurry_format = "millfoam-slurry";
constexpr const char* segment_format = "millfoam-slurry-segment";

/// Share of a window by which segments may differ at their ends: a flow resumes from the name of a time,
/// which is rounded.
constexpr double gap = 1e-3;

/// What a field's sums are divided by. To the drag on the balls as they moved is added what their mean motion
/// took from it, so that the force on balls that move like them in the mean is that of the flow.
enum class Over { volume, slurry, balls, balls_moving };

/// A field of slurry.h5: the place of its sums in a voxel's, and what they are divided by.
struct Field {
  const char* name;
  const char* units;
  bool vector;
  std::size_t first;  ///< of the voxel's components
  Over over;
};

constexpr std::array<Field, 5> slurry_fields{{{"slurry", "1", false, 0, Over::volume},
                                              {"voidage", "1", false, 1, Over::volume},
                                              {"velocity", "m/s", true, 2, Over::slurry},
                                              {"pressure", "Pa", false, 5, Over::slurry},
                                              {"p_rgh", "Pa", false, 6, Over::slurry}}};

/// The first of the components of what balls feel: its weight w.
constexpr std::size_t weight = slurry_components;

/// Where the sums of the exchange coefficient and of the balls' velocity begin.
constexpr std::size_t exchange = weight + 5, ball_velocity = weight + 9;

constexpr std::array<Field, 7> ball_fields{
    {{"balls/solidity", "1", false, weight + 1, Over::volume},
     {"balls/pressure_force", "N/m3", true, weight + 2, Over::balls},
     {"balls/exchange", "kg/(m3 s)", false, exchange, Over::balls},
     {"balls/drag_force", "N/m3", true, weight + 6, Over::balls_moving},
     {"balls/velocity", "m/s", true, ball_velocity, Over::balls},
     {"balls/fluid_density", "kg/m3", false, weight + 12, Over::balls},
     {"balls/diameter", "m", false, weight + 13, Over::balls}}};

/// The fields of a file with or without what balls feel.
std::vector<Field> fields_of(bool balls) {
  std::vector<Field> result(slurry_fields.begin(), slurry_fields.end());
  if (balls) result.insert(result.end(), ball_fields.begin(), ball_fields.end());
  return result;
}

/// What a voxel's sums of a field are divided by, or 0 where its mean has no meaning.
double divisor(const Field& field, double volume, const double* components) {
  if (field.over == Over::balls || field.over == Over::balls_moving) return components[weight];
  // The velocity of less slurry than this has no meaning
  if (field.over == Over::slurry) return components[0] > 1e-9 * volume ? components[0] : 0;
  return volume;
}

/// A field's means over the voxels; 0 where there is nothing to divide by.
std::vector<double> means(const SlurrySegment& sums, const Field& field) {
  const std::size_t width = field.vector ? 3 : 1;
  std::vector<double> result(sums.volume.size() * width, 0.0);
  for (std::size_t voxel = 0; voxel < sums.volume.size(); ++voxel) {
    const double* components = &sums.components[voxel * sums.width];
    const double by = divisor(field, sums.volume[voxel], components);
    if (!(by > 0)) continue;
    for (std::size_t k = 0; k < width; ++k) {
      result[voxel * width + k] = components[field.first + k] / by;
      if (field.over == Over::balls_moving)
        result[voxel * width + k] += components[exchange] * components[ball_velocity + k] / (by * by);
    }
  }
  return result;
}

/// Shares of the voxels that lie in the flow's mesh, in the mean over the time.
std::vector<double> inside_fraction(const SlurrySegment& sums, const BoxGrid& grid) {
  std::vector<double> result = sums.volume;
  const double whole = grid.voxel_volume() * sums.duration;
  for (double& share : result) share /= whole;
  return result;
}

std::vector<hsize_t> row_dimensions(const BoxGrid& grid, bool vector) {
  const auto [nx, ny, nz] = grid.shape();
  std::vector<hsize_t> row{static_cast<hsize_t>(nz), static_cast<hsize_t>(ny), static_cast<hsize_t>(nx)};
  if (vector) row.push_back(3);
  return row;
}

/// Makes the group of what balls feel, for the fields in it.
void create_balls(hid_t parent, const BallsHeader& balls) {
  const hdf5::Handle group = hdf5::create_group(parent, "balls");
  hdf5::write_attribute(group.get(), "law", balls.law);
  hdf5::write_attribute(group.get(), "polydispersity", balls.polydispersity ? 1 : 0);
  hdf5::write_attribute(group.get(), "slurry_density", balls.slurry_density);
  hdf5::write_attribute(group.get(), "air_density", balls.air_density);
  hdf5::write_attribute(group.get(), "gravity",
                        std::vector<double>(balls.gravity.begin(), balls.gravity.end()));
}

/// An open slurry.h5 that grows by windows.
class Rows {
 public:
  Rows(const std::filesystem::path& part, const BoxGrid& grid, const SlurryHeader& header)
      : grid_(grid),
        balls_(header.balls),
        shown_(fields_of(header.balls.has_value())),
        file_(hdf5::create_file(part)) {
    const hid_t root = file_.get();
    hdf5::write_attribute(root, "format", std::string(slurry_format));
    hdf5::write_attribute(root, "version", slurry_version);
    hdf5::write_attribute(root, "complete", 0);
    hdf5::write_attribute(root, "time0", header.time0);
    hdf5::write_attribute(root, "window", header.window);
    for (const auto& [name, text] : {std::pair("program", header.program), {"mill_flow", header.mill_flow}})
      if (!text.empty()) hdf5::write_attribute(root, name, text);
    const hdf5::Handle grid_group = hdf5::create_group(root, "grid");
    hdf5::write_grid(grid_group.get(), grid);
    inside_.push_back(create(grid_group.get(), "insideFraction", false, "1"));
    if (balls_) create_balls(root, *balls_);
    for (const Field& field : shown_) fields_.push_back(create(root, field.name, field.vector, field.units));
    const hdf5::Handle windows = hdf5::create_group(root, "window");
    for (const char* name : {"begin", "end"}) {
      times_.push_back(hdf5::create_rows(windows.get(), name, {}, H5T_NATIVE_DOUBLE, "s"));
    }
    for (const char* name : {"samples", "starts_late", "ends_short"}) {
      times_.push_back(hdf5::create_rows(windows.get(), name, {}, H5T_NATIVE_LLONG, "1"));
    }
    const hdf5::Handle ledger = hdf5::create_group(root, "ledger");
    for (const char* name : {"volume_in", "deposited", "outside"}) {
      ledger_.push_back(hdf5::create_rows(ledger.get(), name, {}, H5T_NATIVE_DOUBLE, "m3"));
    }
  }

  void append(const SlurrySegment& sums, double time0, bool starts_late, bool ends_short) {
    for (std::size_t f = 0; f < shown_.size(); ++f) {
      hdf5::append_row(fields_[f], means(sums, shown_[f]).data());
    }
    hdf5::append_row(inside_[0], inside_fraction(sums, grid_).data());
    const double begin = time0 + sums.begin, end = time0 + sums.end;
    hdf5::append_row(times_[0], &begin);
    hdf5::append_row(times_[1], &end);
    hdf5::append_row(times_[2], sums.samples);
    hdf5::append_row(times_[3], starts_late ? 1LL : 0LL);
    hdf5::append_row(times_[4], ends_short ? 1LL : 0LL);
    double deposited = 0;
    for (std::size_t i = 0; i < sums.components.size(); i += sums.width) deposited += sums.components[i];
    const std::array<double, 3> volumes{sums.slurry / sums.duration, deposited / sums.duration,
                                        (sums.slurry - deposited) / sums.duration};
    for (std::size_t k = 0; k < volumes.size(); ++k) hdf5::append_row(ledger_[k], &volumes[k]);
    begins_.push_back(begin);
  }

  void write_mean(const SlurrySegment& sums, double time0) const {
    const hdf5::Handle group = hdf5::create_group(file_.get(), "mean");
    hdf5::write_attribute(group.get(), "begin", time0 + sums.begin);
    hdf5::write_attribute(group.get(), "end", time0 + sums.end);
    hdf5::write_attribute(group.get(), "duration", sums.duration);
    if (balls_) create_balls(group.get(), *balls_);
    for (const Field& field : shown_) {
      hdf5::write_array(group.get(), field.name, means(sums, field), row_dimensions(grid_, field.vector),
                        field.units);
    }
    hdf5::write_array(group.get(), "insideFraction", inside_fraction(sums, grid_),
                      row_dimensions(grid_, false), "1");
  }

  /// Marks the file complete and closes it.
  void finish() {
    for (auto* handles : {&fields_, &inside_, &times_, &ledger_}) handles->clear();
    hdf5::flush(file_.get());
    hdf5::overwrite_attribute(file_.get(), "complete", 1);
    file_.close("close the file");
  }

  const std::vector<double>& begins() const { return begins_; }  ///< of the windows, DEM time, s
  const std::vector<Field>& shown() const { return shown_; }     ///< the fields

 private:
  hdf5::Handle create(hid_t parent, const char* name, bool vector, const char* units) const {
    return hdf5::create_rows(parent, name, row_dimensions(grid_, vector), H5T_NATIVE_DOUBLE, units);
  }

  const BoxGrid& grid_;
  std::optional<BallsHeader> balls_;
  std::vector<Field> shown_;
  hdf5::Handle file_;
  std::vector<hdf5::Handle> fields_, inside_, times_, ledger_;
  std::vector<double> begins_;
};

/// Adds up segments to windows and to the mean over the run.
class Assembly {
 public:
  Assembly(Rows& rows, const BoxGrid& grid, const SlurryHeader& header)
      : rows_(rows), grid_(grid), header_(header), mean_(empty()), window_(empty()) {}

  void take(const std::filesystem::path& path) {
    const SlurrySegment segment = read_segment(path, grid_, header_.balls.has_value());
    const long long number = window_of(segment, header_.window, path.string());
    if (segment.begin < last_end_ - gap * header_.window) {
      throw SlurryFileError(path.string() + ": begins at " + std::to_string(segment.begin) +
                            " s, before the previous segment ends, at " + std::to_string(last_end_) + " s");
    }
    last_end_ = segment.end;
    if (filled_ && number != number_) close_window();
    number_ = number;
    filled_ = true;
    window_.add(segment);
    if (segment.begin >= header_.start - gap * header_.window) mean_.add(segment);
  }

  /// Returns whether there is a mean over the run.
  bool finish() {
    if (filled_) close_window();
    if (mean_.samples > 0) rows_.write_mean(mean_, header_.time0);
    return mean_.samples > 0;
  }

 private:
  void close_window() {
    const double begin = static_cast<double>(number_) * header_.window, margin = gap * header_.window;
    const bool hole = window_.duration < (1 - gap) * (window_.end - window_.begin);
    rows_.append(window_, header_.time0, window_.begin > begin + margin,
                 hole || window_.end < begin + header_.window - margin);
    window_ = empty();
    filled_ = false;
  }

  SlurrySegment empty() const { return SlurrySegment(grid_.size(), header_.balls.has_value()); }

  Rows& rows_;
  const BoxGrid& grid_;
  const SlurryHeader& header_;
  SlurrySegment mean_, window_;
  long long number_ = 0;
  bool filled_ = false;
  double last_end_ = -1e300;  ///< of the segments taken so far, s
};

void check_same(const BoxGrid& found, const BoxGrid& expected) {
  if (found.shape() == expected.shape() && found.lower() == expected.lower() &&
      found.upper() == expected.upper() && found.periodic() == expected.periodic()) {
    return;
  }
  throw hdf5::Error("was written for another grid; keep it elsewhere or remove it");
}

/// The components in a segment's file, checked to be those of a flow with or without balls.
std::vector<double> read_components(hid_t root, bool balls) {
  const std::size_t expected = SlurrySegment(0, balls).width;
  if (hdf5::dimensions(root, "components").back() != expected) {
    throw hdf5::Error(std::string("was written by a flow ") + (balls ? "without" : "with") +
                      " balls, expected one " + (balls ? "with" : "without") +
                      " them; keep it elsewhere or remove it");
  }
  return hdf5::read_row(root, "components", 0);
}

}  // namespace

void SlurrySegment::add(const VoxelSums& sample, double slurry_volume, double seconds) {
  for (std::size_t i = 0; i < volume.size(); ++i) volume[i] += seconds * sample.volume[i];
  for (std::size_t i = 0; i < components.size(); ++i) components[i] += seconds * sample.values[i];
  slurry += seconds * slurry_volume;
  duration += seconds;
  ++samples;
}

void SlurrySegment::add(const SlurrySegment& other) {
  begin = samples > 0 ? std::min(begin, other.begin) : other.begin;
  end = samples > 0 ? std::max(end, other.end) : other.end;
  for (std::size_t i = 0; i < volume.size(); ++i) volume[i] += other.volume[i];
  for (std::size_t i = 0; i < components.size(); ++i) components[i] += other.components[i];
  slurry += other.slurry;
  duration += other.duration;
  samples += other.samples;
}

long long window_of(const SlurrySegment& segment, double window, const std::string& name) {
  const auto number = static_cast<long long>(std::floor(segment.begin / window + gap));
  if (segment.end > (static_cast<double>(number + 1) + gap) * window) {
    throw SlurryFileError(name + ": reaches from " + std::to_string(segment.begin) + " to " +
                          std::to_string(segment.end) + " s and so lies in two windows of " +
                          std::to_string(window) + " s; expected the windows of the previous run");
  }
  return number;
}

void write_segment(const std::filesystem::path& path, const BoxGrid& grid, const SlurrySegment& segment) {
  const std::filesystem::path part = path.string() + ".part";
  hdf5::naming_file<SlurryFileError>(part, [&] {
    hdf5::Handle file = hdf5::create_file(part);
    const hid_t root = file.get();
    hdf5::write_attribute(root, "format", std::string(segment_format));
    hdf5::write_attribute(root, "version", slurry_version);
    hdf5::write_attribute(root, "complete", 1);
    hdf5::write_attribute(root, "begin", segment.begin);
    hdf5::write_attribute(root, "end", segment.end);
    hdf5::write_attribute(root, "samples", static_cast<int>(segment.samples));
    hdf5::write_attribute(root, "slurry", segment.slurry);
    hdf5::write_attribute(root, "duration", segment.duration);
    const hdf5::Handle group = hdf5::create_group(root, "grid");
    hdf5::write_grid(group.get(), grid);
    const hsize_t n = segment.volume.size();
    hdf5::append_row(hdf5::create_rows(root, "volume", {n}, H5T_NATIVE_DOUBLE, "m3 s"),
                     segment.volume.data());
    hdf5::append_row(hdf5::create_rows(root, "components", {n, segment.width}, H5T_NATIVE_DOUBLE, "SI"),
                     segment.components.data());
    file.close("close the file");
    hdf5::rename_file(part, path);
  });
}

void require_slurry_or_nothing(const std::filesystem::path& path) {
  hdf5::naming_file<SlurryFileError>(path, [&] { hdf5::require_format_or_nothing(path, slurry_format); });
}

SlurrySegment read_segment(const std::filesystem::path& path, const BoxGrid& grid, bool balls) {
  return hdf5::naming_file<SlurryFileError>(path, [&] {
    const hdf5::Handle file = hdf5::open_file(path, "the flow, from its start");
    const hid_t root = file.get();
    hdf5::check_format(
        root, segment_format, {slurry_version},
        "remove the folder of the segments and the flow's times, and run the flow from its start");
    const hdf5::Handle group = hdf5::open_group(root, "grid");
    check_same(std::get<BoxGrid>(hdf5::read_grid(group.get())), grid);
    SlurrySegment segment(0, balls);
    segment.begin = hdf5::read_double_attribute(root, "begin", 1)[0];
    segment.end = hdf5::read_double_attribute(root, "end", 1)[0];
    segment.samples = hdf5::read_int_attribute(root, "samples", 1)[0];
    segment.slurry = hdf5::read_double_attribute(root, "slurry", 1)[0];
    segment.duration = hdf5::read_double_attribute(root, "duration", 1)[0];
    segment.volume = hdf5::read_row(root, "volume", 0);
    segment.components = read_components(root, balls);
    return segment;
  });
}

bool assemble_slurry(const std::filesystem::path& path, const BoxGrid& grid, const SlurryHeader& header,
                     const std::vector<std::filesystem::path>& segments) {
  if (segments.empty()) throw SlurryFileError(path.string() + ": nothing was averaged");
  const std::filesystem::path part = path.string() + ".part";
  std::vector<double> begins;
  std::vector<XdmfField> shown;
  bool has_mean = false;
  hdf5::naming_file<SlurryFileError>(part, [&] {
    Rows rows(part, grid, header);
    Assembly assembly(rows, grid, header);
    for (const std::filesystem::path& segment : segments) assembly.take(segment);
    has_mean = assembly.finish();
    begins = rows.begins();
    for (const Field& field : rows.shown()) {
      shown.push_back({std::filesystem::path(field.name).filename(), field.name, field.vector});
    }
    rows.finish();
    hdf5::rename_file(part, path);
  });
  shown.push_back({"insideFraction", "grid/insideFraction", false});
  try {
    write_xdmf(path, "slurry", grid, begins, shown);
  } catch (const SolidsFileError& error) {
    throw SlurryFileError(error.what());
  }
  return has_mean;
}

}  // namespace millfoam::averaging
