// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_document.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "meshing/files/file_fingerprint.hpp"

namespace millfoam::meshing {
namespace {

std::string read_bytes(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw MillError(file + ": cannot be read: expected a mill description (YAML)");
  return {std::istreambuf_iterator<char>(stream), {}};
}

long line_at(const std::string& text, std::size_t position) {
  return 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n');
}

/// Number of bytes of the UTF-8 character that begins at `at`; 0 where none does.
std::size_t utf8_length(const std::string& text, std::size_t at) {
  const auto byte = static_cast<unsigned char>(text[at]);
  const std::size_t length = byte < 0x80             ? 1
                             : (byte & 0xE0) == 0xC0 ? 2
                             : (byte & 0xF0) == 0xE0 ? 3
                             : (byte & 0xF8) == 0xF0 ? 4
                                                     : 0;
  if (at + length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(text[at + i]) & 0xC0) != 0x80) return 0;
  return length;
}

/// Refuses texts that are not UTF-8, by the name of their encoding.
void require_utf8(const std::string& file, const std::string& text) {
  const bool marked = text.rfind("\xFF\xFE", 0) == 0 || text.rfind("\xFE\xFF", 0) == 0;
  if (marked || text.find('\0') != std::string::npos)
    throw MillError(file + ": is in UTF-16: expected UTF-8: save the file in this encoding");
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    if (length == 0) {
      char byte[8];
      std::snprintf(byte, sizeof byte, "0x%02X", static_cast<unsigned>(static_cast<unsigned char>(text[at])));
      throw MillError(file + ":" + std::to_string(line_at(text, at)) + ": byte " + byte +
                      " is not UTF-8, as in a text in Latin-1 (ISO 8859-1): expected UTF-8: save the file in "
                      "this encoding");
    }
    at += length;
  }
}

/// The text with blanks for the tabs before comments and in blank lines, which YAML allows and the parser
/// does not. Refuses other tabs in a line's indentation, of which the parser's message says nothing useful.
std::string without_tabs(const std::string& file, std::string text) {
  for (std::size_t at = text.find('\t'); at != std::string::npos; at = text.find('\t', at + 1)) {
    const std::size_t begin = text.rfind('\n', at) + 1;  // npos + 1 is 0
    const std::size_t first = std::min(text.find_first_not_of(" \t", begin), text.size());
    if (first < at) continue;
    if (first < text.size() && std::string("#\r\n").find(text[first]) == std::string::npos)
      throw MillError(file + ":" + std::to_string(line_at(text, at)) +
                      ": a tab before the key: expected blanks, because YAML allows no tabs there");
    text[at] = ' ';
  }
  return text;
}

/// Values of a file with all aliases written out, and maps and lists within each other, above which it is
/// refused.
constexpr int most_values = 100'000, deepest = 100;

/// A copy in which each use of an alias has a node of its own: otherwise a change of one is one of all.
/// @param depth  of maps and lists around it
/// @param left   values that it may still have
YAML::Node written_out(const std::string& file, const YAML::Node& node, int depth, int& left) {
  if (--left < 0 || depth > deepest)
    throw MillError(
        file + ": more than " + std::to_string(most_values) + " values, or " + std::to_string(deepest) +
        " maps within each other, where all aliases (*NAME) are written out: expected fewer, and no "
        "alias that contains itself");
  YAML::Node copy(node.Type());
  if (node.IsScalar()) copy = YAML::Node(node.Scalar());
  if (node.IsSequence())
    for (const YAML::Node& item : node) copy.push_back(written_out(file, item, depth + 1, left));
  if (node.IsMap())  // with keys that are given twice, which are refused later
    for (const auto& entry : node)
      copy.force_insert(entry.first, written_out(file, entry.second, depth + 1, left));
  copy.SetTag(node.Tag());
  return copy;
}

YAML::Node load(const std::string& file, const std::string& text) {
  std::vector<YAML::Node> documents;
  try {
    documents = YAML::LoadAll(text);
  } catch (const YAML::ParserException& error) {
    throw MillError(file + ":" + std::to_string(error.mark.line + 1) + ": not valid YAML: " + error.msg);
  }
  if (documents.empty() || documents.front().IsNull())
    throw MillError(file +
                    ":1: the file is empty: expected a mill description with its sections, geometry first");
  if (documents.size() > 1)
    throw MillError(file + ": holds " + std::to_string(documents.size()) +
                    " YAML documents: expected one mill description");
  if (!documents.front().IsMap())
    throw MillError(file + ":" + std::to_string(documents.front().Mark().line + 1) +
                    ": not a map of keys: expected a mill description with its sections, geometry first");
  // Copies have no lines; those of the keys stay
  int left = most_values;
  const bool has_aliases = text.find('&') != std::string::npos && text.find('*') != std::string::npos;
  return !has_aliases ? documents.front() : written_out(file, documents.front(), 0, left);
}

/// "a.b[2].c" as {"a", "b", "2", "c"}; empty when it is not a path.
std::vector<std::string> names_of(const std::string& path) {
  std::vector<std::string> names(1);
  for (std::size_t at = 0; at < path.size(); ++at) {
    if (path[at] == '.' || path[at] == '[') {
      if (names.back().empty()) return {};
      names.emplace_back();
    } else if (path[at] == ']') {
      const bool number =
          !names.back().empty() && std::all_of(names.back().begin(), names.back().end(), [](char c) {
            return std::isdigit(static_cast<unsigned char>(c)) != 0;
          });
      if (!number || (at + 1 < path.size() && path[at + 1] != '.')) return {};
      if (at + 1 < path.size()) ++at, names.emplace_back();
    } else {
      names.back() += path[at];
    }
  }
  if (names.back().empty()) return {};
  return names;
}

/// The path of the section or list that a key is in; empty for a section of the root.
std::string section_around(const std::string& path) {
  const std::size_t cut = path.find_last_of(".[");
  return cut == std::string::npos ? "" : path.substr(0, cut);
}

/// The place of the key's value among those that were read.
nlohmann::ordered_json::json_pointer pointer_to(const std::string& path) {
  nlohmann::ordered_json::json_pointer pointer;
  for (const std::string& name : names_of(path)) pointer /= name;
  return pointer;
}

/// The number of an item of a list.
/// @param place  of the change, for messages
std::size_t item_number(const std::string& place, const YAML::Node& list, const std::string& name) {
  std::size_t number = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, number);
  if (error != std::errc{} || stop != end || number >= list.size())
    throw MillError(place + ": '" + name + "': expected a number of the list's items, from 0 to " +
                    std::to_string(list.size() - 1) + ", as in classes[0]");
  return number;
}

/// The item or entry of that name in a node, made where it is missing in a map.
YAML::Node child(const std::string& place, YAML::Node node, const std::string& name) {
  if (node.IsSequence()) return node[item_number(place, node, name)];
  if (!node.IsMap() && !node.IsNull())
    throw MillError(place + ": '" + name + "' is set in '" + node.Scalar() +
                    "', which holds no keys: expected a map");
  if (!node[name].IsDefined()) node[name] = YAML::Node(YAML::NodeType::Map);
  return node[name];
}

/// Throws where a path names an item of a list that is not there: `child` would make a map of it.
void require_lists(const std::string& place, const YAML::Node& root, const std::string& path) {
  for (std::size_t at = path.find('['); at != std::string::npos; at = path.find('[', at + 1)) {
    const std::string list = path.substr(0, at);
    YAML::Node node;
    node.reset(root);
    for (const std::string& name : names_of(list)) {
      if (node.IsSequence())
        node.reset(node[item_number(place, node, name)]);
      else
        node.reset(node.IsMap() && node[name].IsDefined() ? node[name] : YAML::Node());
    }
    if (node.IsSequence()) continue;
    throw MillError(place + ": the mill has no list '" + list +
                    "': expected an item of a list that it has, or the whole list, as in " + list + "=[…]");
  }
}

/// Removes the key at a path from its map, or makes an item of a list null. Returns whether it was there.
bool remove(const std::string& place, const YAML::Node& root, const std::vector<std::string>& names) {
  YAML::Node node;
  node.reset(root);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    const bool last = i + 1 == names.size();
    if (node.IsSequence()) {
      const std::size_t number = item_number(place, node, name);
      if (last)
        node[number] = YAML::Node();
      else
        node.reset(node[number]);
      continue;
    }
    if (node.IsNull()) return false;
    if (!node.IsMap()) child(place, node, name);  // throws
    if (!node[name].IsDefined()) return false;
    if (last)
      node.remove(name);
    else
      node.reset(node[name]);
  }
  return true;
}

/// Gives the key at a path a value.
void assign(const std::string& place, const YAML::Node& root, const std::vector<std::string>& names,
            const YAML::Node& value) {
  YAML::Node node;
  node.reset(root);
  for (std::size_t i = 0; i + 1 < names.size(); ++i) node.reset(child(place, node, names[i]));
  const std::string& last = names.back();
  child(place, node, last);
  if (node.IsSequence())
    node[item_number(place, node, last)] = value;
  else
    node[last] = value;
}

std::string joined_names(const YAML::Node& map) {
  std::string all;
  for (const auto& entry : map) all += (all.empty() ? "" : ", ") + entry.first.Scalar();
  return all;
}

std::string line_of(const YAML::Node& node) {
  return std::to_string(node.Mark().line + 1);
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
  require_utf8(file_, text);
  source_ = file_;
  source_fingerprint_ = fingerprint(text);
  root_ = load(file_, without_tabs(file_, text));
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
    assign(place, root_, names, value);
  } else if (!remove(place, root_, names)) {
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
    assign(place, root_, names, entry.second);
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
  const auto has_inside = [&](char separator) {
    const auto inside = changed_.lower_bound(path + separator);
    return inside != changed_.end() && inside->first.rfind(path + separator, 0) == 0;
  };
  return changed_.count(path) > 0 || has_inside('.') || has_inside('[');
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
  const auto has_inside = [&](const auto& changes, char separator) {
    const auto inside = changes.lower_bound(path + separator);
    return inside != changes.end() && inside->first.rfind(path + separator, 0) == 0;
  };
  return gives(path) || has_inside(changed_, '.') || has_inside(changed_, '[') ||
         has_inside(variant_lines_, '.') || has_inside(variant_lines_, '[');
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
