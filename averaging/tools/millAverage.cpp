// SPDX-License-Identifier: GPL-3.0-or-later
// Averages the dumps of a DEM run in space and time: see averaging/README.md.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "averaging/run/average_run.hpp"
#include "averaging/dumps/text_lines.hpp"

namespace {

using namespace millfoam::averaging;

/// The options as they are typed.
struct Options {
  std::string dumps;
  std::optional<double> timestep;
  std::vector<double> box;
  std::vector<int> shape;
  std::string window;
  std::optional<double> start;
  std::optional<double> end;
  int template_points = 12;
  std::vector<std::string> periodic;
  std::string output;
};

void declare(CLI::App& app, Options& options) {
  app.add_option("--dumps", options.dumps, "pattern of the dumps' names, in quotes: 'post/dump*.txt'")
      ->required();
  app.add_option("--dt", options.timestep, "DEM time-step, s; unless given, out of run.txt beside the dumps");
  app.add_option("--box", options.box, "two corners x0 y0 z0 x1 y1 z1, m")->required()->expected(6);
  app.add_option("--shape", options.shape, "numbers of voxels nx ny nz")->required()->expected(3);
  app.add_option("--window", options.window, "length of the time windows, s, or 'whole' for one over the run")
      ->required();
  app.add_option("--start", options.start, "DEM time at which the first window begins, s [first dump]");
  app.add_option("--end", options.end, "DEM time from which on dumps are left out, s [none]");
  app.add_option("--template", options.template_points, "points along a sphere's diameter")
      ->capture_default_str();
  app.add_option("--periodic", options.periodic, "axes along which the box repeats: x, y, z")
      ->check(CLI::IsMember({"x", "y", "z"}));
  app.add_option("-o,--output", options.output, "file to write")->required();
}

/// Seconds, or nothing for the whole run.
std::optional<double> window_length(const std::string& text) {
  if (text == "whole") return std::nullopt;
  const std::optional<double> length = as_number<double>(text);
  if (!length || !(*length >= 0)) {
    throw std::invalid_argument("--window is '" + text + "', expected a time in s or 'whole'");
  }
  return *length == 0 ? std::nullopt : length;
}

AverageRequest as_request(const Options& options) {
  const std::vector<double>& b = options.box;
  std::array<bool, 3> periodic{};
  for (const std::string& axis : options.periodic) periodic[static_cast<std::size_t>(axis[0] - 'x')] = true;
  const BoxGrid grid({b[0], b[1], b[2]}, {b[3], b[4], b[5]},
                     {options.shape[0], options.shape[1], options.shape[2]}, periodic);
  return {options.dumps, options.timestep,        grid,          window_length(options.window), options.start,
          options.end,   options.template_points, options.output};
}

void show_progress(std::size_t done, std::size_t of) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const std::size_t stride = terminal ? 1 : std::max<std::size_t>(of / 10, 1);
  if (done % stride != 0 && done != of) return;
  std::fprintf(stderr, "%smillAverage: %zu of %zu dumps%s", terminal ? "\r" : "", done, of,
               terminal && done != of ? "" : "\n");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Averages the balls of a DEM run over voxels and time windows into a solids file");
  Options options;
  declare(app, options);
  try {
    app.parse(argc, argv);
    const auto note = [](const std::string& sentence) { std::cerr << "millAverage: " << sentence << '\n'; };
    const AverageSummary summary = average_run(as_request(options), {show_progress, note});
    std::cout << report(summary) << options.output << '\n';
    return 0;
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const std::exception& error) {
    std::cerr << "millAverage: error: " << error.what() << '\n';
    return 1;
  }
}
