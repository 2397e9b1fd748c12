// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/solids_file.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>
#include <limits>

#include "averaging/files/xdmf.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

const BoxGrid grid({-1, -2, 0}, {1, 2, 3}, {2, 3, 4}, {false, false, true});

/// A window with different values in all entries and windows.
WindowAverage window_number(int number) {
  const std::size_t n = grid.size();
  WindowAverage window;
  window.time = {0.5 + 0.05 * number, 0.55 + 0.05 * number, 25 - number,
                 number == 0,         number == 2,          26 + number};
  window.balls_per_cell = 3.5 + number;
  window.ledger = {4.0, 2.5, 1.5, 0};
  window.mean = {std::vector<double>(n), std::vector<double>(3 * n), std::vector<double>(n, 0.004),
                 std::vector<double>(n, 0.005), std::vector<double>(n, 0.75)};
  for (std::size_t v = 0; v < n; ++v) window.mean.solidity[v] = 0.01 * static_cast<double>(v) + 0.1 * number;
  for (std::size_t v = 0; v < 3 * n; ++v) window.mean.velocity[v] = static_cast<double>(v) - 5.0 * number;
  const auto growing = [number](std::size_t size, double first) {
    std::vector<double> values(size);
    for (std::size_t v = 0; v < size; ++v) values[v] = first + 1e-3 * static_cast<double>(v) + 0.2 * number;
    return values;
  };
  window.number = growing(n, 2.5);
  window.solidity_deviation = growing(n, 0.01);
  window.velocity_deviation = growing(3 * n, 0.02);
  window.granular_temperature = growing(n, 0.03);
  return window;
}

/// A folder with a whole file of three windows.
struct SolidsFile : ::testing::Test {
  TemporaryFolder folder;
  std::filesystem::path path = folder / "solids.h5";

  SolidsFile() { write(window_number(1)); }

  void write(const WindowAverage& second) const {
    SolidsHeader header{0.5,
                        1e-5,
                        false,
                        "exact",
                        -6.4,
                        0,
                        0.6,
                        true,
                        "millAverage 1.2",
                        "0123456789abcdef",
                        {},
                        "fedcba9876543210",
                        0.25};
    SolidsWriter writer(path, grid, header);
    writer.append(window_number(0));
    writer.append(second);
    writer.append(window_number(2));
    writer.finish();
  }

  void set_attribute(const char* name, int value) const {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
    H5Awrite(attribute, H5T_NATIVE_INT, &value);
    H5Aclose(attribute);
    H5Fclose(file);
  }

  void remove(const char* name) const {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    H5Ldelete(file, name, H5P_DEFAULT);
    H5Fclose(file);
  }

  /// All values of a data set in the order of the file.
  std::vector<double> values(const char* name) const {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t data = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(data);
    std::vector<double> result(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.data());
    H5Sclose(space);
    H5Dclose(data);
    H5Fclose(file);
    return result;
  }

  std::string refusal_to_open() const {
    return message_of<SolidsFileError>([&] { SolidsReader reader(path); });
  }

  std::string refusal_of_window(std::size_t number) const {
    const SolidsReader reader(path);
    return message_of<SolidsFileError>([&] { reader.read_window(number); });
  }
};

TEST_F(SolidsFile, GivesBackWhatWasWritten) {
  const SolidsReader reader(path);
  EXPECT_EQ(reader.time0(), 0.5);
  EXPECT_EQ(reader.timestep(), 1e-5);
  EXPECT_FALSE(reader.whole_run());
  EXPECT_EQ(reader.header().method, "exact");
  EXPECT_EQ(reader.header().angular_velocity, -6.4);
  EXPECT_EQ(reader.header().solidity_cap, 0.6);
  EXPECT_EQ(reader.header().program, "millAverage 1.2");
  EXPECT_EQ(reader.header().mill_charge, "0123456789abcdef");
  EXPECT_EQ(reader.header().mill_averages, "");
  EXPECT_EQ(reader.header().run_id, "fedcba9876543210");
  EXPECT_EQ(reader.header().fines_share, 0.25);
  const auto& box = std::get<BoxGrid>(reader.grid());
  EXPECT_EQ(box.lower(), grid.lower());
  EXPECT_EQ(box.upper(), grid.upper());
  EXPECT_EQ(box.shape(), grid.shape());
  EXPECT_EQ(box.periodic(), grid.periodic());
  EXPECT_EQ(reader.read_balls_per_cell(), (std::vector<double>{3.5, 4.5, 5.5}));
  ASSERT_EQ(reader.windows().size(), 3U);
  for (int w = 0; w < 3; ++w) {
    const WindowAverage written = window_number(w);
    const SolidsWindow read = reader.read_window(static_cast<std::size_t>(w));
    EXPECT_EQ(reader.windows()[static_cast<std::size_t>(w)].begin, written.time.begin);
    EXPECT_EQ(reader.windows()[static_cast<std::size_t>(w)].end, written.time.end);
    EXPECT_EQ(reader.windows()[static_cast<std::size_t>(w)].records, written.time.records);
    EXPECT_EQ(reader.windows()[static_cast<std::size_t>(w)].starts_late, written.time.starts_late);
    EXPECT_EQ(reader.windows()[static_cast<std::size_t>(w)].ends_short, written.time.ends_short);
    EXPECT_EQ(reader.windows()[static_cast<std::size_t>(w)].expected, written.time.expected);
    EXPECT_EQ(reader.read_ledgers()[static_cast<std::size_t>(w)].outside, written.ledger.outside);
    EXPECT_EQ(read.solidity, written.mean.solidity);
    EXPECT_EQ(read.velocity, written.mean.velocity);
    EXPECT_EQ(read.diameter, written.mean.diameter);
    EXPECT_EQ(read.diameter43, written.mean.diameter43);
    EXPECT_EQ(read.inside_fraction, written.mean.inside_fraction);
  }
}

TEST_F(SolidsFile, HoldsWhatOtherProgramsReadOfIt) {
  std::vector<double> number, solidity, velocity, temperature;
  const auto append = [](std::vector<double>& all, const std::vector<double>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  for (int w = 0; w < 3; ++w) {
    const WindowAverage window = window_number(w);
    append(number, window.number);
    append(solidity, window.solidity_deviation);
    append(velocity, window.velocity_deviation);
    append(temperature, window.granular_temperature);
  }
  EXPECT_EQ(values("number"), number);
  EXPECT_EQ(values("solidity_deviation"), solidity);
  EXPECT_EQ(values("velocity_deviation"), velocity);
  EXPECT_EQ(values("granular_temperature"), temperature);
}

TEST_F(SolidsFile, OfMillFoam02DoesNotKnowHowManyRecordsWouldFillItsWindows) {
  remove("window/expected");
  const SolidsReader reader(path);
  EXPECT_EQ(reader.windows()[1].records, 24);
  EXPECT_EQ(reader.windows()[1].expected, 0);
}

TEST_F(SolidsFile, MayBeReadSeveralTimesAtOnce) {
  const SolidsReader first(path), second(path);
  EXPECT_EQ(first.read_window(2).solidity, second.read_window(2).solidity);
}

TEST_F(SolidsFile, ThatIsMissingIsRefused) {
  std::filesystem::remove(path);
  expect_named(refusal_to_open(), {path.string(), "no such file"});
}

TEST_F(SolidsFile, WhoseRunDidNotFinishIsRefused) {
  std::filesystem::remove(path);
  {
    SolidsWriter writer(path, grid, {});
    writer.append(window_number(0));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  expect_named(refusal_to_open(), {"no such file", "solids.h5.part", "not complete"});
  std::filesystem::rename(folder / "solids.h5.part", path);
  expect_named(refusal_to_open(), {path.string(), "not complete"});
}

TEST_F(SolidsFile, OfAnotherVersionIsRefusedWithBothVersions) {
  set_attribute("version", 7);
  expect_named(refusal_to_open(), {path.string(), "is 7", "expected 2"});
}

TEST_F(SolidsFile, ThatIsSomethingElseIsRefused) {
  folder.write("solids.h5", "ITEM: TIMESTEP\n");
  expect_named(refusal_to_open(), {path.string(), "not an HDF5 file"});
  H5Fclose(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  expect_named(refusal_to_open(), {path.string(), "'format' is missing"});
}

TEST_F(SolidsFile, ThatIsCutShortIsRefused) {
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  expect_named(refusal_to_open(), {path.string()});
}

TEST_F(SolidsFile, WithoutOneOfItsDataSetsIsRefusedByTheSetsName) {
  remove("velocity");
  expect_named(refusal_to_open(), {path.string(), "'velocity'"});
}

TEST_F(SolidsFile, WithAnImpossibleSolidityIsRefusedWithItsVoxel) {
  WindowAverage bad = window_number(1);
  for (const double solidity : {1.0, -0.1, std::nan("")}) {
    bad.mean.solidity[grid.offset({1, 2, 3})] = solidity;
    write(bad);
    expect_named(refusal_of_window(1), {path.string(), "solidity", "(1 2 3)", "window 1"});
  }
  EXPECT_EQ(SolidsReader(path).read_window(0).solidity, window_number(0).mean.solidity);
}

TEST_F(SolidsFile, WithAVelocityThatIsNotFiniteIsRefusedWithItsVoxel) {
  WindowAverage bad = window_number(1);
  bad.mean.velocity[3 * grid.offset({0, 1, 2}) + 2] = std::numeric_limits<double>::infinity();
  write(bad);
  expect_named(refusal_of_window(1), {"velocity is inf", "(0 1 2)", "window 1"});
}

TEST_F(SolidsFile, WithSolidsOfNoDiameterIsRefused) {
  WindowAverage bad = window_number(1);
  bad.mean.diameter[grid.offset({1, 0, 0})] = 0;
  write(bad);
  expect_named(refusal_of_window(1), {"diameter is 0", "(1 0 0)", "above 0"});
}

TEST_F(SolidsFile, AWindowBeyondTheLastIsRefused) {
  expect_named(refusal_of_window(3), {"no window 3", "only 3"});
}

TEST_F(SolidsFile, WhoseWindowsAreOutOfOrderIsRefused) {
  WindowAverage early = window_number(1);
  early.time = {0.1, 0.2, 25};
  write(early);
  expect_named(refusal_to_open(), {"window 1", "0.1", "rising order"});
}

TEST_F(SolidsFile, AFieldOfTheWrongSizeIsNotWritten) {
  SolidsWriter writer(folder / "other.h5", grid, {});
  WindowAverage window = window_number(0);
  window.mean.diameter.pop_back();
  expect_named(message_of<SolidsFileError>([&] { writer.append(window); }), {"diameter", "23", "24"});
  expect_named(message_of<SolidsFileError>([&] { writer.finish(); }), {"other.h5", "no window"});
}

TEST(SolidsWriter, AFolderThatIsNotThereIsToldWithTheFilesName) {
  const auto nowhere = [] { SolidsWriter("no/such/folder/solids.h5", grid, {}); };
  expect_named(message_of<SolidsFileError>(nowhere), {"no/such/folder/solids.h5", "create"});
}

TEST_F(SolidsFile, IsToldToParaViewWindowByWindow) {
  const auto xdmf = write_xdmf(path);
  EXPECT_EQ(xdmf.filename(), "solids.xdmf");
  std::ifstream input(xdmf);
  const std::string text{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  expect_named(text, {"<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"5 4 3\"/>", "<Time Value=\"0.5",
                      "window 2", "solids.h5:/granular_temperature", "Dimensions=\"3 4 3 2 3\""});
  expect_named(message_of<SolidsFileError>([&] { write_xdmf(folder / "solids.xdmf"); }),
               {"solids.xdmf", "ParaView"});
}

/// Writes one window of 0s on a grid and returns the grid as it is read back, and the text of the .xdmf.
std::pair<Grid, std::string> written_and_read(const Grid& other) {
  const TemporaryFolder folder;
  const std::size_t n = cell_count(other);
  WindowAverage window;
  window.time = {0, 1, 1};
  window.mean = {
      std::vector<double>(n), std::vector<double>(3 * n), std::vector<double>(n), std::vector<double>(n), {}};
  window.number = window.solidity_deviation = window.granular_temperature = window.mean.solidity;
  window.velocity_deviation = window.mean.velocity;
  SolidsWriter writer(folder / "solids.h5", other, {});
  writer.append(window);
  writer.finish();
  std::ifstream input(write_xdmf(folder / "solids.h5"));
  return {SolidsReader(folder / "solids.h5").grid(),
          {std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()}};
}

TEST(SolidsFileOnACylinder, GivesTheGridBackAndShowsItAsACurvilinearOne) {
  const CylinderGrid cylinder({0.1, 0.5}, {-1, 2}, {3, 8, 4}, true);
  const auto [read, xdmf] = written_and_read(cylinder);
  const auto& back = std::get<CylinderGrid>(read);
  EXPECT_EQ(back.radii(), cylinder.radii());
  EXPECT_EQ(back.ends(), cylinder.ends());
  EXPECT_EQ(back.shape(), cylinder.shape());
  EXPECT_TRUE(back.periodic_z());
  expect_named(xdmf, {"3DSMesh\" Dimensions=\"5 9 4\"", "solids.h5:/grid/points", "Dimensions=\"5 9 4 3\""});
}

TEST(SolidsFileOnACylinder, SaysWhatItsVelocitiesAreAndWhetherItTurns) {
  for (const CylinderFrame& frame :
       {CylinderFrame{}, CylinderFrame{true, std::nullopt}, CylinderFrame{true, -7.5}}) {
    const auto [read, xdmf] = written_and_read(CylinderGrid({0, 1}, {0, 1}, {2, 3, 4}, false, frame));
    const auto& back = std::get<CylinderGrid>(read).frame();
    EXPECT_EQ(back.cylindrical, frame.cylindrical);
    EXPECT_EQ(back.angular_velocity, frame.angular_velocity);
    expect_named(xdmf, {frame.cylindrical ? "Name=\"velocity_r_theta_z\"" : "Name=\"velocity\""});
  }
}

/// The attribute `version` of a file on a cylinder of that frame.
int version_of(const CylinderFrame& frame) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "solids.h5";
  SolidsWriter(path, CylinderGrid({0, 1}, {0, 1}, {1, 1, 1}, false, frame), {});
  const hid_t file = H5Fopen((path.string() + ".part").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t attribute = H5Aopen(file, "version", H5P_DEFAULT);
  int version = 0;
  H5Aread(attribute, H5T_NATIVE_INT, &version);
  H5Aclose(attribute);
  H5Fclose(file);
  return version;
}

TEST(SolidsFileOnACylinder, HasAVersionThatProgramsRefuseWhichTakeItsVelocitiesForCartesianOnes) {
  EXPECT_EQ(version_of({}), 2);
  EXPECT_EQ(version_of({true, std::nullopt}), 3);
  EXPECT_EQ(version_of({true, 2.0}), 3);
}

TEST(SolidsFileOnCells, GivesTheVolumesBackAndShowsPolyhedra) {
  MeshCells mesh;
  mesh.volumes = {1.0 / 6};
  mesh.file = "mesh.h5";
  mesh.motion = "rotation speed 2";
  mesh.time = 0.25;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  mesh.topology = {16, 4, 3, 0, 2, 1, 3, 0, 1, 3, 3, 0, 3, 2, 3, 1, 2, 3};
  const auto [read, xdmf] = written_and_read(mesh);
  const auto& back = std::get<MeshCells>(read);
  EXPECT_EQ(back.volumes, mesh.volumes);
  EXPECT_EQ(back.file, mesh.file);
  EXPECT_EQ(back.motion, mesh.motion);
  EXPECT_EQ(back.time, mesh.time);
  expect_named(xdmf, {"Mixed\" NumberOfElements=\"1\"", "Dimensions=\"18\"", "solids.h5:/grid/topology"});
}

}  // namespace
}  // namespace millfoam::averaging
