// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/exchange/exchange_pipes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>

namespace millfoam::averaging {

namespace fs = std::filesystem;

namespace {

constexpr char refusal[] = "refusal";

/// What every message begins with.
struct Header {
  std::array<char, 8> mark;
  std::array<char, 24> kind;
  std::uint64_t text;     ///< bytes
  std::uint64_t numbers;  ///< of 8 bytes
};

constexpr std::array<char, 8> mark{'m', 'i', 'l', 'l', 'F', 'o', 'a', 'm'};

/// More than any message has: the length of bytes that are no message.
constexpr std::uint64_t longest = std::uint64_t{1} << 32U;

std::string reason() {
  return std::generic_category().message(errno);
}

int open_pipe(const fs::path& file, int way) {
  if (mkfifo(file.c_str(), 0600) != 0 && errno != EEXIST)
    throw ExchangeError(file.string() + ": cannot be made: " + reason());
  if (!fs::is_fifo(file)) throw ExchangeError(file.string() + ": is no named pipe, expected one: remove it");
  int pipe = -1;
  do {
    pipe = open(file.c_str(), way | O_CLOEXEC);
  } while (pipe < 0 && errno == EINTR);
  if (pipe < 0) throw ExchangeError(file.string() + ": cannot be opened: " + reason());
  return pipe;
}

}  // namespace

ExchangePipes::ExchangePipes(const fs::path& folder, ExchangeSide side) : folder_(folder), side_(side) {
  // A write to a program that has ended is an error here, not a signal that ends this one without a word
  std::signal(SIGPIPE, SIG_IGN);
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) throw ExchangeError(folder.string() + ": cannot be made: " + failed.message());
  try {
    open_both();
  } catch (...) {
    // The other side must not wait for a reader of this end
    close_both();
    throw;
  }
}

ExchangePipes::~ExchangePipes() {
  close_both();
}

void ExchangePipes::open_both() {
  // An open waits for the other end, so both sides open the pipes in the same order
  if (side_ == ExchangeSide::balls) {
    in_ = open_pipe(folder_ / "to_balls", O_RDONLY);
    out_ = open_pipe(folder_ / "to_flow", O_WRONLY);
  } else {
    out_ = open_pipe(folder_ / "to_balls", O_WRONLY);
    in_ = open_pipe(folder_ / "to_flow", O_RDONLY);
  }
}

void ExchangePipes::close_both() noexcept {
  for (const int pipe : {in_, out_})
    if (pipe >= 0) close(pipe);
}

std::string ExchangePipes::other() const {
  return folder_.string() + ": " + (side_ == ExchangeSide::balls ? "the flow" : "the run of the balls");
}

void ExchangePipes::write_all(const void* data, std::size_t bytes) {
  const auto* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t done = write(out_, from, bytes);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) throw ExchangeError(other() + " has ended (" + reason() + "); its log says why");
    from += done;
    bytes -= static_cast<std::size_t>(done);
  }
}

void ExchangePipes::read_all(void* data, std::size_t bytes) {
  auto* to = static_cast<char*>(data);
  while (bytes > 0) {
    const ssize_t done = read(in_, to, bytes);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) throw ExchangeError(other() + " cannot be read: " + reason());
    if (done == 0) throw ExchangeError(other() + " has ended; its log says why");
    to += done;
    bytes -= static_cast<std::size_t>(done);
  }
}

void ExchangePipes::send(const ExchangeMessage& message) {
  Header header{mark, {}, message.text.size(), message.numbers.size()};
  message.kind.copy(header.kind.data(), header.kind.size() - 1);
  write_all(&header, sizeof header);
  write_all(message.text.data(), message.text.size());
  write_all(message.numbers.data(), message.numbers.size() * sizeof(double));
}

ExchangeMessage ExchangePipes::receive() {
  Header header{};
  read_all(&header, sizeof header);
  if (header.mark != mark || header.text > longest || header.numbers > longest)
    throw ExchangeError(other() + " sends what is no message of millFoam: another program uses the pipe");
  ExchangeMessage message;
  header.kind.back() = '\0';
  message.kind = header.kind.data();
  message.text.resize(header.text);
  read_all(message.text.data(), message.text.size());
  message.numbers.resize(header.numbers);
  read_all(message.numbers.data(), message.numbers.size() * sizeof(double));
  if (message.kind == refusal) throw ExchangeError(other() + " cannot go on: " + message.text);
  return message;
}

ExchangeMessage ExchangePipes::receive(const std::string& kind) {
  ExchangeMessage message = receive();
  if (message.kind != kind)
    throw ExchangeError(other() + " sends '" + message.kind + "', expected '" + kind +
                        "': both programs must be of the same version");
  return message;
}

void ExchangePipes::refuse(const std::string& reason) noexcept {
  try {
    send({refusal, reason, {}});
  } catch (const std::exception&) {
    // The other one has ended already
    return;
  }
}

}  // namespace millfoam::averaging
