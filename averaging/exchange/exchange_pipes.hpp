// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

/// @file
/// The way by which a run of balls and a flow that run at the same time reach each other.

namespace millfoam::averaging {

/// An exchange that cannot go on; the message says with what, and why.
class ExchangeError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Which of the two programs this is.
enum class ExchangeSide {
  balls,  ///< millLiggghts
  flow    ///< slurryFoam
};

/// What one program tells the other.
struct ExchangeMessage {
  std::string kind;             ///< what it is, one word
  std::string text;             ///< words that belong to it
  std::vector<double> numbers;  ///< the rest
};

/// Two named pipes in a folder of the case, `to_balls` and `to_flow`, between the first ranks of two programs
/// on the same machine. The one that comes first makes them, and waits for the other.
class ExchangePipes {
 public:
  /// Opens both pipes, and returns when the other program has opened them too. Throws ExchangeError naming
  /// the file when a pipe cannot be made or opened.
  ExchangePipes(const std::filesystem::path& folder, ExchangeSide side);
  ~ExchangePipes();
  ExchangePipes(const ExchangePipes&) = delete;
  ExchangePipes& operator=(const ExchangePipes&) = delete;

  /// Sends a message. Throws ExchangeError when the other program has ended.
  void send(const ExchangeMessage& message);

  /// Waits for the next message. Throws ExchangeError when the other program has ended, when it refuses to go
  /// on (with its reason), and for bytes that are no message.
  ExchangeMessage receive();

  /// The next message, which must be of this kind. Throws as `receive`, and for another kind.
  ExchangeMessage receive(const std::string& kind);

  /// Tells the other program why this one cannot go on. Does not throw.
  void refuse(const std::string& reason) noexcept;

 private:
  void open_both();
  void close_both() noexcept;
  void write_all(const void* data, std::size_t bytes);
  void read_all(void* data, std::size_t bytes);
  std::string other() const;

  std::filesystem::path folder_;
  ExchangeSide side_;
  int in_ = -1;
  int out_ = -1;
};

}  // namespace millfoam::averaging
