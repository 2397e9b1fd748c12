// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace millfoam::averaging {

/// Walks through a text line by line and knows where it is.
class TextLines {
 public:
  /// @param name  of the file, for `place`
  TextLines(std::string_view text, std::string name) : rest_(text), name_(std::move(name)) {}

  bool at_end() const { return rest_.empty(); }

  /// The next line without its line end (LF or CR LF); nothing when the text ends before a line end.
  std::optional<std::string_view> next() {
    ++line_;
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  /// The next line, which stays the next one.
  std::string_view peek() const { return rest_.substr(0, rest_.find('\n')); }

  /// "file:line: " of the line that `next` gave last.
  std::string place() const { return name_ + ':' + std::to_string(line_) + ": "; }

 private:
  std::string_view rest_;
  std::string name_;
  std::size_t line_ = 0;
};

/// Takes the next word off the front of a line; empty when there is none.
inline std::string_view take_word(std::string_view& line) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  std::size_t begin = 0;
  while (begin < line.size() && is_blank(line[begin])) ++begin;
  std::size_t end = begin;
  while (end < line.size() && !is_blank(line[end])) ++end;
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

/// The number that a word is, as a whole and whatever the locale; nothing for any other word.
template <typename Number>
std::optional<Number> as_number(std::string_view word) {
  Number value{};
  const char* const end = word.data() + word.size();
  const auto [stopped, failure] = std::from_chars(word.data(), end, value);
  if (failure != std::errc{} || stopped != end) return std::nullopt;
  return value;
}

}  // namespace millfoam::averaging
