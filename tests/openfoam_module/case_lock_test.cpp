// SPDX-License-Identifier: GPL-3.0-or-later
/// One flow at a time in a case.
#include "openfoam_module/record/case_lock.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <memory>

#include "temporary_folder.hpp"

namespace millfoam::record {
namespace {

std::string refusal(const std::filesystem::path& folder) {
  try {
    const averaging::FileLock second = lock_case(folder, "slurryStart");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(CaseLock, RefusesASecondFlowAndNamesTheFirst) {
  const TemporaryFolder folder;
  const averaging::FileLock first = lock_case(folder.path, "slurryFoam");
  EXPECT_THAT(refusal(folder.path),
              ::testing::AllOf(::testing::HasSubstr(folder.path.string()),
                               ::testing::HasSubstr("slurryFoam (process " + std::to_string(getpid())),
                               ::testing::HasSubstr("one flow at a time")));
}

TEST(CaseLock, IsFreeAfterItsEnd) {
  const TemporaryFolder folder;
  { const averaging::FileLock first = lock_case(folder.path, "slurryFoam"); }
  EXPECT_EQ(refusal(folder.path), "");
}

TEST(CaseLock, OfAKilledProcessBlocksNobody) {
  const TemporaryFolder folder;
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const averaging::FileLock first = lock_case(folder.path, "slurryFoam");
    if (write(ready[1], "x", 1) == 1) pause();
    _exit(1);
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_THAT(refusal(folder.path), ::testing::HasSubstr("slurryFoam (process " + std::to_string(child)));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(std::filesystem::exists(folder.path / "postProcessing/flow/.lock"));
  EXPECT_EQ(refusal(folder.path), "");
}

TEST(CaseLock, NamesAFolderThatIsNotThere) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal(folder.path / "gone"),
              ::testing::HasSubstr("gone/postProcessing/flow/.lock: cannot be written"));
  EXPECT_FALSE(std::filesystem::exists(folder.path / "gone"));
}

}  // namespace
}  // namespace millfoam::record
