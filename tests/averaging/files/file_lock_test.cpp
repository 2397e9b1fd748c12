// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/file_lock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

/// Another program that this process has started, until the end of this object.
class Child {
 public:
  Child() : pid_(fork()) {
    if (pid_ == 0) {
      execlp("sleep", "sleep", "60", static_cast<char*>(nullptr));
      _exit(127);
    }
  }
  ~Child() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Waits until the program itself runs, so that files that it does not inherit are closed.
  void wait_for_program() const {
    std::string name;
    while (name != "sleep") {
      usleep(1000);
      std::ifstream("/proc/" + std::to_string(pid_) + "/comm") >> name;
    }
  }

 private:
  pid_t pid_;
};

/// Whether a file can be locked while a program still runs that was started under a lock, which has ended.
bool is_free_beside_a_program(const LockRequest& request) {
  std::optional<FileLock> lock = FileLock::take(request);
  const Child program;
  program.wait_for_program();
  lock.reset();
  return FileLock::take(request).has_value();
}

TEST(FileLock, ProgramsThatWereStartedUnderAnInheritedLockKeepIt) {
  const TemporaryFolder folder;
  LockRequest request;
  request.file = folder / "lock";
  EXPECT_TRUE(is_free_beside_a_program(request));
  request.inherited = true;
  EXPECT_FALSE(is_free_beside_a_program(request));
  EXPECT_TRUE(FileLock::take(request).has_value());
}

TEST(FileLock, ATemporaryFileIsRemovedWithTheLockThatHasIt) {
  const TemporaryFolder folder;
  LockRequest request;
  request.file = folder / "lock";
  request.temporary = true;
  {
    std::optional<FileLock> first = FileLock::take(request);
    const FileLock second = std::move(*first);
    first.reset();
    EXPECT_TRUE(std::filesystem::exists(request.file));
    EXPECT_FALSE(FileLock::take(request).has_value());
  }
  EXPECT_FALSE(std::filesystem::exists(request.file));
}

TEST(FileLock, AFolderThatIsMissingIsNamed) {
  const TemporaryFolder folder;
  LockRequest request;
  request.file = folder / "missing" / "lock";
  EXPECT_NE(message_of<std::runtime_error>([&] { FileLock::take(request); }).find(request.file.string()),
            std::string::npos);
}

}  // namespace
}  // namespace millfoam::averaging
