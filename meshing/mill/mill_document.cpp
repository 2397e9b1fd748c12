// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_document.hpp"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "meshing/files/file_fingerprint.hpp"
#include "meshing/mill/mill_text.hpp"
#include "meshing/mill/yaml_paths.hpp"

namespace millfoam::meshing {
namespace {

std::string read_bytes(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw MillError(file + ": cannot be read: expected a mill description (YAML)");
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The place of the key's value among those that were read.
nlohmann::ordered_json::json_pointer pointer_to(const std::string& path) {
  nlohmann::ordered_json::json_pointer pointer;
  for (const std::string& name : names_of(path)) pointer /= name;
  return pointer;
}

std::string joined_names(const YAML::Node& map) {
  std::string all;
  for (const auto& entry : map) all += (all.empty() ? "" : ", ") + entry.first.Scalar();
  return all;
}

std::string line_of(const YAML::Node& node) {
  return std::to_string(node.Mark().line + 1);
}

/// Whether one of these paths is inside of the section or list at a path.
template <typename Value>
bool has_inside(const std::map<std::string, Value>& paths, const std::string& path) {
  for (const char separator : {'.', '['}) {
    const auto inside = paths.lower_bound(path + separator);
    if (inside != paths.end() && inside->first.rfind(path + separator, 0) == 0) return true;
  }
  return false;
}

/// Path of the changes that apply a variant.
const std::string variant_path = "variant";
const std::string variants_key = "variants";

/// Refuses entries of a map that have the same key.
/// @param path  of the map
void refuse_twice(const std::string& file, const YAML::Node& map, const std::string& path) {
  std::set<std::string> seen;
  for (const auto& entry : map)
    if (!seen.insert(entry.first.Scalar()).second)
      throw MillError(file + ":" + line_of(entry.first) + ": key '" + path + "." + entry.first.Scalar() +
                      "' is given twice: expected once");
}

/// The variants of a file, which it may not have; of each, its paths are given once.
YAML::Node take_variants(const std::string& file, YAML::Node& root) {
  const YAML::Node variants = root[variants_key];
  root.remove(variants_key);
  if (!variants.IsDefined()) return variants;
  if (!variants.IsMap())
    throw MillError(file +
                    ": key 'variants': expected a map of variants, as in variants: {hill: {flow.law: Hill}}");
  refuse_twice(file, variants, variants_key);
  for (const auto& entry : variants) {
    const std::string path = variants_key + "." + entry.first.Scalar();
    if (!entry.second.IsMap())
      throw MillError(file + ":" + line_of(entry.first) + ": key '" + path +
                      "': expected a map of paths and values, as in {flow.law: Hill}");
    refuse_twice(file, entry.second, path);
  }
  return variants;
}

}  // namespace

MillDocument::MillDocument(const std::filesystem::path& file, std::vector<std::string> set)
    : file_(file.string()), set_(std::move(set)), keys_(std::make_unique<nlohmann::ordered_json>()) {
  const std::string text = read_bytes(file_);
  source_ = file_;
  source_fingerprint_ = fingerprint(text);
  root_ = load_mill_text(file_, text);
  if (root_["format"].IsDefined()) take_resolved();
  const YAML::Node variants = take_variants(file_, root_);
  if (variants.IsDefined())
    for (const auto& entry : variants) variants_.push_back(entry.first.Scalar());
  std::vector<std::string> own;
  for (const std::string& change : set_) {
    const std::size_t sign = change.find('=');
    if (sign != std::string::npos && change.substr(0, sign) == variant_path)
      apply_variant(variants, change.substr(sign + 1));
    else
      own.push_back(change);
  }
  for (const std::string& change : own) apply(change);
}

MillDocument::~MillDocument() = default;

std::vector<std::string> MillDocument::changes() const {
  std::vector<std::string> all = earlier_;
  all.insert(all.end(), set_.begin(), set_.end());
  return all;
}

void MillDocument::take_resolved() {
  if (!root_["format"].IsScalar() || root_["format"].Scalar() != "millfoam-mill" || !root_["mill"].IsMap())
    throw MillError(file_ +
                    ":1: key 'format': expected a mill description, or a resolved one with format "
                    "\"millfoam-mill\"");
  if (root_["file"].IsScalar()) source_ = root_["file"].Scalar();
  if (root_["file_fingerprint"].IsScalar()) source_fingerprint_ = root_["file_fingerprint"].Scalar();
  for (const YAML::Node& change : root_["set"])
    if (change.IsScalar()) earlier_.push_back(change.Scalar());
  for (const auto& line : root_["lines"]) lines_[line.first.Scalar()] = line.second.as<int>(1);
  for (const std::string& change : earlier_) earlier_changed_[change.substr(0, change.find('='))] = change;
  resolved_ = true;
  root_.reset(root_["mill"]);
}

void MillDocument::apply(const std::string& change) {
  const std::string place = "--set " + change;
  const std::size_t sign = change.find('=');
  const auto names =
      sign == std::string::npos ? std::vector<std::string>() : names_of(change.substr(0, sign));
  if (names.empty())
    throw MillError(place + ": expected PATH=VALUE, as in flow.law=Hill or charge.classes[0].mass=0.1");
  if (names.front() == variants_key)
    throw MillError(place + ": expected a key of the mill, or a variant by its name, as in variant=slow");
  YAML::Node value;
  try {
    value = YAML::Load(change.substr(sign + 1));
  } catch (const YAML::ParserException& error) {
    throw MillError(place + ": the value is not valid YAML: " + error.msg);
  }
  require_lists(place, root_, change.substr(0, sign));
  if (change.substr(sign + 1) != "~") {
    assign_key(place, root_, names, value);
  } else if (!remove_key(place, root_, names)) {
    // The file has no such key, and its sections stay as they are
    absent_[change.substr(0, sign)] = change;
    return;
  }
  changed_[change.substr(0, sign)] = change;
}

void MillDocument::apply_variant(const YAML::Node& variants, const std::string& name) {
  const std::string change = "--set " + variant_path + "=" + name;
  if (!variants.IsDefined())
    throw MillError(change + ": " + source_ +
                    " has no variants: expected a map of them under its key 'variants'");
  const YAML::Node variant = variants[name];
  if (!variant.IsDefined())
    throw MillError(change + ": no variant of " + source_ + ": expected one of " + joined_names(variants));
  for (const auto& entry : variant) {
    const std::string path = entry.first.Scalar();
    const std::string place = source_ + ":" + line_of(entry.first);
    const auto names = names_of(path);
    if (names.empty() || names.front() == variants_key)
      throw UnknownKey(place + ": key '" + path + "' of the variant " + name +
                       ": expected a path, as in flow.law or charge.classes[0].mass");
    require_lists(place, root_, path);
    assign_key(place, root_, names, entry.second);
    variant_lines_[path] = entry.first.Mark().line + 1;
    lines_[path] = variant_lines_[path];
  }
}

void MillDocument::note_line(const std::string& path, int line) {
  if (!resolved_ && variant_lines_.count(path) == 0) lines_[path] = line;
}

std::string MillDocument::place(const std::string& path) const {
  // What is inside of a changed value has lines of the change, not of the file
  for (std::string at = path; !at.empty(); at = section_around(at)) {
    for (const auto* changes : {&changed_, &earlier_changed_}) {
      const auto change = changes->find(at);
      if (change != changes->end()) return "--set " + change->second;
    }
  }
  for (std::string at = path; !at.empty(); at = section_around(at)) {
    const auto line = lines_.find(at);
    if (line != lines_.end()) return source_ + ":" + std::to_string(line->second);
    // A section that only a change of one of its keys, or a variant's, has made
    const auto inside = changed_.lower_bound(at + '.');
    if (inside != changed_.end() && inside->first.rfind(at + '.', 0) == 0) return "--set " + inside->second;
    const auto made = variant_lines_.lower_bound(at + '.');
    if (made != variant_lines_.end() && made->first.rfind(at + '.', 0) == 0)
      return source_ + ":" + std::to_string(made->second);
  }
  return source_ + ":1";
}

bool MillDocument::is_changed(const std::string& path) const {
  return changed_.count(path) > 0 || has_inside(changed_, path);
}

void MillDocument::record(const std::string& path, const nlohmann::ordered_json& value) {
  (*keys_)[pointer_to(path)] = value;
}

bool MillDocument::gives(const std::string& path) const {
  for (std::string at = path; !at.empty(); at = section_around(at))
    if (changed_.count(at) > 0 || variant_lines_.count(at) > 0) return true;
  return false;
}

bool MillDocument::touches(const std::string& path) const {
  return gives(path) || has_inside(changed_, path) || has_inside(variant_lines_, path);
}

void MillDocument::replace(const std::string& path, const std::string& name,
                           const nlohmann::ordered_json& value) {
  const auto pointer = pointer_to(path);
  const nlohmann::ordered_json before = keys_->at(pointer.parent_pointer());
  nlohmann::ordered_json after = nlohmann::ordered_json::object();
  for (const auto& [key, kept] : before.items())
    if (key == pointer.back())
      after[name] = value;
    else
      after[key] = kept;
  keys_->at(pointer.parent_pointer()) = after;
}

void MillDocument::forget(const std::string& path) {
  const auto pointer = pointer_to(path);
  if (keys_->contains(pointer)) keys_->at(pointer.parent_pointer()).erase(pointer.back());
}

const nlohmann::ordered_json& MillDocument::keys() const {
  return *keys_;
}

}  // namespace millfoam::meshing
