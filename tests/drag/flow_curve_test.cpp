// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/drag/flow_curve.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "openfoam_module/drag/pore_shear_rate.hpp"

namespace drag = millfoam::drag;
using drag::FlowCurve;

namespace {

/// Slurry with 30 % solids by mass.
constexpr double yield_stress = 0.16, plastic = 0.0014, cap = 1.4;

FlowCurve slurry() {
  return FlowCurve::bingham(yield_stress, plastic, cap);
}

std::vector<FlowCurve> all_models() {
  return {FlowCurve::newtonian(plastic),
          slurry(),
          FlowCurve::papanastasiou(yield_stress, plastic, 10),
          FlowCurve::herschel_bulkley(yield_stress, 0.01, 0.6, cap),
          FlowCurve::casson(yield_stress, plastic, 1e-4, cap),
          FlowCurve::cross(cap, plastic, 10, 0.8),
          FlowCurve::power_law(0.01, 0.6, 1e-4, cap)};
}

std::string refusal(const std::function<FlowCurve()>& make) {
  try {
    make();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(PoreShearRate, IsThatOfATubeOfThePoresHydraulicDiameter) {
  const double phi = 0.55, slip = 0.1, d = 5e-3;
  const double hydraulic_diameter = 4 * (1 - phi) / (6 * phi / d);
  EXPECT_NEAR(drag::pore_shear_rate(phi, slip, d), 8 * slip / hydraulic_diameter, 1e-10);
  EXPECT_NEAR(drag::pore_shear_rate(phi, slip, d), 290, 5);
}

TEST(PoreShearRate, OfTubesIsThatOfTheirDarcyCoefficient) {
  // Poiseuille: the gradient is 32 mu v/D^2 and the rate at the wall 8 v/D
  const double diameter = 2e-3;
  EXPECT_NEAR(drag::tube_shear_rate(32 / (diameter * diameter), 0.3), 8 * 0.3 / diameter, 1e-9);
}

TEST(FlowCurve, AtRestIsTheLimitOfSmallRates) {
  std::vector<FlowCurve> models = all_models();
  for (const double exponent : {0.6, 1.0, 1.5}) {
    models.push_back(FlowCurve::herschel_bulkley(yield_stress, 0.01, exponent, cap));
    models.push_back(FlowCurve::herschel_bulkley(0, 0.01, exponent, cap));
    models.push_back(FlowCurve::power_law(0.01, exponent, 1e-4, cap));
  }
  models.push_back(FlowCurve::bingham(0, plastic, cap));
  models.push_back(FlowCurve::casson(0, plastic, 1e-4, cap));
  for (std::size_t i = 0; i < models.size(); ++i)
    EXPECT_NEAR(models[i].apparent_viscosity(0), models[i].apparent_viscosity(1e-20), 1e-4 * cap)
        << models[i].model() << ", number " << i;
}

TEST(FlowCurve, OfA30PerCentSlurryInABedAtATenthOfAMetrePerSecond) {
  const double rate = drag::pore_shear_rate(0.55, 0.1, 5e-3);
  EXPECT_NEAR(slurry().apparent_viscosity(rate) / plastic, 1.4, 0.02);
}

TEST(FlowCurve, HasAValueAtRestWithoutDividingByTheRate) {
  // OpenFOAM traps these exceptions.
  for (const FlowCurve& curve : all_models()) {
    for (double rate : {0.0, 1e-300, 1e-20, 1e-10}) {
      std::feclearexcept(FE_ALL_EXCEPT);
      const double viscosity = curve.apparent_viscosity(rate);
      EXPECT_EQ(std::fetestexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW), 0) << curve.model() << rate;
      EXPECT_GT(viscosity, 0) << curve.model();
      EXPECT_LE(viscosity, 2) << curve.model();
    }
  }
}

TEST(FlowCurve, FallsContinuouslyWithTheRateToThePlasticViscosity) {
  for (const FlowCurve& curve : all_models()) {
    double last = curve.apparent_viscosity(0);
    for (double rate = 1e-6; rate < 1e12; rate *= 1.01) {
      const double viscosity = curve.apparent_viscosity(rate);
      EXPECT_LE(viscosity, last * (1 + 1e-12)) << curve.model() << " " << rate;
      EXPECT_GE(viscosity, 0.985 * last) << curve.model() << " " << rate;
      last = viscosity;
    }
    if (curve.plastic_viscosity()) {
      EXPECT_NEAR(last, *curve.plastic_viscosity(), 1e-6) << curve.model();
    }
  }
}

TEST(FlowCurve, BinghamIsItsCapUntilItYields) {
  const double capped_until = yield_stress / (cap - plastic);
  EXPECT_EQ(slurry().apparent_viscosity(0.999 * capped_until), cap);
  EXPECT_NEAR(slurry().apparent_viscosity(capped_until * (1 + 1e-9)), cap, 1e-8);
  EXPECT_NEAR(slurry().apparent_viscosity(100), plastic + yield_stress / 100, 1e-15);
}

TEST(FlowCurve, PapanastasiouHasItsViscosityAtRest) {
  const FlowCurve curve = FlowCurve::papanastasiou(yield_stress, plastic, 50);
  EXPECT_NEAR(curve.apparent_viscosity(0), plastic + 50 * yield_stress, 1e-12);
  EXPECT_NEAR(curve.apparent_viscosity(1e-9), plastic + 50 * yield_stress, 1e-6);
  EXPECT_NEAR(curve.apparent_viscosity(0.02), plastic + yield_stress * (1 - std::exp(-1.0)) / 0.02, 1e-12);
}

TEST(FlowCurve, ModelsWithoutYieldStressOfNewtonsFluidAreNewtonian) {
  const std::vector<FlowCurve> curves{FlowCurve::bingham(0, plastic, cap),
                                      FlowCurve::papanastasiou(0, plastic, 10),
                                      FlowCurve::herschel_bulkley(0, plastic, 1, cap),
                                      FlowCurve::casson(0, plastic, 0, cap),
                                      FlowCurve::cross(plastic, plastic, 10, 0.8),
                                      FlowCurve::power_law(plastic, 1, 0, cap)};
  for (const FlowCurve& curve : curves) {
    for (double rate : {1e-3, 1.0, 1e6}) {
      EXPECT_NEAR(curve.apparent_viscosity(rate), plastic, 1e-15) << curve.model() << rate;
    }
  }
}

TEST(FlowCurve, HerschelBulkleyIsBinghamWithTheExponentOne) {
  const FlowCurve curve = FlowCurve::herschel_bulkley(yield_stress, plastic, 1, cap);
  for (double rate : {0.0, 0.01, 0.1, 1.0, 100.0}) {
    EXPECT_NEAR(curve.apparent_viscosity(rate), slurry().apparent_viscosity(rate), 1e-14) << rate;
  }
}

TEST(FlowCurve, OnlySomeModelsHaveAPlasticViscosity) {
  for (const FlowCurve& curve : all_models()) {
    const bool has = curve.model() == "Newtonian" || curve.model() == "Bingham" || curve.model() == "Casson";
    EXPECT_EQ(curve.plastic_viscosity().has_value(), has) << curve.model();
  }
}

TEST(FlowCurve, RefusesParametersThatDescribeNothing) {
  EXPECT_NE(refusal([] { return FlowCurve::newtonian(0); }).find("the viscosity is 0"), std::string::npos);
  EXPECT_NE(refusal([] { return FlowCurve::bingham(-1, 1, 2); }).find("yield stress is -1"),
            std::string::npos);
  EXPECT_NE(refusal([] { return FlowCurve::bingham(1, 1, 0.5); }).find("largest viscosity is 0.5"),
            std::string::npos);
  EXPECT_NE(refusal([] { return FlowCurve::papanastasiou(1, 1, 0); }).find("the time m is 0"),
            std::string::npos);
  EXPECT_NE(refusal([] { return FlowCurve::herschel_bulkley(1, 1, 0, 2); }).find("exponent n is 0"),
            std::string::npos);
  EXPECT_NE(refusal([] { return FlowCurve::casson(1, 1, 3, 2); }).find("largest viscosity is 2"),
            std::string::npos);
  EXPECT_NE(refusal([] { return FlowCurve::cross(1, -1, 1, 1); }).find("at high rates is -1"),
            std::string::npos);
  EXPECT_NE(refusal([] { return FlowCurve::power_law(-1, 1, 0, 2); }).find("consistency k is -1"),
            std::string::npos);
}
