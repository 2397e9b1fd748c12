// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/tools/live_options.hpp"

#include <filesystem>
#include <stdexcept>

#include "averaging/run/dump_checks.hpp"
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
    throw std::invalid_argument(error.what());
  }
  return options;
}

LiveRequest request_of(const meshing::Mill& mill, const std::string& text, const std::string& case_folder,
                       double begin, double duration, double timestep) {
  Options options = parse(text);
  options.case_folder = case_folder;
  const bool others = request_others(options), own_windows = has_windows(options);
  std::optional<double> end;
  const double window = mill.averages.window;
  if (options.windows.empty()) options.windows = {mill.averages.whole_run ? "whole" : exact(window)};
  if (!own_windows) {
    options.start = begin + mill.averages.start.value_or(0);
    if (!mill.averages.whole_run)
      end = last_whole_window(*options.start, begin + duration, duration, window, timestep);
  }
  if (!has_grid(options)) take_grid(mill, options);
  if (options.output.empty()) options.output = (std::filesystem::path(case_folder) / "solids.h5").string();
  LiveRequest result{as_request(options), end, !own_windows && !mill.averages.start, tolerance(options, 1)};
  result.request.superquadrics_as_spheres = mill.charge.has_shapes();
  if (!others) result.request.mill_averages = mill.fingerprint.averages;
  require_period_of(result.request, box_of_run(mill), "the dry run");
  return result;
}

}  // namespace

DumpBox box_of_run(const meshing::Mill& mill) {
  const double radius = mill.geometry.radius();
  const bool periodic = mill.geometry.ends == meshing::Ends::periodic;
  return {{-radius, -radius, 0},
          {radius, radius, mill.geometry.length},
          false,
          {"ff", "ff", periodic ? "pp" : "ff"}};
}

LiveRequest live_request(const meshing::MillDescription& description, const std::string& text,
                         const std::string& case_folder, double begin, double duration, double timestep) {
  return naming_options(
      text, [&] { return request_of(description.mill, text, case_folder, begin, duration, timestep); });
}

}  // namespace millfoam::averaging
