// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/mesh_file.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <fstream>
#include <limits>

#include "tests/averaging/mesh_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

MeshPoints moved(MeshPoints points, double by) {
  for (Eigen::Vector3d& point : points) point.x() += by;
  return points;
}

/// A folder with a whole file of a small drum at two times.
struct MeshFile : ::testing::Test {
  TemporaryFolder folder;
  std::filesystem::path path = folder / "mesh.h5";
  TestMesh mesh = drum_mesh(0.06, 0.024, 2, 1, 2);

  MeshFile() {
    MeshWriter writer(path, mesh.topology, 0.25);
    writer.append(0, mesh.points);
    writer.append(0.5, moved(mesh.points, 0.001));
    writer.finish();
  }

  template <typename Change>
  void change(Change&& how) const {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    how(file);
    H5Fclose(file);
  }

  void set_attribute(const char* name, int value) const {
    change([&](hid_t file) {
      const hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
      H5Awrite(attribute, H5T_NATIVE_INT, &value);
      H5Aclose(attribute);
    });
  }

  /// Puts `value` in place of number `at` of a data set of whole numbers or of floating-point ones.
  void set_value(const char* name, std::size_t at, double value) const {
    change([&](hid_t file) {
      const hid_t data = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(data);
      std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
      H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      values.at(at) = value;
      H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
      H5Sclose(space);
      H5Dclose(data);
    });
  }

  std::string refusal() const {
    return message_of<MeshFileError>([&] { MeshReader reader(path); });
  }
};

TEST_F(MeshFile, GivesBackWhatWasWritten) {
  const MeshReader reader(path);
  EXPECT_EQ(reader.time0(), 0.25);
  EXPECT_EQ(reader.times(), (std::vector<double>{0, 0.5}));
  const MeshTopology& read = reader.topology();
  EXPECT_EQ(read.points, mesh.topology.points);
  EXPECT_EQ(read.cells, mesh.topology.cells);
  EXPECT_EQ(read.face_begin, mesh.topology.face_begin);
  EXPECT_EQ(read.face_points, mesh.topology.face_points);
  EXPECT_EQ(read.owner, mesh.topology.owner);
  EXPECT_EQ(read.neighbour, mesh.topology.neighbour);
  ASSERT_EQ(read.patches.size(), 3U);
  EXPECT_EQ(read.patches[1].name, "front");
  EXPECT_EQ(read.patches[1].first, mesh.topology.patches[1].first);
  EXPECT_EQ(read.patches[1].faces, 12);
  EXPECT_EQ(reader.read_points(0), mesh.points);
  EXPECT_EQ(reader.read_points(1), moved(mesh.points, 0.001));
}

TEST_F(MeshFile, OfOneCellHasNoNeighbours) {
  const TestMesh cube = box_mesh({0, 0, 0}, {1, 1, 1}, {1, 1, 1});
  MeshWriter writer(path, cube.topology, 0);
  writer.append(0, cube.points);
  writer.finish();
  EXPECT_TRUE(MeshReader(path).topology().neighbour.empty());
}

TEST_F(MeshFile, ThatIsNotThereOrNotHdf5IsRefused) {
  std::filesystem::remove(path);
  expect_named(refusal(), {path.string(), "no such file"});
  folder.write("mesh.h5", "points");
  expect_named(refusal(), {path.string(), "not an HDF5 file"});
}

TEST_F(MeshFile, ThatWasNotFinishedIsRefused) {
  std::filesystem::remove(path);
  {
    MeshWriter writer(path, mesh.topology, 0);
    writer.append(0, mesh.points);
  }
  expect_named(refusal(), {"mesh.h5.part", "not complete"});
  std::filesystem::rename(folder / "mesh.h5.part", path);
  expect_named(refusal(), {path.string(), "not complete"});
}

TEST_F(MeshFile, KeepsTheOlderFileUntilTheNewOneIsWhole) {
  MeshWriter writer(path, mesh.topology, 7);
  writer.append(0, mesh.points);
  EXPECT_EQ(MeshReader(path).time0(), 0.25);
  writer.finish();
  EXPECT_EQ(MeshReader(path).time0(), 7);
}

TEST_F(MeshFile, OfAnotherVersionIsRefused) {
  set_attribute("version", 9);
  expect_named(refusal(), {path.string(), "'version' is 9", "expected 1"});
}

TEST_F(MeshFile, WithATopologyThatIsNotOneIsRefused) {
  set_value("owner", 3, 9999);
  expect_named(refusal(), {path.string(), "face 3", "9999"});
}

TEST_F(MeshFile, WithTimesOutOfOrderIsRefused) {
  set_value("times", 1, 0);
  expect_named(refusal(), {path.string(), "time 1", "after 0"});
}

TEST_F(MeshFile, WithACoordinateThatIsNotFiniteIsRefusedWhenItIsRead) {
  set_value("points", 7, std::numeric_limits<double>::quiet_NaN());
  const MeshReader reader(path);
  EXPECT_NO_THROW(reader.read_points(1));
  expect_named(message_of<MeshFileError>([&] { reader.read_points(0); }), {path.string(), "point 2", "nan"});
}

TEST_F(MeshFile, WithADataSetMissingIsRefusedByName) {
  for (const char* name : {"points", "times", "face_begin", "owner", "neighbour", "patch/name"}) {
    SCOPED_TRACE(name);
    MeshWriter writer(path, mesh.topology, 0);
    writer.append(0, mesh.points);
    writer.finish();
    change([&](hid_t file) { H5Ldelete(file, name, H5P_DEFAULT); });
    expect_named(refusal(), {path.string(), std::string(name).substr(std::string(name).find('/') + 1)});
  }
}

TEST_F(MeshFile, HasNoPointsBeyondItsLastTime) {
  const MeshReader reader(path);
  expect_named(message_of<MeshFileError>([&] { reader.read_points(2); }), {"no points 2", "2 times"});
}

TEST_F(MeshFile, IsWrittenOnlyFromWhatCanBeRead) {
  MeshWriter writer(folder / "other.h5", mesh.topology, 0);
  const auto refused = [&](double time, const MeshPoints& points) {
    return message_of<MeshFileError>([&] { writer.append(time, points); });
  };
  expect_named(message_of<MeshFileError>([&] { writer.finish(); }), {"other.h5.part", "no points"});
  expect_named(refused(0, MeshPoints(3)), {"3 points", std::to_string(mesh.points.size())});
  writer.append(1, mesh.points);
  expect_named(refused(1, mesh.points), {"time 1 is 1 s", "after 1 s"});
  MeshTopology broken = mesh.topology;
  broken.owner[0] = -1;
  expect_named(message_of<MeshFileError>([&] { MeshWriter(folder / "x.h5", broken, 0); }), {"face 0"});
}

TEST_F(MeshFile, InAFolderThatIsNotThereIsRefused) {
  expect_named(message_of<MeshFileError>([&] { MeshWriter(folder / "no" / "mesh.h5", mesh.topology, 0); }),
               {"no/mesh.h5.part", "folder"});
}

TEST(MeshWriter, ReportsAFullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "mesh.h5.part");
  const TestMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  const std::string message = message_of<MeshFileError>([&] {
    MeshWriter writer(folder / "mesh.h5", mesh.topology, 0);
    writer.append(0, mesh.points);
    writer.finish();
  });
  expect_named(message, {"mesh.h5.part"});
  EXPECT_FALSE(std::filesystem::exists(folder / "mesh.h5"));
}

}  // namespace
}  // namespace millfoam::averaging
