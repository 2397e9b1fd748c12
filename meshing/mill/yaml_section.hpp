// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "meshing/mill/mill_document.hpp"

namespace millfoam::meshing {

/// What a number must satisfy, and the same in words for the message ("a length above 0 m").
struct Rule {
  std::string expected;               ///< in words
  std::function<bool(double)> holds;  ///< whether a number satisfies it
};

/// A strict reader of one map of a mill description. The keys that the map may have are named when it is
/// opened: an unknown or repeated key is refused at once, so that a misspelt key is named as such and not as
/// a missing other one. Every refusal is a MillError "file:line: key 'a.b' = value: expected …". Every value
/// that is read, a default too, is recorded in the document.
class Section {
 public:
  /// Names of keys.
  using Keys = std::vector<std::string>;

  /// The document's root, a map with no keys but the `known` ones.
  Section(const std::shared_ptr<MillDocument>& document, const Keys& known);

  /// The map under `key`, which must be there.
  Section section(const std::string& key, const Keys& known) const;
  /// The map under `key`, or an empty one where the key is not there.
  Section optional_section(const std::string& key, const Keys& known) const;
  /// The maps in the list under `key`, which must be there and have at least one.
  std::vector<Section> list(const std::string& key, const Keys& known) const;

  /// Whether --set gave the key, or one inside of it.
  bool is_set(const std::string& key) const;
  /// Takes the key as not given, and its value as not read.
  void drop(const std::string& key);
  /// Where --set gives the key, it takes the place of these others in the file; others that --set gives too
  /// stay.
  void displace(const std::string& key, const Keys& others);
  /// Keys of which one at most is meant: one that --set gives takes the place of the others in the file.
  void alternatives(const Keys& keys);
  /// Whether --set or a variant gives the key, or a section around it.
  bool is_given(const std::string& key) const;
  /// Whether --set or a variant gives the key, a section around it, or what is inside of it.
  bool is_touched(const std::string& key) const;
  /// Takes a number in the place of the file's.
  void put(const std::string& key, double value);
  /// Takes a number under another key, which is not there, in the place of one that was read.
  void replace(const std::string& key, const std::string& by, double value);

  /// Whether the key is there.
  bool has(const std::string& key) const;
  /// Whether the key is there with a single word or text, not a map or a list.
  bool is_text(const std::string& key) const;
  /// Whether the key is there with this very word.
  bool is(const std::string& key, const std::string& word) const;
  /// The finite number under `key`, which must satisfy the rule.
  double number(const std::string& key, const Rule& rule) const;
  /// As above, or `fallback` where the key is not there.
  double number(const std::string& key, const Rule& rule, double fallback) const;
  /// The list of `count` finite numbers under `key`, each of which must satisfy the rule.
  std::vector<double> numbers(const std::string& key, std::size_t count, const Rule& rule) const;
  /// The whole number under `key`, in decimal digits; a fraction of 0 is allowed, as in 12.0.
  int integer(const std::string& key, const Rule& rule) const;
  /// As above, or `fallback` where the key is not there.
  int integer(const std::string& key, const Rule& rule, int fallback) const;
  /// The truth under `key`: true or yes, false or no; or `fallback` where the key is not there.
  bool boolean(const std::string& key, bool fallback) const;
  /// The text under `key`, or `fallback` where the key is not there.
  std::string text(const std::string& key, const std::string& fallback) const;
  /// The text under `key`, which must be one of the `choices`.
  std::string choice(const std::string& key, const Keys& choices) const;
  /// As above, or `fallback` where the key is not there.
  std::string choice(const std::string& key, const Keys& choices, const std::string& fallback) const;
  /// The text under `key`, which must be one of the `names`. A message says that a map of `map_keys` may be
  /// in its place.
  std::string name(const std::string& key, const Keys& names, const Keys& map_keys) const;

  /// Throws the MillError for a key whose value is not what was expected, or which is missing.
  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const;

 private:
  Section(const YAML::Node& node, std::shared_ptr<MillDocument> document, std::string path,
          const Keys& known);
  void check_keys() const;
  std::string chosen(const std::string& key, const Keys& choices, const std::string& expected) const;
  YAML::Node value(const std::string& key, const std::string& expected) const;
  YAML::Node find(const std::string& key) const;
  std::string path_of(const std::string& key) const;
  [[noreturn]] void fail(const std::string& path, const std::string& message) const;

  YAML::Node node_;
  std::shared_ptr<MillDocument> document_;
  std::string path_;  ///< dotted path from the root, empty at the root
  Keys known_;
};

/// What a key expects that takes a name or a map: "one of glass, HDPE, or a map {density, …}".
std::string name_or_map(const Section::Keys& names, const Section::Keys& map_keys);

}  // namespace millfoam::meshing
