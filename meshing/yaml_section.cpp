// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/yaml_section.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>

#include "meshing/mill.hpp"

namespace millfoam::meshing {
namespace {

/// Least number of single-letter insertions, deletions and replacements between two words (Levenshtein).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row.back();
}

std::string joined(const Section::Keys& words) {
  std::string all;
  for (const auto& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

std::string suggestion(const std::string& word, const Section::Keys& known) {
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
  const bool alike = edit_distance(word, *nearest) <= std::max<std::size_t>(2, nearest->size() / 3);
  return (alike ? "did you mean '" + *nearest + "'? " : "") + "known here: " + joined(known);
}

template <typename Number>
std::optional<Number> parse(std::string text) {
  if (!text.empty() && text.front() == '+') text.erase(0, 1);
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return number;
}

/// A scalar that was written without quotes: a quoted number is a text.
bool is_plain_scalar(const YAML::Node& node) {
  return node.IsScalar() && node.Tag() != "!";
}

std::string shown(const YAML::Node& node) {
  if (node.IsNull()) return "(nothing)";
  if (node.IsMap()) return "{…}";
  if (node.IsSequence()) return "[…]";
  return is_plain_scalar(node) ? node.Scalar() : '"' + node.Scalar() + '"';
}

std::vector<YAML::Node> load(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file)) {
    throw MillError(file.string() + ": cannot be read: expected a mill description (YAML)");
  }
  try {
    return YAML::LoadAll(stream);
  } catch (const YAML::ParserException& error) {
    throw MillError(file.string() + ":" + std::to_string(error.mark.line + 1) +
                    ": not valid YAML: " + error.msg);
  }
}

}  // namespace

std::string shown(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

Section Section::open(const std::filesystem::path& file, const Keys& known) {
  const auto documents = load(file);
  if (documents.empty() || documents.front().IsNull()) {
    throw MillError(file.string() + ":1: the file is empty: expected a mill description with " +
                    joined(known));
  }
  if (documents.size() > 1) {
    throw MillError(file.string() + ": holds " + std::to_string(documents.size()) +
                    " YAML documents: expected one mill description");
  }
  const YAML::Node& root = documents.front();
  if (!root.IsMap()) {
    throw MillError(file.string() + ":" + std::to_string(root.Mark().line + 1) +
                    ": not a map of keys: expected a mill description with " + joined(known));
  }
  return {root, file.string(), "", 1, known};
}

Section::Section(const YAML::Node& node, std::string file, std::string path, int line, const Keys& known)
    : node_(node), file_(std::move(file)), path_(std::move(path)), line_(line), known_(known) {
  check_keys();
}

void Section::check_keys() const {
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const int line = entry.first.Mark().line + 1;
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : shown(entry.first);
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
      fail(line, "key '" + path_of(key) + "' is unknown: " + suggestion(key, known_));
    }
    if (!seen.insert(key).second) fail(line, "key '" + path_of(key) + "' is given twice: expected it once");
  }
}

Section Section::section(const std::string& key, const Keys& known) const {
  const YAML::Node node = value(key, "a map with " + joined(known));
  if (!node.IsMap()) refuse(key, "a map with " + joined(known));
  return {node, file_, path_of(key), line_of(key), known};
}

std::vector<Section> Section::list(const std::string& key, const Keys& known) const {
  const std::string expected = "a list of maps with " + joined(known);
  const YAML::Node node = value(key, expected);
  if (!node.IsSequence() || node.size() == 0) refuse(key, expected);
  std::vector<Section> sections;
  for (const YAML::Node& item : node) {
    const std::string path = path_of(key) + "[" + std::to_string(sections.size()) + "]";
    const int line = item.Mark().line + 1;
    if (!item.IsMap()) {
      fail(line, "key '" + path + "' = " + shown(item) + ": expected a map with " + joined(known));
    }
    sections.push_back({item, file_, path, line, known});
  }
  return sections;
}

bool Section::has(const std::string& key) const {
  return find(key).IsDefined();
}

bool Section::is_text(const std::string& key) const {
  const YAML::Node node = find(key);
  return node.IsDefined() && node.IsScalar();
}

double Section::number(const std::string& key, const Rule& rule) const {
  const YAML::Node node = value(key, rule.expected);
  const auto number = is_plain_scalar(node) ? parse<double>(node.Scalar()) : std::nullopt;
  if (!number || !std::isfinite(*number) || !rule.holds(*number)) refuse(key, rule.expected);
  return *number;
}

double Section::number(const std::string& key, const Rule& rule, double fallback) const {
  return has(key) ? number(key, rule) : fallback;
}

int Section::integer(const std::string& key, const Rule& rule) const {
  const YAML::Node node = value(key, rule.expected);
  const auto number = is_plain_scalar(node) ? parse<int>(node.Scalar()) : std::nullopt;
  if (!number || !rule.holds(*number)) refuse(key, rule.expected);
  return *number;
}

std::string Section::text(const std::string& key, const std::string& fallback) const {
  if (!has(key)) return fallback;
  const YAML::Node node = value(key, "a text");
  if (!node.IsScalar()) refuse(key, "a text");
  return node.Scalar();
}

std::string Section::choice(const std::string& key, const Keys& choices) const {
  const std::string expected = "one of " + joined(choices);
  const YAML::Node node = value(key, expected);
  if (!node.IsScalar() || std::find(choices.begin(), choices.end(), node.Scalar()) == choices.end()) {
    refuse(key, expected);
  }
  return node.Scalar();
}

void Section::refuse(const std::string& key, const std::string& expected) const {
  const YAML::Node node = find(key);
  fail(line_of(key), "key '" + path_of(key) + "'" + (node.IsDefined() ? " = " + shown(node) : " is missing") +
                         ": expected " + expected);
}

YAML::Node Section::value(const std::string& key, const std::string& expected) const {
  assert(std::find(known_.begin(), known_.end(), key) != known_.end());
  const YAML::Node node = find(key);
  if (!node.IsDefined()) refuse(key, expected);
  return node;
}

YAML::Node Section::find(const std::string& key) const {
  for (const auto& entry : node_) {
    if (entry.first.IsScalar() && entry.first.Scalar() == key) return entry.second;
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

int Section::line_of(const std::string& key) const {
  for (const auto& entry : node_) {
    if (entry.first.IsScalar() && entry.first.Scalar() == key) return entry.first.Mark().line + 1;
  }
  return line_;
}

std::string Section::path_of(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

void Section::fail(int line, const std::string& message) const {
  throw MillError(file_ + ":" + std::to_string(line) + ": " + message);
}

}  // namespace millfoam::meshing
