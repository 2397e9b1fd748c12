// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace millfoam::drag {

/// A slurry's apparent viscosity (shear stress over shear rate) as a function of the shear rate.
///
/// Where a model has no finite viscosity at rest it has a largest one: the cap makes the slurry that has not
/// yielded a very viscous liquid, which creeps through a bed instead of locking it. The drag beta v goes to 0
/// with the slip v.
///
/// The functions that make a curve throw std::invalid_argument, which names the parameter and its value, for
/// viscosities, consistencies and exponents of 0 or below, stresses and times below 0, and a largest
/// viscosity below the smallest. The smallest viscosity, that at high rates and Cross' time may be 0;
/// Papanastasiou's time may not.
class FlowCurve {
 public:
  /// One viscosity, Pa s.
  static FlowCurve newtonian(double viscosity);

  /// min(largest, mu + tau0/rate): the bi-viscosity form of Bingham's plastic.
  /// @param yield_stress  tau0, Pa
  /// @param plastic       mu, Pa s
  /// @param largest       Pa s
  static FlowCurve bingham(double yield_stress, double plastic, double largest);

  /// mu + tau0 (1 - exp(-time rate))/rate: Bingham's plastic after Papanastasiou 1987, J. Rheol. 31:385. Its
  /// largest viscosity is mu + tau0 time.
  /// @param yield_stress  tau0, Pa
  /// @param plastic       mu, Pa s
  /// @param time          s
  static FlowCurve papanastasiou(double yield_stress, double plastic, double time);

  /// min(largest, (tau0 + k rate^n)/rate): Herschel & Bulkley 1926, Kolloid-Z. 39:291.
  /// @param yield_stress  tau0, Pa
  /// @param consistency   k, Pa s^n
  /// @param exponent      n
  /// @param largest       Pa s
  static FlowCurve herschel_bulkley(double yield_stress, double consistency, double exponent, double largest);

  /// (sqrt(tau0/rate) + sqrt(mu))^2 between a smallest and a largest viscosity: Casson 1959.
  /// @param yield_stress  tau0, Pa
  /// @param plastic       mu, Pa s, at high rates
  /// @param smallest      Pa s
  /// @param largest       Pa s
  static FlowCurve casson(double yield_stress, double plastic, double smallest, double largest);

  /// mu_inf + (mu_0 - mu_inf)/(1 + (time rate)^n): Cross 1965, J. Colloid Sci. 20:417.
  /// @param at_rest   mu_0, Pa s
  /// @param at_high   mu_inf, at high rates, Pa s, 0 or above
  /// @param time      s
  /// @param exponent  n
  static FlowCurve cross(double at_rest, double at_high, double time, double exponent);

  /// k rate^(n - 1) between a smallest and a largest viscosity.
  /// @param consistency  k, Pa s^n
  /// @param exponent     n
  /// @param smallest     Pa s, 0 or above
  /// @param largest      Pa s
  static FlowCurve power_law(double consistency, double exponent, double smallest, double largest);

  /// Shear stress over shear rate, Pa s, at a rate of 0 or above, 1/s.
  double apparent_viscosity(double rate) const { return curve_(rate); }

  /// The viscosity that the curve approaches at high rates, Pa s: a Newtonian fluid's own, Bingham's and
  /// Casson's plastic viscosity. The other models have none that describes them.
  std::optional<double> plastic_viscosity() const { return plastic_; }

  const std::string& model() const { return model_; }  ///< its name

 private:
  FlowCurve(std::string model, std::function<double(double)> curve, std::optional<double> plastic);

  std::string model_;
  std::function<double(double)> curve_;
  std::optional<double> plastic_;
};

}  // namespace millfoam::drag
