// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/drag/drag_laws.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

namespace drag = millfoam::drag;

namespace {

struct Point {
  std::string law;
  double phi, re, factor, beta;
};

/// Values computed independently of this code, to 12 digits; beta for mu 1e-3 Pa s, d 5 mm.
std::vector<Point> independent_points() {
  std::ifstream file(TEST_DATA_DIR "/drag_points.csv");
  std::string line;
  std::getline(file, line);
  std::vector<Point> points;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    Point point;
    words >> point.law >> point.phi >> point.re >> point.factor >> point.beta;
    EXPECT_FALSE(words.fail()) << line;
    points.push_back(point);
  }
  return points;
}

constexpr drag::Fluid water{1000, 1e-3};

}  // namespace

TEST(DragLaws, AgreeWithAnIndependentEvaluationToTenDigits) {
  std::map<std::string, int> checked;
  for (const Point& point : independent_points()) {
    const double factor = drag::find_law(point.law).factor(point.phi, point.re);
    EXPECT_NEAR(factor / point.factor, 1, 1e-10) << point.law << " phi " << point.phi << " Re " << point.re;
    const double beta = drag::exchange_from_factor(point.phi, 5e-3, 1e-3, factor);
    EXPECT_NEAR(beta / point.beta, 1, 1e-10) << point.law << " phi " << point.phi << " Re " << point.re;
    ++checked[point.law];
  }
  for (const drag::Law& law : drag::laws()) {
    // Darcy is Ergun's viscous part, compared with Ergun below.
    if (law.name == "Darcy") continue;
    EXPECT_GE(checked[std::string(law.name)], 48) << law.name;
  }
}

TEST(DragLaws, DarcyIsErgunWithoutInertiaAndFiveSixthsOfKozenyCarman) {
  for (double phi : {0.0, 0.1, 0.5, 0.634})
    for (double re : {0.0, 1.0, 1e3}) {
      EXPECT_EQ(drag::darcy(phi, re), drag::ergun(phi, 0));
      EXPECT_NEAR(drag::darcy(phi, re), 5.0 / 6.0 * drag::kozeny_carman(phi, re), 1e-13);
    }
}

TEST(DragLaws, TendToStokesDragOfOneSphereWhenDiluteAndSlow) {
  for (const char* name : {"WenYu", "ErgunWenYu", "Hill", "Benyahia", "Beetstra", "Tang"}) {
    const drag::Law& law = drag::find_law(name);
    EXPECT_NEAR(law.factor(1e-12, 1e-12), 1, 1e-5) << name;
    EXPECT_NEAR(law.factor(0, 0), 1, 1e-14) << name;
  }
  // Its 0.48 phi^(1/3) comes down to 1e-5 only here
  EXPECT_NEAR(drag::tenneti(1e-15, 1e-12), 1, 1e-5);
  EXPECT_NEAR(drag::tenneti(0, 0), 1, 1e-14);
}

TEST(DragLaws, DallavallesSphereIsFourPerCentBelowStokesWhenSlow) {
  for (const auto law : {drag::di_felice, drag::rong}) {
    EXPECT_NEAR(law(0, 0), 0.96, 1e-14);
    EXPECT_NEAR(law(1e-12, 1e-12), 0.96, 1e-5);
  }
}

TEST(DragLaws, LawsOfPackedBedsVanishWithTheBalls) {
  for (const auto law : {drag::ergun, drag::fand, drag::kozeny_carman, drag::darcy}) {
    EXPECT_EQ(law(0, 0), 0);
    EXPECT_NEAR(law(1e-12, 1e-12), 0, 1e-10);
  }
}

TEST(DragLaws, ViscousValuesAtHalfSolidity) {
  EXPECT_NEAR(drag::ergun(0.5, 0), 33.33, 0.005);
  EXPECT_NEAR(drag::hill(0.5, 0), 40, 1e-12);
  EXPECT_NEAR(drag::benyahia(0.5, 0), 40, 1e-12);
  EXPECT_NEAR(drag::beetstra(0.5, 0), 41.03, 0.005);
  EXPECT_NEAR(drag::wen_yu(0.5, 0), 25.11, 0.005);
  EXPECT_NEAR(drag::tang(0.5, 0), 41.03, 0.005);
  EXPECT_NEAR(drag::tenneti(0.5, 0), 37.34, 0.005);
  EXPECT_NEAR(drag::rong(0.5, 0), 30.19, 0.005);
  EXPECT_NEAR(drag::di_felice(0.5, 0), 24.95, 0.005);
  EXPECT_NEAR(drag::kozeny_carman(0.5, 0), 40, 1e-12);
}

TEST(DragLaws, DragOfAFluidWithoutViscosityIsZeroAtRest) {
  // What thickens with the shear rate has no viscosity at rest; OpenFOAM stops at 0/0
  const drag::Fluid thickening{1239, 0};
  std::feclearexcept(FE_ALL_EXCEPT);
  EXPECT_EQ(drag::reynolds(0.5, 0, 5e-3, thickening), 0);
  for (const drag::Law& law : drag::laws())
    EXPECT_EQ(drag::exchange_coefficient(law, 0.5, 0, 5e-3, thickening), 0) << law.name;
  EXPECT_EQ(std::fetestexcept(FE_DIVBYZERO | FE_INVALID), 0);
  EXPECT_DOUBLE_EQ(drag::reynolds(0.5, 0.2, 5e-3, water), 500);
}

TEST(DragLaws, TangIsNegativeFarBeyondItsRange) {
  for (const auto& [phi, from] :
       {std::pair{0.6, 34900.0}, std::pair{0.65, 10600.0}, std::pair{0.7, 5470.0}}) {
    EXPECT_GT(drag::tang(phi, 0.99 * from), 0) << phi;
    EXPECT_LT(drag::tang(phi, 1.01 * from), 0) << phi;
  }
  for (double phi : {1e-6, 1e-3, 0.01, 0.049}) EXPECT_GT(drag::tang(phi, 9e4), 0) << phi;
  for (double phi : {0.05, 0.3, 0.52}) EXPECT_GT(drag::tang(phi, 1e9), 0) << phi;
}

TEST(DragLaws, FandIsContinuousAcrossItsGapsAndRisesInThem) {
  for (double phi : {0.3, 0.55, 0.634}) {
    for (double end : {2.3, 5.0, 80.0, 120.0}) {
      const double below = drag::fand(phi, end * (1 - 1e-9)), above = drag::fand(phi, end * (1 + 1e-9));
      EXPECT_NEAR(above / below, 1, 1e-8) << phi << " " << end;
    }
    for (const auto& [from, to] : {std::pair{2.3, 5.0}, std::pair{80.0, 120.0}}) {
      const double middle = drag::fand(phi, std::sqrt(from * to));
      EXPECT_NEAR(middle, (drag::fand(phi, from) + drag::fand(phi, to)) / 2, 1e-12 * middle) << phi;
      EXPECT_LT(drag::fand(phi, from), drag::fand(phi, to)) << phi;
    }
  }
}

TEST(DragLaws, NoneDividesByZeroOrOverflowsFromRestOn) {
  // OpenFOAM traps these exceptions.
  for (const drag::Law& law : drag::laws())
    for (double phi : {0.0, 1e-100, 1e-6, 0.01, 0.0953, 0.3, 0.634, 0.95})
      for (double re : {0.0, 1e-300, 1e-150, 1e-12, 1.0, 1e6, 1e12}) {
        std::feclearexcept(FE_ALL_EXCEPT);
        const double factor = law.factor(phi, re);
        EXPECT_EQ(std::fetestexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW), 0)
            << law.name << " phi " << phi << " Re " << re;
        EXPECT_TRUE(std::isfinite(factor)) << law.name << " phi " << phi << " Re " << re;
      }
}

TEST(DragLaws, ErgunCrossesBeetstraNearReFiftyAtHalfSolidity) {
  double below = 20, above = 100;
  while (above - below > 1e-9) {
    const double middle = (below + above) / 2;
    (drag::ergun(0.5, middle) < drag::beetstra(0.5, middle) ? below : above) = middle;
  }
  EXPECT_NEAR(below, 50.3, 0.05);
  EXPECT_NEAR(drag::ergun(0.5, below), 72.5, 0.1);
}

TEST(DragLaws, HillAndBenyahiaAreContinuousAtTheirSwitch) {
  for (double phi : {0.02, 0.0952, 0.15, 0.3, 0.45, 0.6}) {
    double largest_step = 0;
    for (double re = 0; re < 100; re += 1e-3) {
      largest_step =
          std::max(largest_step, std::abs(drag::benyahia(phi, re + 1e-3) - drag::benyahia(phi, re)));
      largest_step = std::max(largest_step, std::abs(drag::hill(phi, re + 1e-3) - drag::hill(phi, re)));
    }
    const double steepest = drag::hill(phi, 1000) / 1000;
    EXPECT_LT(largest_step, 1e-3 * 20 * steepest) << phi;
  }
}

TEST(DragLaws, NoSolidsGiveNoExchange) {
  for (const drag::Law& law : drag::laws())
    EXPECT_EQ(drag::exchange_coefficient(law, 0, 1, 5e-3, water), 0) << law.name;
}

TEST(DragLaws, PressureGradientOfErgunsBedIsErgunsEquation) {
  const double phi = 0.45, e = 1 - phi, d = 3e-3, superficial = 0.02;
  const double ergun_equation = 150 * 1e-3 * phi * phi * superficial / (e * e * e * d * d) +
                                1.75 * 1000 * phi * superficial * superficial / (e * e * e * d);
  const double slip = superficial / e;
  const double beta = drag::exchange_coefficient(drag::find_law("Ergun"), phi, slip, d, water);
  EXPECT_NEAR(beta * slip / e / ergun_equation, 1, 1e-12);
}

TEST(DragLaws, PolydispersityFactorIsTheSumOverTheSizes) {
  // Three sizes: the force on all balls of a size, at its own F_i, against the whole bed's at the Sauter
  // mean.
  const std::vector<double> share = {0.1, 0.25, 0.15}, diameter = {2e-3, 4e-3, 8e-3};
  double phi = 0, over_d = 0, times_d = 0;
  for (size_t i = 0; i < share.size(); ++i) {
    phi += share[i];
    over_d += share[i] / diameter[i];
    times_d += share[i] * diameter[i];
  }
  const double e = 1 - phi, d32 = phi / over_d, d43 = times_d / phi, factor = 7;
  double beta = 0;  // without 18 mu e^2, as sum of n_i d_i F_i
  for (size_t i = 0; i < share.size(); ++i) {
    const double y = diameter[i] / d32;
    const double factor_of_size = (e * y + phi * y * y + 0.064 * e * y * y * y) * factor;
    beta += share[i] / (diameter[i] * diameter[i]) * factor_of_size;
  }
  EXPECT_NEAR(beta, phi * factor / (d32 * d32) * drag::polydispersity_factor(phi, d32, d43), 1e-12 * beta);
}

TEST(DragLaws, PolydispersityFactorOfOneSizeIsNotOne) {
  EXPECT_NEAR(drag::polydispersity_factor(0.5, 5e-3, 5e-3), 1.032, 1e-14);
}

TEST(DragLaws, UnknownNameListsTheKnownOnes) {
  try {
    drag::find_law("Ergum");
    FAIL() << "an unknown law was accepted";
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("'Ergum'"), std::string::npos);
    for (const drag::Law& law : drag::laws()) EXPECT_NE(message.find(law.name), std::string::npos) << message;
  }
}
