// SPDX-License-Identifier: GPL-3.0-or-later
// Averages the dumps of a DEM run in space and time: see averaging/README.md.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <stdexcept>

#include "averaging/run/average_run.hpp"
#include "averaging/run/program.hpp"
#include "averaging/run/summary_file.hpp"
#include "averaging/tools/mill_averages.hpp"
#include "averaging/tools/mpi_communicator.hpp"
#include "averaging/tools/options.hpp"
#include "meshing/files/standard_output.hpp"

namespace {

using namespace millfoam::averaging;

void show_progress(std::size_t done, std::size_t of) {
  static std::size_t shown = 0;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  if (!terminal && done * 10 / of == shown && done != of) return;
  shown = done * 10 / of;
  std::fprintf(stderr, "%smillAverage: %zu of %zu dumps%s", terminal ? "\r" : "", done, of,
               terminal && done != of ? "" : "\n");
}

/// Prints what is wrong with a ledger; returns the program's exit code.
int verdict(const SolidsSummary& summary, double tolerance) {
  const std::vector<std::string> failures = ledger_failures(summary, tolerance);
  for (const std::string& failure : failures) {
    std::cerr << "millAverage: error: " << summary.file.string() << ": " << failure << '\n';
  }
  return failures.empty() ? 0 : 1;
}

int run(Options& options, Communicator& communicator) {
  const auto note = [&](const std::string& sentence) {
    if (communicator.rank() == 0) std::cerr << "millAverage: " << sentence << '\n';
  };
  std::string fingerprint;
  if (!options.mill.file.empty()) fingerprint = take_from_mill(options.mill.read(), options);
  if (options.dumps.empty()) throw std::invalid_argument("--dumps is missing");
  const double allowed = tolerance(options, 1);
  AverageRequest request = as_request(options);
  request.mill_averages = fingerprint;
  int code = 0;
  for (const SolidsSummary& summary : average_run(request, {show_progress, note}, communicator)) {
    std::cout << report(summary);
    code = std::max(code, verdict(summary, allowed));
  }
  return code;
}

int report_file(const Options& options) {
  constexpr double usual_tolerance = 0.01;
  if (std::filesystem::is_directory(options.json))
    throw std::invalid_argument("--json " + options.json + ": is a folder, expected the name of a file");
  if (!options.json.empty()) require_summary_or_nothing(options.json);
  const SolidsSummary summary = summarise(options.report);
  std::cout << report(summary);
  if (!options.json.empty()) write_summary(options.json, summary, program());
  return verdict(summary, tolerance(options, usual_tolerance));
}

/// What the options ask for. Returns the program's exit code.
int act(Options& options, std::unique_ptr<Communicator>& communicator) {
  if (!options.report.empty()) return report_file(options);
  if (!options.mill.file.empty() && !options.mill.resolved.empty()) {
    millfoam::meshing::write_resolved_mill(options.mill.read(), "millAverage", options.mill.resolved);
    return 0;
  }
  communicator =
      MpiCommunicator::launched() ? std::make_unique<MpiCommunicator>() : std::make_unique<Communicator>();
  return run(options, *communicator);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Averages the balls of a DEM run over cells and time windows into a solids file");
  Options options;
  declare(app, options);
  std::unique_ptr<Communicator> communicator;
  try {
    parse(app, options, argc, argv);
    const int code = act(options, communicator);
    millfoam::require_printed();
    return code;
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const std::exception& error) {
    const bool full = dynamic_cast<const std::bad_alloc*>(&error) != nullptr;
    std::cerr << "millAverage: error: "
              << (full ? "not enough memory: take fewer cells (--shape) or --threads" : error.what()) << '\n';
    // The other ranks wait for this one.
    if (communicator && communicator->size() > 1) MpiCommunicator::abort();
    return 1;
  }
}
