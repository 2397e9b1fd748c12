// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>

namespace millfoam {

/// Writes a text file in a folder that is there. The text goes to `<file>.part`, which is renamed when it is
/// whole, so that no half-written file is ever taken for a whole one. Throws std::runtime_error naming the
/// file when it cannot be written; the part is removed then. A device or a pipe is written to, not replaced,
/// and of a link the file that it points to.
void replace_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/// The same, and makes the file's folder.
void write_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

}  // namespace millfoam
