// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "meshing/mill/mill_reader.hpp"

namespace millfoam::meshing {

/// A whole mill description; line 1 is `title`.
inline const std::string example_mill = R"(title: example
geometry:
  diameter: 0.12
  length: 0.024
  ends: plain
  lifters:
    count: 12
    height: 0.008
    width: 0.006
speed:
  fraction_of_critical: 0.5
  sense: clockwise
charge:
  classes:
    - {diameter: 0.008, mass: 0.02}
    - {diameter: 0.002, mass: 0.03}
materials:
  ball: {density: 2700, youngs_modulus: 6.5e10, poisson_ratio: 0.23}
  wall: {density: 1100, youngs_modulus: 1e9, poisson_ratio: 0.4}
  ball_ball: {restitution: 0.8, friction: 0.94, rolling_friction: 0.01}
  ball_wall: {restitution: 0.703, friction: 0.287, rolling_friction: 0.02}
dem:
  youngs_modulus: 1.0e7
  rayleigh_fraction: 0.2
  settle_time: 0.25
  duration: 1.6
  record_interval: 0.002
  seed: 20121
slurry:
  density: 1239
  plastic_viscosity: 0.0014
  yield_stress: 0.16
  level: -0.012
resolution:
  cell_size: 0.003
  layers: 8
)";

/// The text with its first `from` replaced by `to`.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the example has no '" + from + "'");
  return text.replace(at, from.size(), to);
}

/// A folder of this process and object, removed with it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "meshing_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// The mill of a text, changed by --set.
inline MillDescription describe(const std::string& text, const std::vector<std::string>& set = {}) {
  const TemporaryFolder folder;
  return describe_mill(folder.write("mill.yaml", text), set);
}

/// The message with which a mill is refused; empty for one that is accepted.
inline std::string refusal(const std::string& text, const std::vector<std::string>& set = {}) {
  try {
    describe(text, set);
  } catch (const MillError& error) {
    return error.what();
  }
  return "";
}

/// Whether a message has a part, with both in the failure.
inline ::testing::AssertionResult says(const std::string& message, const std::string& part) {
  if (message.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "'" << message << "' does not say '" << part << "'";
}

}  // namespace millfoam::meshing
