// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/plan_report.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "meshing/mill/mill_shape.hpp"
#include "millfoam_version.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::small_mill;
using tests::TemporaryFolder;

class PlanReport : public ::testing::Test {
 protected:
  nlohmann::json written(const meshing::Mill& mill, const std::optional<MeasuredForecast>& measured = {}) {
    write_plan_file(file_, mill, plan_dem(mill), measured);
    return tests::read_json(file_);
  }
  TemporaryFolder temporary_;
  std::filesystem::path file_ = temporary_.path() / "plan.json";
};

std::string printed(double angular_velocity) {
  auto mill = small_mill();
  mill.angular_velocity = angular_velocity;
  std::ostringstream out;
  print_plan(out, mill, plan_dem(mill));
  return out.str().substr(0, out.str().find('\n'));
}

TEST_F(PlanReport, TheHeaderNamesTheSenseOfRotation) {
  EXPECT_EQ(printed(-12),
            "mill: 0.04 m in diameter, 0.012 m long, turns clockwise seen with x to the right and y up, "
            "-12 rad/s (54.2 % of the critical speed)");
  EXPECT_NE(printed(12).find("turns anticlockwise seen with x to the right and y up, 12 rad/s"),
            std::string::npos);
  EXPECT_NE(printed(0).find("at rest"), std::string::npos);
}

TEST_F(PlanReport, TheFileHasWhatDeckAndStepAreMadeFrom) {
  const auto mill = small_mill();
  const DemPlan plan = plan_dem(mill);
  const auto json = written(mill);
  EXPECT_EQ(json["format"], "millfoam-dem-plan");
  EXPECT_EQ(json["program"], std::string("millDem ") + version());
  EXPECT_EQ(json["steps"], plan.total_steps());
  EXPECT_EQ(json["timestep_s"], plan.step.value);
  EXPECT_EQ(json["dumps"], 31);
  ASSERT_EQ(json["limits"].size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(json["limits"][i]["name"], std::vector<std::string>({"rayleigh", "contact", "overlap"}).at(i));
    EXPECT_EQ(json["limits"][i]["timestep_s"], plan.step.limits[i].value);
  }
  EXPECT_EQ(json["expected_overlap"]["ratio"], plan.step.overlap.ratio);
  EXPECT_EQ(json["softness"].size(), softness_table(mill).size());
  EXPECT_FALSE(json.contains("wall_time_s"));
}

TEST_F(PlanReport, FinesAreNamedWithTheirShareAndLeftOutOfTheLoad) {
  auto mill = small_mill();
  mill.charge.fines_below = 0.0025;
  const auto json = written(mill);
  const double fines = mill.charge.classes[0].mass, coarse = mill.charge.classes[1].mass;
  const double bulk = 0.6 * mill.ball.density * meshing::analytic_volume(mill.geometry);
  EXPECT_EQ(json["balls"], 150);
  EXPECT_NEAR(json["fines_mass_kg"], fines, 1e-12);
  EXPECT_NEAR(json["fines_share"], fines / (fines + coarse), 1e-12);
  EXPECT_NEAR(json["load"], coarse / bulk, 1e-9);
  EXPECT_NEAR(json["asked_load"], (fines + coarse) / bulk, 1e-9);
  ASSERT_EQ(json["classes"].size(), 2u);
  EXPECT_EQ(json["classes"][0]["simulated"], true);
  EXPECT_EQ(json["classes"][1]["simulated"], false);
  EXPECT_EQ(json["classes"][1]["diameter_m"], 0.002);
  EXPECT_EQ(json["classes"][1]["balls"], 100);
}

TEST_F(PlanReport, AForecastStandsInTheFileWithItsUnits) {
  const auto mill = small_mill();
  const Cost cost{1e5, 80, 5e7};
  const Forecast forecast_ = forecast(plan_dem(mill), cost, 2);
  const auto json = written(mill, MeasuredForecast{forecast_, cost, 2});
  EXPECT_EQ(json["wall_time_s"], forecast_.wall_time);
  EXPECT_EQ(json["disk_bytes"], forecast_.disk);
  EXPECT_EQ(json["memory_bytes"], forecast_.memory);
  EXPECT_EQ(json["rate_balls_steps_per_s"], 1e5);
  EXPECT_EQ(json["ranks"], 2);
}

}  // namespace
}  // namespace millfoam::dem_driver
