// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/mesh_file.hpp"

#include <cmath>
#include <sstream>

#include "averaging/files/hdf5_arrays.hpp"
#include "averaging/files/hdf5_file.hpp"
#include "averaging/files/hdf5_io.hpp"

namespace millfoam::averaging {

namespace {

constexpr const char* format = "millfoam-mesh";

void check_topology(const MeshTopology& topology) {
  try {
    check(topology);
  } catch (const std::invalid_argument& error) {
    throw hdf5::Error(error.what());
  }
}

void check_finite(const MeshPoints& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    std::ostringstream message;
    message << "point " << i << " is (" << points[i].transpose() << "), expected finite coordinates";
    throw hdf5::Error(message.str());
  }
}

/// Throws unless `time` may follow the times before it.
void check_time(const std::vector<double>& times, double time) {
  if (std::isfinite(time) && (times.empty() || time > times.back())) return;
  std::ostringstream message;
  message << "time " << times.size() << " is " << time << " s, expected a finite one";
  if (!times.empty()) message << " after " << times.back() << " s";
  throw hdf5::Error(message.str());
}

void write_patches(hid_t file, const std::vector<MeshPatch>& patches) {
  std::vector<std::string> names;
  std::vector<int> first, faces;
  for (const MeshPatch& patch : patches) {
    names.push_back(patch.name);
    first.push_back(patch.first);
    faces.push_back(patch.faces);
  }
  const hdf5::Handle group = hdf5::create_group(file, "patch");
  hdf5::write_array(group.get(), "name", names);
  hdf5::write_array(group.get(), "first", first);
  hdf5::write_array(group.get(), "faces", faces);
}

std::vector<MeshPatch> read_patches(hid_t file) {
  const hdf5::Handle group = hdf5::open_group(file, "patch");
  const auto names = hdf5::read_texts(group.get(), "name");
  const auto first = hdf5::read_ints(group.get(), "first");
  const auto faces = hdf5::read_ints(group.get(), "faces");
  if (first.size() != names.size() || faces.size() != names.size()) {
    throw hdf5::Error("/patch/name, /patch/first and /patch/faces differ in length");
  }
  std::vector<MeshPatch> patches;
  for (std::size_t i = 0; i < names.size(); ++i) patches.push_back({names[i], first[i], faces[i]});
  return patches;
}

std::size_t read_point_count(hid_t file, std::size_t times) {
  const std::vector<hsize_t> shape = hdf5::dimensions(file, "points");
  if (shape.size() != 3 || shape[0] != times || shape[2] != 3) {
    throw hdf5::Error("data set 'points' should have the shape [" + std::to_string(times) +
                      " times][points][3]");
  }
  return shape[1];
}

std::vector<double> read_times(hid_t file) {
  std::vector<double> times;
  for (const double time : hdf5::read_all(file, "times")) {
    check_time(times, time);
    times.push_back(time);
  }
  if (times.empty()) throw hdf5::Error("there are no points in it");
  return times;
}

}  // namespace

struct MeshWriter::Open {
  hdf5::Handle file;
  hdf5::Handle points;
  hdf5::Handle times;
  std::vector<double> written;
  std::size_t point_count;

  Open(const std::filesystem::path& part, const MeshTopology& topology, double time0)
      : file(hdf5::create_file(part)),
        points(hdf5::create_rows(file.get(), "points", {topology.points, 3}, H5T_NATIVE_DOUBLE, "m")),
        times(hdf5::create_rows(file.get(), "times", {}, H5T_NATIVE_DOUBLE, "s")),
        point_count(topology.points) {
    const hid_t root = file.get();
    hdf5::write_attribute(root, "format", std::string(format));
    hdf5::write_attribute(root, "version", mesh_version);
    hdf5::write_attribute(root, "complete", 0);
    hdf5::write_attribute(root, "cells", static_cast<int>(topology.cells));
    hdf5::write_attribute(root, "time0", time0);
    hdf5::write_array(root, "face_begin", topology.face_begin);
    hdf5::write_array(root, "face_points", topology.face_points);
    hdf5::write_array(root, "owner", topology.owner);
    hdf5::write_array(root, "neighbour", topology.neighbour);
    write_patches(root, topology.patches);
  }

  void append(double time, const MeshPoints& row) {
    if (row.size() != point_count) {
      throw hdf5::Error("there are " + std::to_string(row.size()) + " points at time " +
                        std::to_string(written.size()) + ", expected " + std::to_string(point_count));
    }
    check_time(written, time);
    check_finite(row);
    hdf5::append_row(points, row.front().data());
    hdf5::append_row(times, &time);
    written.push_back(time);
  }

  void finish() {
    if (written.empty()) throw hdf5::Error("no points were written");
    hdf5::flush(file.get());
    hdf5::overwrite_attribute(file.get(), "complete", 1);
    hdf5::flush(file.get());
    points.close("close data set 'points'");
    times.close("close data set 'times'");
    file.close("close the file");
  }
};

void require_mesh_or_nothing(const std::filesystem::path& path) {
  hdf5::naming_file<MeshFileError>(path, [&] { hdf5::require_format_or_nothing(path, format); });
}

MeshWriter::MeshWriter(const std::filesystem::path& path, const MeshTopology& topology, double time0)
    : path_(path), part_(path.string() + ".part") {
  hdf5::naming_file<MeshFileError>(part_, [&] {
    check_topology(topology);
    if (!std::isfinite(time0)) throw hdf5::Error("time0 is not a finite number");
    open_ = std::make_unique<Open>(part_, topology, time0);
  });
}

MeshWriter::~MeshWriter() {
  const hdf5::QuietErrors quiet;
  open_.reset();
}

void MeshWriter::append(double time, const MeshPoints& points) {
  hdf5::naming_file<MeshFileError>(part_, [&] { open_->append(time, points); });
}

void MeshWriter::finish() {
  hdf5::naming_file<MeshFileError>(part_, [&] {
    open_->finish();
    hdf5::rename_file(part_, path_);
  });
}

struct MeshReader::Open {
  hdf5::Handle file;
  double time0 = 0;
  std::vector<double> times;
  MeshTopology topology;

  explicit Open(const std::filesystem::path& path) : file(hdf5::open_file(path, "foamMeshToH5")) {
    const hid_t root = file.get();
    hdf5::check_format(root, format, {mesh_version}, "export the mesh again");
    time0 = hdf5::read_double_attribute(root, "time0", 1)[0];
    if (!std::isfinite(time0)) throw hdf5::Error("attribute 'time0' is not a finite number");
    times = read_times(root);
    const int cells = hdf5::read_int_attribute(root, "cells", 1)[0];
    if (cells < 1)
      throw hdf5::Error("attribute 'cells' is " + std::to_string(cells) + ", expected 1 or more");
    topology.cells = static_cast<std::size_t>(cells);
    topology.points = read_point_count(root, times.size());
    topology.face_begin = hdf5::read_ints(root, "face_begin");
    topology.face_points = hdf5::read_ints(root, "face_points");
    topology.owner = hdf5::read_ints(root, "owner");
    topology.neighbour = hdf5::read_ints(root, "neighbour");
    topology.patches = read_patches(root);
    check_topology(topology);
  }
};

MeshReader::MeshReader(const std::filesystem::path& path) : path_(path) {
  hdf5::naming_file<MeshFileError>(path_, [&] { open_ = std::make_unique<Open>(path_); });
}

MeshReader::~MeshReader() = default;
MeshReader::MeshReader(MeshReader&&) noexcept = default;
MeshReader& MeshReader::operator=(MeshReader&&) noexcept = default;

const MeshTopology& MeshReader::topology() const {
  return open_->topology;
}
double MeshReader::time0() const {
  return open_->time0;
}
const std::vector<double>& MeshReader::times() const {
  return open_->times;
}

MeshPoints MeshReader::read_points(std::size_t number) const {
  return hdf5::naming_file<MeshFileError>(path_, [&] {
    if (number >= open_->times.size()) {
      throw hdf5::Error("there are no points " + std::to_string(number) + ", only those of " +
                        std::to_string(open_->times.size()) + " times");
    }
    const std::vector<double> values = hdf5::read_row(open_->file.get(), "points", number);
    MeshPoints points(open_->topology.points);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = Eigen::Vector3d::Map(&values[3 * i]);
    check_finite(points);
    return points;
  });
}

}  // namespace millfoam::averaging
