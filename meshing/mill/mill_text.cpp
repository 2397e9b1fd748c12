// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_text.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "meshing/mill/mill_error.hpp"

namespace millfoam::meshing {
namespace {

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

}  // namespace

YAML::Node load_mill_text(const std::string& file, const std::string& bytes) {
  require_utf8(file, bytes);
  const std::string text = without_tabs(file, bytes);
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

}  // namespace millfoam::meshing
