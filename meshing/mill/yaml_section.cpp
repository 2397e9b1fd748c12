// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/yaml_section.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <set>

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

/// A number without a fraction, also one written as 12.0.
std::optional<int> parse_whole(const std::string& text) {
  if (const auto digits = parse<int>(text)) return digits;
  const auto number = parse<double>(text);
  const bool fits = number && std::abs(*number) <= std::numeric_limits<int>::max();
  return fits && *number == std::floor(*number) ? std::optional(static_cast<int>(*number)) : std::nullopt;
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

}  // namespace

std::string name_or_map(const Section::Keys& names, const Section::Keys& map_keys) {
  return "one of " + joined(names) + ", or a map {" + joined(map_keys) + "}";
}

Section::Section(const std::shared_ptr<MillDocument>& document, const Keys& known)
    : Section(document->root(), document, "", known) {}

Section::Section(const YAML::Node& node, std::shared_ptr<MillDocument> document, std::string path,
                 const Keys& known)
    : node_(node), document_(std::move(document)), path_(std::move(path)), known_(known) {
  check_keys();
}

void Section::check_keys() const {
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : shown(entry.first);
    const std::string path = path_of(key);
    // Keys that --set has made have no line
    if (entry.first.Mark().line >= 0) document_->note_line(path, entry.first.Mark().line + 1);
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
      // {diameter: 0,6} is a diameter of 0 and a key 6
      const bool comma = parse<double>(key) && entry.second.IsNull();
      throw UnknownKey(document_->place(path) + ": key '" + path + "' is unknown: " +
                       (comma ? "a decimal comma? expected a point, as in 0.6" : suggestion(key, known_)));
    }
    if (!seen.insert(key).second) fail(path, "key '" + path + "' is given twice: expected once");
  }
  // What --set removes and is not there may be misspelt
  for (const auto& [absent, change] : document_->absent()) {
    const std::string before = path_.empty() ? "" : path_ + '.';
    if (absent.rfind(before, 0) != 0) continue;
    const std::string rest = absent.substr(before.size());
    const std::string key = rest.substr(0, rest.find_first_of(".["));
    if (std::find(known_.begin(), known_.end(), key) == known_.end())
      throw UnknownKey("--set " + change + ": key '" + path_of(key) +
                       "' is unknown: " + suggestion(key, known_));
  }
}

Section Section::section(const std::string& key, const Keys& known) const {
  const YAML::Node node = value(key, "a map with " + joined(known));
  if (!node.IsMap()) refuse(key, "a map with " + joined(known));
  return {node, document_, path_of(key), known};
}

Section Section::optional_section(const std::string& key, const Keys& known) const {
  if (has(key)) return section(key, known);
  return {YAML::Node(YAML::NodeType::Map), document_, path_of(key), known};
}

std::vector<Section> Section::list(const std::string& key, const Keys& known) const {
  const std::string expected = "a list of maps with " + joined(known);
  const YAML::Node node = value(key, expected);
  if (!node.IsSequence() || node.size() == 0) refuse(key, expected);
  std::vector<Section> sections;
  for (const YAML::Node& item : node) {
    const std::string path = path_of(key) + "[" + std::to_string(sections.size()) + "]";
    if (item.Mark().line >= 0) document_->note_line(path, item.Mark().line + 1);
    if (!item.IsMap()) {
      fail(path, "key '" + path + "' = " + shown(item) + ": expected a map with " + joined(known));
    }
    sections.push_back({item, document_, path, known});
  }
  return sections;
}

bool Section::is_set(const std::string& key) const {
  return document_->is_changed(path_of(key)) && has(key);
}

bool Section::is_given(const std::string& key) const {
  return document_->gives(path_of(key));
}

bool Section::is_touched(const std::string& key) const {
  return document_->touches(path_of(key));
}

void Section::drop(const std::string& key) {
  node_.remove(key);
  document_->forget(path_of(key));
}

void Section::displace(const std::string& key, const Keys& others) {
  if (!is_set(key)) return;
  for (const std::string& other : others)
    if (!is_set(other)) drop(other);
}

void Section::alternatives(const Keys& keys) {
  for (const std::string& key : keys) displace(key, keys);
}

void Section::put(const std::string& key, double value) {
  node_[key] = value;
  document_->record(path_of(key), value);
}

void Section::replace(const std::string& key, const std::string& by, double value) {
  node_.remove(key);
  node_[by] = value;
  document_->replace(path_of(key), by, value);
}

bool Section::has(const std::string& key) const {
  return find(key).IsDefined();
}

bool Section::is_text(const std::string& key) const {
  const YAML::Node node = find(key);
  return node.IsDefined() && node.IsScalar();
}

bool Section::is(const std::string& key, const std::string& word) const {
  return is_text(key) && find(key).Scalar() == word;
}

double Section::number(const std::string& key, const Rule& rule) const {
  const YAML::Node node = value(key, rule.expected);
  const auto number = is_plain_scalar(node) ? parse<double>(node.Scalar()) : std::nullopt;
  if (!number || !std::isfinite(*number) || !rule.holds(*number)) refuse(key, rule.expected);
  document_->record(path_of(key), *number);
  return *number;
}

double Section::number(const std::string& key, const Rule& rule, double fallback) const {
  if (has(key)) return number(key, rule);
  document_->record(path_of(key), fallback);
  return fallback;
}

std::vector<double> Section::numbers(const std::string& key, std::size_t count, const Rule& rule) const {
  const std::string expected = "a list of " + std::to_string(count) + " numbers, each " + rule.expected;
  const YAML::Node node = value(key, expected);
  if (!node.IsSequence() || node.size() != count) refuse(key, expected);
  std::vector<double> list;
  for (std::size_t i = 0; i < count; ++i) {
    const YAML::Node item = node[i];
    const auto number = is_plain_scalar(item) ? parse<double>(item.Scalar()) : std::nullopt;
    if (!number || !std::isfinite(*number) || !rule.holds(*number)) {
      const std::string path = path_of(key) + "[" + std::to_string(i) + "]";
      fail(path, "key '" + path + "' = " + shown(item) + ": expected " + rule.expected);
    }
    list.push_back(*number);
  }
  document_->record(path_of(key), list);
  return list;
}

int Section::integer(const std::string& key, const Rule& rule) const {
  const YAML::Node node = value(key, rule.expected);
  const auto number = is_plain_scalar(node) ? parse_whole(node.Scalar()) : std::nullopt;
  if (!number || !rule.holds(*number)) refuse(key, rule.expected);
  document_->record(path_of(key), *number);
  return *number;
}

int Section::integer(const std::string& key, const Rule& rule, int fallback) const {
  if (has(key)) return integer(key, rule);
  document_->record(path_of(key), fallback);
  return fallback;
}

bool Section::boolean(const std::string& key, bool fallback) const {
  bool truth = fallback;
  if (has(key)) {
    const YAML::Node node = find(key);
    const std::string word = is_plain_scalar(node) ? node.Scalar() : "";
    truth = word == "true" || word == "yes";
    if (!truth && word != "false" && word != "no") refuse(key, "yes or no (true or false)");
  }
  document_->record(path_of(key), truth);
  return truth;
}

std::string Section::text(const std::string& key, const std::string& fallback) const {
  std::string words = fallback;
  if (has(key)) {
    const YAML::Node node = value(key, "a text");
    if (!node.IsScalar()) refuse(key, "a text");
    words = node.Scalar();
  }
  document_->record(path_of(key), words);
  return words;
}

std::string Section::choice(const std::string& key, const Keys& choices) const {
  return chosen(key, choices, "one of " + joined(choices));
}

std::string Section::name(const std::string& key, const Keys& names, const Keys& map_keys) const {
  return chosen(key, names, name_or_map(names, map_keys));
}

std::string Section::chosen(const std::string& key, const Keys& choices, const std::string& expected) const {
  const YAML::Node node = value(key, expected);
  if (!node.IsScalar() || std::find(choices.begin(), choices.end(), node.Scalar()) == choices.end())
    refuse(key, expected);
  document_->record(path_of(key), node.Scalar());
  return node.Scalar();
}

std::string Section::choice(const std::string& key, const Keys& choices, const std::string& fallback) const {
  if (has(key)) return choice(key, choices);
  document_->record(path_of(key), fallback);
  return fallback;
}

void Section::refuse(const std::string& key, const std::string& expected) const {
  const YAML::Node node = find(key);
  fail(path_of(key), "key '" + path_of(key) + "'" + (node.IsDefined() ? " = " + shown(node) : " is missing") +
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

std::string Section::path_of(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

void Section::fail(const std::string& path, const std::string& message) const {
  throw MillError(document_->place(path) + ": " + message);
}

}  // namespace millfoam::meshing
