// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace millfoam::averaging {

/// Walks through a text line by line and knows where it is. The text may come in pieces.
class TextLines {
 public:
  /// Returns a text that begins with the rest of the present one, which it may move, and continues after it;
  /// the rest itself when there is no more.
  using More = std::function<std::string_view(std::string_view rest)>;

  /// @param text  which must outlive this object
  /// @param name  of the file, for `place`
  TextLines(std::string_view text, std::string name) : rest_(text), name_(std::move(name)) {}
  /// @param more  gives the text piece by piece
  /// @param name  of the file, for `place`
  TextLines(More more, std::string name) : more_(std::move(more)), name_(std::move(name)) {}

  bool at_end() { return rest_.empty() && !fetch(); }  ///< whether no text is left

  /// The next line without its line end (LF or CR LF); nothing when the text ends before a line end. It stays
  /// valid until the next call.
  std::optional<std::string_view> next() {
    ++line_;
    const std::size_t end = find_line_end();
    if (end == std::string_view::npos) return std::nullopt;
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  /// The next line, which stays the next one, or what there is of it.
  std::string_view peek() { return rest_.substr(0, find_line_end()); }

  /// The whole lines that can be had without fetching more text; may be none.
  std::string_view whole_lines() const { return rest_.substr(0, rest_.rfind('\n') + 1); }

  /// Passes over the first `lines` of them, which take `bytes`.
  void skip(std::size_t bytes, std::size_t lines) {
    rest_.remove_prefix(bytes);
    line_ += lines;
  }

  /// Number of the line that `next` gave last, from 1.
  std::size_t line() const { return line_; }

  /// "file:line: " of that line.
  std::string place() const { return place(line_); }

  /// "file:line: " of any line.
  std::string place(std::size_t line) const { return name_ + ':' + std::to_string(line) + ": "; }

 private:
  std::size_t find_line_end() {
    std::size_t searched = 0;
    while (true) {
      const std::size_t end = rest_.find('\n', searched);
      if (end != std::string_view::npos) return end;
      searched = rest_.size();
      if (!fetch()) return std::string_view::npos;
    }
  }

  bool fetch() {
    if (!more_) return false;
    const std::size_t before = rest_.size();
    rest_ = more_(rest_);
    return rest_.size() > before;
  }

  More more_;
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

/// The number that a whole word is, in any locale; nothing for any other word.
template <typename Number>
std::optional<Number> as_number(std::string_view word) {
  Number value{};
  const char* const end = word.data() + word.size();
  const auto [stopped, failure] = std::from_chars(word.data(), end, value);
  if (failure != std::errc{} || stopped != end) return std::nullopt;
  return value;
}

}  // namespace millfoam::averaging
