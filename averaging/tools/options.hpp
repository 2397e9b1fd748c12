// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "averaging/run/average_run.hpp"
#include "meshing/tools/mill_options.hpp"

namespace millfoam::averaging {

/// The options of millAverage as they are typed.
struct Options {
  meshing::MillOptions mill;      ///< no file: without a mill
  std::string case_folder = ".";  ///< of the mill
  std::string dumps;
  std::optional<double> timestep;
  std::optional<double> speed;
  std::vector<double> box;
  std::vector<double> cylinder;
  std::string mesh;
  std::vector<int> shape;
  std::vector<std::string> periodic;
  std::vector<std::string> motion;
  std::optional<double> period;
  std::optional<std::string> smoothing;
  std::string method = "exact";
  int template_points = 12;
  std::vector<std::string> walls;
  std::optional<double> solidity_cap;
  std::vector<std::string> windows;
  std::optional<double> start;
  std::optional<double> end;
  int threads = 0;
  double checkpoint_interval = 10;
  std::optional<double> tolerance;
  std::string report;
  std::string json;
  std::string output;
};

/// Declares them, with their help.
void declare(CLI::App& app, Options& options);

/// The share that --tolerance gives, or the usual one. Throws as `as_request`.
double tolerance(const Options& options, double usual);

/// Checks that they go together. Throws std::invalid_argument naming the option, its value and what was
/// expected.
AverageRequest as_request(const Options& options);

}  // namespace millfoam::averaging
