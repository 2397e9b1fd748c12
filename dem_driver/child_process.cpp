// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace millfoam::dem_driver {

namespace {

std::runtime_error failure(const std::string& what, int code) {
  return std::runtime_error(what + ": " + std::strerror(code));
}

/// Pseudo-terminal whose far end passes bytes on unchanged.
struct Terminal {
  int near_end = -1;
  int far_end = -1;
};

Terminal open_terminal() {
  Terminal terminal;
  terminal.near_end = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  std::array<char, 128> name{};
  if (terminal.near_end >= 0 && grantpt(terminal.near_end) == 0 && unlockpt(terminal.near_end) == 0 &&
      ptsname_r(terminal.near_end, name.data(), name.size()) == 0)
    terminal.far_end = open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (terminal.far_end < 0) {
    const int code = errno;
    if (terminal.near_end >= 0) close(terminal.near_end);
    throw failure("no pseudo-terminal", code);
  }
  termios mode{};
  tcgetattr(terminal.far_end, &mode);
  cfmakeraw(&mode);
  tcsetattr(terminal.far_end, TCSANOW, &mode);
  return terminal;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> result;
  result.reserve(words.size() + 1);
  for (auto& word : words) result.push_back(word.data());
  result.push_back(nullptr);
  return result;
}

/// This process's environment with `additions` in the place of entries of the same name.
std::vector<std::string> merged_environment(const std::vector<std::string>& additions) {
  std::vector<std::string> merged = additions;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('=') + 1);
    bool replaced = false;
    for (const auto& addition : additions) replaced = replaced || addition.rfind(name, 0) == 0;
    if (!replaced) merged.push_back(text);
  }
  return merged;
}

}  // namespace

std::optional<std::filesystem::path> find_on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto candidate =
        std::filesystem::absolute(std::filesystem::path(folder.empty() ? "." : folder) / program);
    if (std::filesystem::is_regular_file(candidate) && access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  return std::nullopt;
}

double largest_child_memory() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& directory,
                           const std::vector<std::string>& environment) {
  const Terminal terminal = open_terminal();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, terminal.far_end, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, terminal.far_end, STDERR_FILENO);
  posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());

  std::vector<std::string> words = arguments;
  std::vector<std::string> variables = merged_environment(environment);
  const int code = posix_spawn(&pid_, words[0].c_str(), &actions, nullptr, pointers(words).data(),
                               pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  close(terminal.far_end);
  terminal_ = terminal.near_end;
  if (code != 0) {
    close(terminal_);
    throw failure(arguments[0] + " cannot be started in " + directory.string(), code);
  }
}

ChildProcess::~ChildProcess() {
  if (pid_ > 0) kill(pid_, SIGTERM);
  // Closed before the wait, so that a child that is writing cannot block for ever.
  close(terminal_);
  if (pid_ > 0) wait();
}

bool ChildProcess::fill_buffer() {
  std::array<char, 4096> bytes{};
  for (;;) {
    const ssize_t count = read(terminal_, bytes.data(), bytes.size());
    if (count > 0) {
      buffer_.append(bytes.data(), static_cast<std::size_t>(count));
      return true;
    }
    // Linux reports EIO once the last writer has closed the far end.
    if (count == 0 || errno != EINTR) return false;
  }
}

std::optional<std::string> ChildProcess::read_line() {
  std::size_t end = 0;
  while ((end = buffer_.find('\n')) == std::string::npos)
    if (!fill_buffer()) break;
  if (end == std::string::npos && buffer_.empty()) return std::nullopt;
  std::string line = buffer_.substr(0, end);
  buffer_.erase(0, end == std::string::npos ? end : end + 1);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

int ChildProcess::wait() {
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace millfoam::dem_driver
