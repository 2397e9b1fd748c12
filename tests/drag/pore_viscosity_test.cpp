// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/drag/pore_viscosity.hpp"

#include <gtest/gtest.h>

#include <cfenv>

namespace drag = millfoam::drag;

namespace {

/// Slurry with 30 % solids by mass.
constexpr drag::BinghamSlurry slurry{0.16, 0.0014};
constexpr double cap = 1.4;

}  // namespace

TEST(PoreViscosity, ShearRateIsThatOfATubeOfThePoresHydraulicDiameter) {
  const double phi = 0.55, slip = 0.1, d = 5e-3;
  const double hydraulic_diameter = 4 * (1 - phi) / (6 * phi / d);
  EXPECT_NEAR(drag::pore_shear_rate(phi, slip, d), 8 * slip / hydraulic_diameter, 1e-10);
  EXPECT_NEAR(drag::pore_shear_rate(phi, slip, d), 290, 5);
}

TEST(PoreViscosity, OfA30PerCentSlurryInABedAtATenthOfAMetrePerSecond) {
  const double rate = drag::pore_shear_rate(0.55, 0.1, 5e-3);
  EXPECT_NEAR(drag::pore_viscosity(slurry, rate, cap) / slurry.plastic_viscosity, 1.4, 0.02);
}

TEST(PoreViscosity, IsTheCapAtRestWithoutDividingByTheRate) {
  // OpenFOAM traps these exceptions.
  for (double rate : {0.0, 1e-300, 1e-10}) {
    std::feclearexcept(FE_ALL_EXCEPT);
    EXPECT_EQ(drag::pore_viscosity(slurry, rate, cap), cap) << rate;
    EXPECT_EQ(drag::pore_viscosity(slurry, rate, slurry.plastic_viscosity), slurry.plastic_viscosity) << rate;
    EXPECT_EQ(std::fetestexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW), 0) << rate;
  }
}

TEST(PoreViscosity, FallsContinuouslyFromTheCapToThePlasticViscosity) {
  const double capped_until = slurry.yield_stress / (cap - slurry.plastic_viscosity);
  EXPECT_EQ(drag::pore_viscosity(slurry, 0.999 * capped_until, cap), cap);
  EXPECT_NEAR(drag::pore_viscosity(slurry, capped_until * (1 + 1e-9), cap), cap, 1e-8);
  double last = cap;
  for (double rate = 1.01 * capped_until; rate < 1e9; rate *= 2) {
    const double viscosity = drag::pore_viscosity(slurry, rate, cap);
    EXPECT_LT(viscosity, last) << rate;
    EXPECT_GE(viscosity, slurry.plastic_viscosity) << rate;
    last = viscosity;
  }
  EXPECT_NEAR(last, slurry.plastic_viscosity, 1e-8);
}

TEST(PoreViscosity, OfANewtonianFluidIsItsOwnAtEveryRate) {
  for (double rate : {0.0, 1e-12, 1.0, 1e6})
    EXPECT_EQ(drag::pore_viscosity({0, 1e-3}, rate, 1), 1e-3) << rate;
}
