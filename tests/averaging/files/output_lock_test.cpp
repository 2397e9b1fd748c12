// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/output_lock.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "averaging/files/hdf5_file.hpp"
#include "averaging/files/hdf5_io.hpp"
#include "averaging/files/slurry_file.hpp"
#include "averaging/files/slurry_reader.hpp"
#include "averaging/files/solids_layout.hpp"
#include "averaging/mesh/mesh_file.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

void write_hdf5(const std::filesystem::path& path, const std::string& format) {
  const hdf5::Handle file = hdf5::create_file(path);
  hdf5::write_attribute(file.get(), "format", format);
}

TEST(Output, MayReplaceASolidsFileAndNothingElse) {
  const TemporaryFolder folder;
  require_solids_or_nothing(folder / "new.h5");
  write_hdf5(folder / "solids.h5", layout::format);
  require_solids_or_nothing(folder / "solids.h5");
  write_hdf5(folder / "mesh.h5", "millfoam-mesh");
  folder.write("mill.yaml", "geometry: {diameter: 1}\n");
  folder.write("empty", "");
  for (const char* name : {"mesh.h5", "mill.yaml", "empty"}) {
    const auto replace = [&] { require_solids_or_nothing(folder / name); };
    expect_named(message_of<SolidsFileError>(replace), {name, "exists and is not a millfoam-solids file"});
  }
}

TEST(Output, OfAMeshAndOfAFlowReplacesItsOwnKindOnly) {
  const TemporaryFolder folder;
  write_hdf5(folder / "solids.h5", layout::format);
  write_hdf5(folder / "mesh.h5", "millfoam-mesh");
  write_hdf5(folder / "slurry.h5", "millfoam-slurry");
  for (const char* name : {"new.h5", "mesh.h5"}) require_mesh_or_nothing(folder / name);
  for (const char* name : {"new.h5", "slurry.h5"}) require_slurry_or_nothing(folder / name);
  expect_named(message_of<MeshFileError>([&] { require_mesh_or_nothing(folder / "solids.h5"); }),
               {"solids.h5: this file exists and is not a millfoam-mesh file"});
  expect_named(message_of<SlurryFileError>([&] { require_slurry_or_nothing(folder / "solids.h5"); }),
               {"solids.h5: this file exists and is not a millfoam-slurry file"});
}

TEST(Output, ThatIsCutShortIsToldWithTheProgramThatMakesIt) {
  const TemporaryFolder folder;
  write_hdf5(folder / "whole.h5", layout::format);
  for (const std::uintmax_t size : {std::filesystem::file_size(folder / "whole.h5") / 2, std::uintmax_t{4}}) {
    for (const char* name : {"solids.h5", "mesh.h5", "slurry.h5"}) {
      std::filesystem::copy_file(folder / "whole.h5", folder / name,
                                 std::filesystem::copy_options::overwrite_existing);
      std::filesystem::resize_file(folder / name, size);
    }
    const std::string cut = "the file is cut short or not an HDF5 file; make it again with ";
    expect_named(message_of<SolidsFileError>([&] { SolidsReader reader(folder / "solids.h5"); }),
                 {"solids.h5: " + cut + "millAverage"});
    expect_named(message_of<MeshFileError>([&] { MeshReader reader(folder / "mesh.h5"); }),
                 {"mesh.h5: " + cut + "foamMeshToH5"});
    expect_named(message_of<SlurryFileError>([&] { SlurryReader reader(folder / "slurry.h5"); }),
                 {"slurry.h5: " + cut + "slurryFoam"});
  }
}

TEST(Output, IsWrittenByOneRunAtATime) {
  const TemporaryFolder folder;
  const std::filesystem::path output = folder / "solids.h5";
  std::optional<FileLock> first(lock_output(output));
  const FileLock other = lock_output(folder / "other.h5");
  expect_named(message_of<SolidsFileError>([&] { lock_output(output); }),
               {"solids.h5: another millAverage is writing this file", "solids.h5.lock"});
  EXPECT_TRUE(std::filesystem::exists(folder / "solids.h5.lock"))
      << "a run that is refused takes no lock away";
  first.reset();
  EXPECT_FALSE(std::filesystem::exists(folder / "solids.h5.lock"));
  const FileLock third = lock_output(output);
}

TEST(Output, IsNotBlockedByTheLockFileOfARunThatWasKilled) {
  const TemporaryFolder folder;
  folder.write("solids.h5.lock", "");
  const FileLock lock = lock_output(folder / "solids.h5");
}

TEST(Output, InAFolderThatIsNotThereIsRefusedByName) {
  const TemporaryFolder folder;
  expect_named(message_of<std::runtime_error>([&] { lock_output(folder / "none/solids.h5"); }),
               {"none/solids.h5.lock", "is the folder there"});
}

}  // namespace
}  // namespace millfoam::averaging
