// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace millfoam::averaging {

/// State of a run, from which the next one resumes after it was killed.
struct Checkpoint {
  std::string signature;                  ///< of what is averaged and how
  std::size_t reached = 0;                ///< number of blocks merged; of a DEM run under way, its step
  std::vector<std::size_t> rows;          ///< finished windows of each series of windows
  std::vector<std::vector<double>> open;  ///< moments of each series' window under way, packed
};

/// Writes a checkpoint such that at any moment either the old or the new one is there. Throws
/// SolidsFileError.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Reads it back; nothing when there is none or it is damaged.
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& path);

}  // namespace millfoam::averaging
