// SPDX-License-Identifier: GPL-3.0-or-later
// millDrag: tabulates the drag laws and their ranges.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <string>

#include "meshing/files/standard_output.hpp"
#include "millfoam_version.hpp"
#include "openfoam_module/drag/drag_laws.hpp"
#include "openfoam_module/drag/flow_curve.hpp"
#include "openfoam_module/drag/pore_shear_rate.hpp"
#include "openfoam_module/drag/viscosity_ratio.hpp"

namespace drag = millfoam::drag;

namespace {

struct Options {
  std::string law = "all";
  bool ranges = false;
  std::vector<double> phi;
  std::vector<double> re;
  std::vector<double> superficial;
  double viscosity = 1e-3;
  double yield_stress = 0;
  double viscosity_ratio = drag::usual_viscosity_ratio;
  double density = 1000;
  double diameter = 5e-3;
  std::string format = "csv";
};

std::vector<drag::Law> chosen_laws(const Options& options) {
  if (options.law == "all") return drag::laws();
  return {drag::find_law(options.law)};
}

void print_ranges(const Options& options) {
  const std::vector<drag::Law> laws = chosen_laws(options);
  std::puts("law,phi_min,phi_max,Re_min,Re_max,reference");
  for (const drag::Law& law : laws) {
    const drag::Range& range = law.range;
    std::printf("%s,%g,%g,%g,%g,\"%s\"\n", std::string(law.name).c_str(), range.phi_min, range.phi_max,
                range.re_min, range.re_max, std::string(law.reference).c_str());
  }
}

void print_factor(const drag::Law& law, double phi, double re, const Options& options) {
  const double factor = law.factor(phi, re);
  const double beta = drag::exchange_from_factor(phi, options.diameter, options.viscosity, factor);
  std::printf("%s,%.12g,%.12g,%.12g,%.12g\n", std::string(law.name).c_str(), phi, re, factor, beta);
}

void print_gradient(const drag::Law& law, double phi, double superficial, const Options& options) {
  const double slip = superficial / (1 - phi);
  const double rate = drag::pore_shear_rate(phi, slip, options.diameter);
  const auto slurry = drag::FlowCurve::bingham(options.yield_stress, options.viscosity,
                                               options.viscosity_ratio * options.viscosity);
  const double mu = slurry.apparent_viscosity(rate);
  const drag::Fluid fluid{options.density, mu};
  const double re = drag::reynolds(phi, slip, options.diameter, fluid);
  const double beta = drag::exchange_coefficient(law, phi, slip, options.diameter, fluid);
  std::printf("%s,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g\n", std::string(law.name).c_str(), phi, re,
              law.factor(phi, re), beta, superficial, mu, beta * slip / (1 - phi));
}

void print_table(const Options& options) {
  const std::vector<drag::Law> laws = chosen_laws(options);
  const bool gradients = !options.superficial.empty();
  std::puts(gradients ? "law,phi,Re,F,beta,U,mu,dpdx" : "law,phi,Re,F,beta");
  for (const drag::Law& law : laws)
    for (double phi : options.phi) {
      for (double re : options.re) print_factor(law, phi, re, options);
      for (double superficial : options.superficial) print_gradient(law, phi, superficial, options);
    }
}

/// A check of an option's word; CLI11's own would print the largest double as a limit.
CLI::Validator finite_number(const std::string& expected, bool (*holds)(double)) {
  return {[=](const std::string& word) {
            double value = 0;
            const bool is_number = CLI::detail::lexical_cast(word, value) && std::isfinite(value);
            return is_number && holds(value) ? std::string() : "'" + word + "': expected " + expected;
          },
          "NUMBER"};
}

const CLI::Validator above_zero = finite_number("a number above 0", [](double value) { return value > 0; });
const CLI::Validator solidity =
    finite_number("a solidity from 0 to 0.999", [](double value) { return value >= 0 && value <= 0.999; });
const CLI::Validator ratio =
    finite_number("a number from 1 to 1e12", [](double value) { return value >= 1 && value <= 1e12; });
const CLI::Validator not_negative =
    finite_number("a number that is 0 or more", [](double value) { return value >= 0; });

void add_options(CLI::App& app, Options& options) {
  app.set_version_flag("--version", std::string("millDrag ") + millfoam::version());
  app.add_option("--law", options.law, "name of a law, or all")->capture_default_str();
  app.add_flag("--ranges", options.ranges, "list the laws with their ranges and references instead");
  app.add_option("--phi", options.phi, "solidities, separated by commas or blanks")
      ->delimiter(',')
      ->check(solidity);
  auto* re = app.add_option("--re", options.re, "Reynolds numbers rho e v d/mu")
                 ->delimiter(',')
                 ->check(not_negative);
  auto* superficial =
      app.add_option("--superficial", options.superficial,
                     "superficial velocities e v, m/s, in place of --re: adds the viscosity mu and the "
                     "pressure gradient dpdx, Pa/m")
          ->delimiter(',')
          ->check(not_negative)
          ->excludes(re);
  app.add_option("--mu", options.viscosity, "viscosity, Pa s; of a Bingham slurry its plastic viscosity")
      ->capture_default_str()
      ->check(above_zero);
  app.add_option("--tau0", options.yield_stress,
                 "yield stress, Pa: the viscosity is the apparent one in the pores")
      ->capture_default_str()
      ->check(not_negative)
      ->needs(superficial);
  app.add_option("--viscosity-ratio", options.viscosity_ratio, "cap of the apparent viscosity over mu")
      ->capture_default_str()
      ->check(ratio)
      ->needs(superficial);
  app.add_option("--rho", options.density, "density, kg/m^3; F and beta at given Re do not depend on it")
      ->capture_default_str()
      ->check(above_zero);
  app.add_option("--d", options.diameter, "diameter, m")->capture_default_str()->check(above_zero);
  app.add_option("--format", options.format)->check(CLI::IsMember({"csv"}))->capture_default_str();
  app.callback([&options] {
    if (options.ranges) return;
    if (options.phi.empty()) throw CLI::RequiredError("--phi");
    if (options.re.empty() && options.superficial.empty()) throw CLI::RequiredError("--re or --superficial");
  });
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{
      "Tabulates drag laws: F = total force / (3 pi mu d e v) and the exchange coefficient beta (kg/m^3/s)"};
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    if (options.ranges) {
      print_ranges(options);
    } else {
      print_table(options);
    }
    millfoam::require_printed();
  } catch (const std::exception& error) {
    std::cerr << "millDrag: error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
