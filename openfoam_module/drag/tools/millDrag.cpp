// SPDX-License-Identifier: GPL-3.0-or-later
// millDrag: tabulates the drag laws.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>

#include "openfoam_module/drag/drag_laws.hpp"

namespace drag = millfoam::drag;

namespace {

struct Options {
  std::string law = "all";
  std::vector<double> phi;
  std::vector<double> re;
  double viscosity = 1e-3;
  double density = 1000;
  double diameter = 5e-3;
  std::string format = "csv";
};

void print_row(const drag::Law& law, double phi, double re, const Options& options) {
  const double factor = law.factor(phi, re);
  const double beta = drag::exchange_from_factor(phi, options.diameter, options.viscosity, factor);
  std::printf("%s,%.12g,%.12g,%.12g,%.12g\n", std::string(law.name).c_str(), phi, re, factor, beta);
}

void print_table(const Options& options) {
  std::vector<drag::Law> chosen;
  if (options.law == "all") {
    chosen = drag::laws();
  } else {
    chosen = {drag::find_law(options.law)};
  }
  std::puts("law,phi,Re,F,beta");
  for (const drag::Law& law : chosen)
    for (double phi : options.phi)
      for (double re : options.re) print_row(law, phi, re, options);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{
      "Tabulates drag laws: F = total force / (3 pi mu d e v) and the exchange coefficient beta (kg/m^3/s)"};
  app.add_option("--law", options.law, "name of a law, or all")->capture_default_str();
  app.add_option("--phi", options.phi, "solidities, separated by commas or blanks")
      ->required()
      ->delimiter(',')
      ->check(CLI::Range(0.0, 0.999));
  app.add_option("--re", options.re, "Reynolds numbers rho e v d/mu")
      ->required()
      ->delimiter(',')
      ->check(CLI::NonNegativeNumber);
  app.add_option("--mu", options.viscosity, "viscosity, Pa s")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--rho", options.density, "density, kg/m^3; F and beta at given Re do not depend on it")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--d", options.diameter, "diameter, m")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--format", options.format)->check(CLI::IsMember({"csv"}))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    print_table(options);
  } catch (const std::exception& error) {
    std::cerr << "millDrag: error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
