// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace millfoam {

/// FNV-1a hash (64 bits) of bytes, 16 hexadecimal digits: it distinguishes two states of a text.
std::string fingerprint(const std::string& bytes);

/// The same of a file's bytes. Throws std::runtime_error if it cannot be read.
std::string file_fingerprint(const std::filesystem::path& file);

}  // namespace millfoam
