// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/child_process.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::message_of;
using tests::TemporaryFolder;
using tests::Variable;

TEST(ChildProcess, ArgumentsWithShellCharactersArriveUnchanged) {
  const std::string nasty = "a b; echo $HOME `id` \"'";
  ChildProcess child({find_on_path("printf")->string(), "%s\n", nasty}, "/", {});
  EXPECT_EQ(child.read_line(), nasty);
  EXPECT_EQ(child.read_line(), std::nullopt);
  EXPECT_EQ(child.wait(), 0);
}

TEST(ChildProcess, ItRunsInItsFolderAlsoWhenTheNameHasABlank) {
  const TemporaryFolder folder;
  ChildProcess child({find_on_path("pwd")->string(), "-P"}, folder.path(), {});
  EXPECT_EQ(child.read_line(), std::filesystem::canonical(folder.path()).string());
}

TEST(ChildProcess, AddedVariablesReplaceThoseOfThisProcess) {
  const Variable path("PATH", "/nowhere:" + std::string(std::getenv("PATH")));
  ChildProcess child({find_on_path("sh")->string(), "-c", "echo $PATH"}, "/", {"PATH=/usr/bin:/bin"});
  EXPECT_EQ(child.read_line(), "/usr/bin:/bin");
}

TEST(ChildProcess, TheExitCodeAndTheLastUnfinishedLineAreKept) {
  ChildProcess child({find_on_path("sh")->string(), "-c", "echo one >&2; printf two; exit 3"}, "/", {});
  EXPECT_EQ(child.read_line(), "one");
  EXPECT_EQ(child.read_line(), "two");
  EXPECT_EQ(child.read_line(), std::nullopt);
  EXPECT_EQ(child.wait(), 3);
}

TEST(ChildProcess, DestroyingARunningChildEndsItAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  { ChildProcess child({find_on_path("sleep")->string(), "60"}, "/", {}); }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(ChildProcess, AFolderThatDoesNotExistIsNamed) {
  const std::string message =
      message_of([] { ChildProcess child({find_on_path("true")->string()}, "/no/such/folder", {}); });
  EXPECT_NE(message.find("/no/such/folder"), std::string::npos);
}

TEST(ChildProcess, AProgramThatIsNotOnPathIsNotFound) {
  const Variable path("PATH", "/no/such/folder");
  EXPECT_EQ(find_on_path("true"), std::nullopt);
}

}  // namespace
}  // namespace millfoam::dem_driver
