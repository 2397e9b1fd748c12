// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

namespace millfoam {

/// The finite number that a whole word is, in any locale; nothing for any other word.
std::optional<double> to_number(std::string_view word);

/// The shortest decimal form of a number that reads back to its last bit.
std::string exact(double value);

/// The three components of a vector in that form, separated by blanks.
std::string exact(const Eigen::Vector3d& vector);

/// A number as a message shows it: the shortest decimal form that reads back to it within six digits.
std::string shown(double value);

/// Text of a point for messages: `(0.1 0 -0.05)`.
std::string described(const Eigen::Vector3d& point);

}  // namespace millfoam
