// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/drag/flow_curve.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace millfoam::drag {

namespace {

[[noreturn]] void refuse(const char* name, double value, const char* expected) {
  std::ostringstream text;
  text << name << " is " << value << "; expected " << expected;
  throw std::invalid_argument(text.str());
}

void require_above_zero(const char* name, double value) {
  if (!(value > 0)) refuse(name, value, "a value above 0");
}

void require_not_below_zero(const char* name, double value) {
  if (!(value >= 0)) refuse(name, value, "a value of 0 or above");
}

void require_order(double smallest, double largest) {
  if (!(largest >= smallest)) refuse("the largest viscosity", largest, "a value not below the smallest one");
}

/// A stress over a rate that may be 0, at most `largest`: compared as stresses, because OpenFOAM stops at a
/// division by zero.
double capped(double stress, double rate, double largest) {
  return stress >= largest * rate ? largest : stress / rate;
}

/// k rate^(n - 1), at most `largest`; at rest its limit.
double power_of(double consistency, double exponent, double rate, double largest) {
  if (rate == 0 && exponent >= 1) return exponent > 1 ? 0 : std::min(consistency, largest);
  return capped(consistency * std::pow(rate, exponent), rate, largest);
}

}  // namespace

FlowCurve::FlowCurve(std::string model, std::function<double(double)> curve, std::optional<double> plastic)
    : model_(std::move(model)), curve_(std::move(curve)), plastic_(plastic) {}

FlowCurve FlowCurve::newtonian(double viscosity) {
  require_above_zero("the viscosity", viscosity);
  return {"Newtonian", [viscosity](double) { return viscosity; }, viscosity};
}

FlowCurve FlowCurve::bingham(double yield_stress, double plastic, double largest) {
  require_not_below_zero("the yield stress", yield_stress);
  require_above_zero("the plastic viscosity", plastic);
  require_order(plastic, largest);
  const auto curve = [=](double rate) {
    return yield_stress > 0 ? plastic + capped(yield_stress, rate, largest - plastic) : plastic;
  };
  return {"Bingham", curve, plastic};
}

FlowCurve FlowCurve::papanastasiou(double yield_stress, double plastic, double time) {
  require_not_below_zero("the yield stress", yield_stress);
  require_above_zero("the plastic viscosity", plastic);
  require_above_zero("the time m", time);
  const auto curve = [=](double rate) {
    // Where the exponent is small the difference of the exponential from 1 would cancel
    return plastic + yield_stress * (time * rate > 1e-12 ? -std::expm1(-time * rate) / rate : time);
  };
  return {"Bingham", curve, plastic};
}

FlowCurve FlowCurve::herschel_bulkley(double yield_stress, double consistency, double exponent,
                                      double largest) {
  require_not_below_zero("the yield stress", yield_stress);
  require_above_zero("the consistency k", consistency);
  require_above_zero("the exponent n", exponent);
  require_above_zero("the largest viscosity", largest);
  const auto curve = [=](double rate) {
    return yield_stress > 0 ? capped(yield_stress + consistency * std::pow(rate, exponent), rate, largest)
                            : power_of(consistency, exponent, rate, largest);
  };
  return {"HerschelBulkley", curve, std::nullopt};
}

FlowCurve FlowCurve::casson(double yield_stress, double plastic, double smallest, double largest) {
  require_not_below_zero("the yield stress", yield_stress);
  require_above_zero("the plastic viscosity m", plastic);
  require_not_below_zero("the smallest viscosity", smallest);
  require_order(std::max(smallest, plastic), largest);
  const auto curve = [=](double rate) {
    const double of_yield = yield_stress > 0 ? capped(yield_stress, rate, largest) : 0;
    const double root = std::sqrt(of_yield) + std::sqrt(plastic);
    return std::clamp(root * root, smallest, largest);
  };
  return {"Casson", curve, plastic};
}

FlowCurve FlowCurve::cross(double at_rest, double at_high, double time, double exponent) {
  require_above_zero("the viscosity at rest", at_rest);
  require_not_below_zero("the viscosity at high rates", at_high);
  require_not_below_zero("the time m", time);
  require_above_zero("the exponent n", exponent);
  const auto curve = [=](double rate) {
    return at_high + (at_rest - at_high) / (1 + std::pow(time * rate, exponent));
  };
  return {"CrossPowerLaw", curve, std::nullopt};
}

FlowCurve FlowCurve::power_law(double consistency, double exponent, double smallest, double largest) {
  require_above_zero("the consistency k", consistency);
  require_above_zero("the exponent n", exponent);
  require_not_below_zero("the smallest viscosity", smallest);
  require_order(smallest, largest);
  const auto curve = [=](double rate) {
    return std::max(smallest, power_of(consistency, exponent, rate, largest));
  };
  return {"powerLaw", curve, std::nullopt};
}

}  // namespace millfoam::drag
