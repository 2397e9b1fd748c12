// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "meshing/mill/mill_error.hpp"

namespace millfoam::meshing {

/// A mill description as YAML nodes: the file's, with the values of `--set` in their places. It also keeps
/// the value of every key that was read, defaults too, from which the resolved mill is written.
class MillDocument {
 public:
  /// @param file  YAML, or a resolved mill (JSON), whose keys are read again
  /// @param set   changes "path=value", in their order: "flow.law=Hill", "charge.classes[0].mass=0.1",
  ///              "dem={duration: 4}"; the value is YAML, and `~` removes the key. "variant=NAME" takes the
  ///              values of the map NAME under the file's key `variants` as if they were in the file; other
  ///              changes come after all variants
  /// Throws MillError for a file that cannot be read, is not UTF-8 or no single YAML map, and for a change
  /// of a wrong form.
  MillDocument(const std::filesystem::path& file, std::vector<std::string> set);
  ~MillDocument();

  /// The file that was read.
  const std::string& file() const { return file_; }
  /// Changes that were made, of a resolved mill those of its description too.
  std::vector<std::string> changes() const;
  /// The map of all keys, changes made.
  const YAML::Node& root() const { return root_; }
  /// The names of the file's variants, in its order.
  const std::vector<std::string>& variants() const { return variants_; }
  /// The description that a person wrote: the file, or that of which the resolved mill was made.
  const std::string& source() const { return source_; }
  /// FNV-1a hash of the source's bytes, 16 hexadecimal digits.
  const std::string& source_fingerprint() const { return source_fingerprint_; }

  /// Notes the line of a key, from 1. A resolved mill knows the lines of its source.
  void note_line(const std::string& path, int line);
  /// The lines that are known, by the key's path.
  const std::map<std::string, int>& lines() const { return lines_; }
  /// The place of a key, or of the innermost section around it that exists: "mill.yaml:12", or
  /// "--set flow.law=Hill".
  std::string place(const std::string& path) const;

  /// Whether --set gave this very key, or one inside of it.
  bool is_changed(const std::string& path) const;

  /// Keeps the value of a key that was read; `path` as in "charge.classes[0].mass".
  void record(const std::string& path, const nlohmann::ordered_json& value);
  /// Whether --set or a variant gives the key, or a section around it.
  bool gives(const std::string& path) const;
  /// Whether --set or a variant gives the key, a section around it, or what is inside of it.
  bool touches(const std::string& path) const;
  /// Paths that --set removes and the file does not have -> the change.
  const std::map<std::string, std::string>& absent() const { return absent_; }
  /// Takes another key of its section, of that name, as the one that was read, at its place.
  void replace(const std::string& path, const std::string& name, const nlohmann::ordered_json& value);
  /// Takes a key as one that was not read.
  void forget(const std::string& path);
  /// All values that were recorded, as nested objects.
  const nlohmann::ordered_json& keys() const;

 private:
  void take_resolved();
  void apply(const std::string& change);
  void apply_variant(const YAML::Node& variants, const std::string& name);

  std::string file_;
  std::string source_;
  std::string source_fingerprint_;
  std::vector<std::string> earlier_;  ///< changes of a resolved mill
  bool resolved_ = false;
  std::vector<std::string> set_;
  YAML::Node root_;
  std::vector<std::string> variants_;
  std::map<std::string, int> lines_;
  std::map<std::string, int> variant_lines_;            ///< path -> line in the variant that set it
  std::map<std::string, std::string> changed_;          ///< path -> the change that set it
  std::map<std::string, std::string> earlier_changed_;  ///< the same, of a resolved mill
  std::map<std::string, std::string> absent_;           ///< path -> the change that would remove it
  std::unique_ptr<nlohmann::ordered_json> keys_;
};

}  // namespace millfoam::meshing
