// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>

namespace millfoam::meshing {

/// The shortest decimal form of a number that reads back to its last bit.
std::string exact(double value);

/// The three components of a vector in that form, separated by blanks.
std::string exact(const Eigen::Vector3d& vector);

/// Writes a text file, making its folder. The text goes to `<file>.partial`, which is renamed when it is
/// whole, so that no half-written file is ever taken for a whole one. Throws std::runtime_error naming the
/// file when it cannot be written.
void write_file(const std::filesystem::path& file, const std::function<void(std::ostream&)>& write);

}  // namespace millfoam::meshing
