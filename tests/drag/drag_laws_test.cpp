// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/drag/drag_laws.hpp"

#include <gtest/gtest.h>

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
std::vector<Point> published_points() {
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

bool is_built(const std::string& name) {
  for (const drag::Law& law : drag::laws())
    if (law.name == name) return true;
  return false;
}

constexpr drag::Fluid water{1000, 1e-3};

}  // namespace

TEST(DragLaws, ReproduceThePublishedPointsToTenDigits) {
  std::map<std::string, int> checked;
  for (const Point& point : published_points()) {
    if (!is_built(point.law)) continue;
    const double factor = drag::find_law(point.law).factor(point.phi, point.re);
    EXPECT_NEAR(factor / point.factor, 1, 1e-10) << point.law << " phi " << point.phi << " Re " << point.re;
    const double beta = drag::exchange_from_factor(point.phi, 5e-3, 1e-3, factor);
    EXPECT_NEAR(beta / point.beta, 1, 1e-10) << point.law << " phi " << point.phi << " Re " << point.re;
    ++checked[point.law];
  }
  for (const drag::Law& law : drag::laws()) EXPECT_GE(checked[std::string(law.name)], 48) << law.name;
}

TEST(DragLaws, TendToStokesDragOfOneSphereWhenDiluteAndSlow) {
  for (const char* name : {"WenYu", "ErgunWenYu", "Hill", "Benyahia", "Beetstra"}) {
    const drag::Law& law = drag::find_law(name);
    EXPECT_NEAR(law.factor(1e-12, 1e-12), 1, 1e-5) << name;
    EXPECT_NEAR(law.factor(0, 0), 1, 1e-14) << name;
  }
  EXPECT_EQ(drag::ergun(0, 0), 0);
}

TEST(DragLaws, ViscousValuesAtHalfSolidity) {
  EXPECT_NEAR(drag::ergun(0.5, 0), 33.33, 0.005);
  EXPECT_NEAR(drag::hill(0.5, 0), 40, 1e-12);
  EXPECT_NEAR(drag::benyahia(0.5, 0), 40, 1e-12);
  EXPECT_NEAR(drag::beetstra(0.5, 0), 41.03, 0.005);
  EXPECT_NEAR(drag::wen_yu(0.5, 0), 25.11, 0.005);
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
