// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/tools/live_options.hpp"

#include <filesystem>
#include <stdexcept>

#include "averaging/tools/mill_averages.hpp"
#include "averaging/tools/options.hpp"
#include "meshing/files/text_numbers.hpp"

namespace millfoam::averaging {

namespace {

Options parse(const std::string& text) {
  Options options;
  CLI::App app;
  app.set_help_flag();
  declare_averages(app, options);
  try {
    if (!text.empty()) app.parse(text);
  } catch (const CLI::ParseError& error) {
    throw std::invalid_argument("--average '" + text + "': " + error.what());
  }
  return options;
}

}  // namespace

LiveRequest live_request(const meshing::MillDescription& description, const std::string& text,
                         const std::string& case_folder, double begin, double duration, double timestep) {
  const meshing::Mill& mill = description.mill;
  Options options = parse(text);
  options.case_folder = case_folder;
  const bool others = request_others(options), own_windows = has_windows(options);
  std::optional<double> end;
  if (!own_windows) {
    const double window = mill.averages.window;
    options.windows = {mill.averages.whole_run ? "whole" : exact(window)};
    options.start = begin + mill.averages.start.value_or(0);
    if (!mill.averages.whole_run)
      end = last_whole_window(*options.start, begin + duration, duration, window, timestep);
  }
  if (!has_grid(options)) take_grid(mill, options);
  if (options.output.empty()) options.output = (std::filesystem::path(case_folder) / "solids.h5").string();
  LiveRequest result{as_request(options), end, !own_windows && !mill.averages.start, tolerance(options, 1)};
  result.request.superquadrics_as_spheres = mill.charge.has_shapes();
  if (!others) result.request.mill_averages = mill.fingerprint.averages;
  return result;
}

}  // namespace millfoam::averaging
