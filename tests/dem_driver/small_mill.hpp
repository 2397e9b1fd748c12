// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem_driver/case_folder.hpp"
#include "meshing/mill.hpp"

namespace millfoam::dem_driver::tests {

/// A smooth periodic drum of 40 mm diameter, turning clockwise, with 150 balls of 3 mm and 100 of 2 mm.
meshing::Mill small_mill();

/// A folder of its own with a blank in its name, removed at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Writes `walls/shell.stl` of a smooth drum, 60 flat sides.
void write_drum(const CaseFolder& folder, const meshing::Geometry& geometry);

/// Sets PATH for the life of the object.
class PathVariable {
 public:
  explicit PathVariable(const std::string& value);
  ~PathVariable();
  PathVariable(const PathVariable&) = delete;
  PathVariable& operator=(const PathVariable&) = delete;

 private:
  std::string before_;
};

/// The message of what `action` throws; empty when it throws nothing.
template <typename Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace millfoam::dem_driver::tests
