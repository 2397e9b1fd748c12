// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <stdexcept>

namespace millfoam {

/// Writes a text file in a folder that is there. The text goes to `<file>.part`, which is renamed when it is
/// whole, so that no half-written file is ever taken for a whole one. Throws std::runtime_error naming the
/// file when it cannot be written; the part is removed then. A device or a pipe is written to, not replaced,
/// and of a link the file that it points to.
void replace_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

/// A file whose folder cannot be made; the message names both.
class FolderError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The same, and makes the file's folder. Throws FolderError, too.
void write_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

}  // namespace millfoam
