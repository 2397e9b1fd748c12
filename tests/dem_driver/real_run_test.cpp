// SPDX-License-Identifier: GPL-3.0-or-later
// A short run of LIGGGHTS itself: 250 balls in a small drum.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "dem_driver/deck.hpp"
#include "dem_driver/folder_preparation.hpp"
#include "dem_driver/liggghts_run.hpp"
#include "dem_driver/output_check.hpp"
#include "dem_driver/results.hpp"
#include "dem_driver/segments.hpp"
#include "dem_driver/wall_parts.hpp"
#include "millfoam_version.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::small_mill;
using tests::TemporaryFolder;

struct Ball {
  double id = 0, type = 0, x = 0, y = 0, z = 0, vx = 0, vy = 0, vz = 0, radius = 0;
};

struct Snapshot {
  long step = 0;
  std::vector<Ball> balls;
};

Snapshot read_dump(const std::filesystem::path& file) {
  std::ifstream in(file);
  Snapshot snapshot;
  std::size_t count = 0;
  std::string line;
  std::getline(in, line);
  in >> snapshot.step >> std::ws;
  std::getline(in, line);
  in >> count >> std::ws;
  while (std::getline(in, line) && line.rfind("ITEM: ATOMS", 0) != 0) {
  }
  EXPECT_EQ(line.substr(0, 42), "ITEM: ATOMS id type x y z vx vy vz radius ");
  for (Ball b; in >> b.id >> b.type >> b.x >> b.y >> b.z >> b.vx >> b.vy >> b.vz >> b.radius;)
    snapshot.balls.push_back(b);
  EXPECT_EQ(snapshot.balls.size(), count);
  return snapshot;
}

/// The run is done once; every test looks at its own side of it.
class RealRun : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    temporary_ = new TemporaryFolder;
    const CaseFolder folder{temporary_->path()};
    const auto mill = small_mill();
    plan_ = new DemPlan(plan_dem(mill));
    tests::write_drum(folder, mill.geometry);
    prepare_folders(folder);
    std::ofstream deck(folder.deck());
    write_deck(deck, mill, *plan_, find_walls(folder, mill), 1);
    deck.close();
    std::ostringstream progress;
    // The plain program: LIGGGHTS' own leaks are not ours
    const tests::Variable program("MILLFOAM_LIGGGHTS", "liggghts");
    const RunResult run = run_liggghts(folder, *plan_, 1, {progress, false});
    result_ = new Results(gather_results(folder, mill, *plan_, run));
    write_results_files(folder, mill, *plan_, *result_);
    progress_ = new std::string(progress.str());
    snapshots_ = new std::vector<Snapshot>;
    for (const auto& file : find_dumps(folder)) snapshots_->push_back(read_dump(file));
    std::sort(snapshots_->begin(), snapshots_->end(),
              [](const auto& a, const auto& b) { return a.step < b.step; });
  }
  static void TearDownTestSuite() {
    delete snapshots_;
    delete progress_;
    delete result_;
    delete plan_;
    delete temporary_;
  }

  static inline TemporaryFolder* temporary_ = nullptr;
  static inline DemPlan* plan_ = nullptr;
  static inline Results* result_ = nullptr;
  static inline std::string* progress_ = nullptr;
  static inline std::vector<Snapshot>* snapshots_ = nullptr;
};

double centroid_x(const Snapshot& snapshot) {
  double moment = 0;
  double volume = 0;
  for (const auto& b : snapshot.balls) {
    moment += std::pow(b.radius, 3) * b.x;
    volume += std::pow(b.radius, 3);
  }
  return moment / volume;
}

TEST_F(RealRun, EverySnapshotHasEveryBallOfBothSizes) {
  for (const auto& snapshot : *snapshots_) {
    EXPECT_EQ(snapshot.balls.size(), 250u);
    EXPECT_EQ(std::count_if(snapshot.balls.begin(), snapshot.balls.end(),
                            [](const Ball& b) { return std::abs(b.radius - 0.0015) < 1e-12; }),
              150);
  }
}

TEST_F(RealRun, DumpsAreAtWholeIntervalsFromZeroToTheEnd) {
  ASSERT_EQ(static_cast<long>(snapshots_->size()), plan_->dumps);
  for (std::size_t i = 0; i < snapshots_->size(); ++i)
    EXPECT_EQ((*snapshots_)[i].step, static_cast<long>(i) * plan_->step.steps_per_record);
}

TEST_F(RealRun, NoBallIsOutsideTheDrumByMoreThanTheAllowedOverlap) {
  for (const auto& snapshot : *snapshots_)
    for (const auto& b : snapshot.balls)
      EXPECT_LT(std::hypot(b.x, b.y) + b.radius, 0.02 + allowed_overlap_ratio * 2 * b.radius);
}

TEST_F(RealRun, BallsLeaveThePeriodicSliceByNoMoreThanTheNeighbourSkin) {
  // LIGGGHTS carries them to the other side only when it rebuilds its neighbour lists.
  const double skin = 0.4 * 0.002;
  for (const auto& snapshot : *snapshots_)
    for (const auto& b : snapshot.balls) {
      EXPECT_GE(b.z, -skin);
      EXPECT_LE(b.z, 0.012 + skin);
    }
}

TEST_F(RealRun, TheChargeRestsInTheLowerPartAtTimeZero) {
  EXPECT_LT(result_->resting_speed, 0.02);
  double sum = 0;
  for (const auto& b : snapshots_->front().balls) sum += b.y;
  EXPECT_LT(sum / 250, -0.005);
}

TEST_F(RealRun, AClockwiseMillLiftsItsChargeOnTheLeft) {
  double mean = 0;
  for (auto snapshot = snapshots_->end() - 10; snapshot != snapshots_->end(); ++snapshot)
    mean += centroid_x(*snapshot) / 10;
  EXPECT_LT(mean, -0.001);
}

TEST_F(RealRun, SpeedsAreFiniteAndBelowTheExpectedImpact) {
  for (const auto& b : snapshots_->back().balls)
    EXPECT_LT(std::sqrt(b.vx * b.vx + b.vy * b.vy + b.vz * b.vz), expected_impact_speed(small_mill()));
}

double mass(const Ball& b) {
  return 2500 * 4 * 3.14159265358979 / 3 * std::pow(b.radius, 3);
}

/// Moment of the balls' weight about the axis, N m.
double weight_moment(const Snapshot& snapshot) {
  double sum = 0;
  for (const auto& b : snapshot.balls) sum -= mass(b) * meshing::gravity * b.x;
  return sum;
}

double angular_momentum(const Snapshot& snapshot) {
  double sum = 0;
  for (const auto& b : snapshot.balls) sum += mass(b) * (b.x * b.vy - b.y * b.vx);
  return sum;
}

TEST_F(RealRun, TheTorqueOnTheMillIsTheMomentOfTheChargesWeightLessWhatItGainsInAngularMomentum) {
  const auto& history = result_->history;
  ASSERT_EQ(history.size() + 1, snapshots_->size());
  double torque = 0;
  double moment = 0;
  for (std::size_t i = 0; i < history.size(); ++i) {
    torque += history[i].torque;
    moment += (weight_moment((*snapshots_)[i]) + weight_moment((*snapshots_)[i + 1])) / 2;
  }
  const auto records = static_cast<double>(history.size());
  const double gained = angular_momentum(snapshots_->back()) - angular_momentum(snapshots_->front());
  const double expected = moment / records - gained / (records * small_mill().dem.record_interval);
  EXPECT_NEAR(torque / records / expected, 1, 0.05);
}

TEST_F(RealRun, EnergiesAreThoseOfTheDumpedBalls) {
  for (std::size_t i = 0; i < result_->history.size(); ++i) {
    double kinetic = 0;
    double potential = 0;
    for (const auto& b : (*snapshots_)[i + 1].balls) {
      kinetic += mass(b) * (b.vx * b.vx + b.vy * b.vy + b.vz * b.vz) / 2;
      potential += mass(b) * meshing::gravity * b.y;
    }
    EXPECT_NEAR(result_->history[i].kinetic / kinetic, 1, 1e-5);
    EXPECT_NEAR(result_->history[i].potential / potential, 1, 1e-5);
  }
}

TEST_F(RealRun, OverlapsAreCountedAndStayBelowTheExpectedOne) {
  for (const auto* overlaps : {&result_->ball_overlaps, &result_->wall_overlaps}) {
    EXPECT_GT(overlaps->samples, 100);  // at 3 of 30 records
    EXPECT_GT(overlaps->percentile(0.99), 0);
    EXPECT_LE(overlaps->percentile(0.99), overlaps->largest);
    EXPECT_LT(overlaps->largest, plan_->step.overlap.ratio * 0.003);
  }
}

TEST_F(RealRun, TheBooksStandBesideTheDumps) {
  const CaseFolder folder{temporary_->path()};
  std::ifstream charge(folder.charge());
  std::string header;
  std::string first;
  std::getline(charge, header);
  std::getline(charge, first);
  EXPECT_EQ(header, "diameter_m,balls,mass_kg,surface_m2,simulated");
  EXPECT_EQ(first.substr(0, 10), "0.003,150,");
  for (const auto& file : {folder.results(), folder.energy(), folder.overlaps()})
    EXPECT_TRUE(std::filesystem::exists(file)) << file;
}

TEST_F(RealRun, TheResultsAreDataWithUnits) {
  const auto results = tests::read_json(CaseFolder{temporary_->path()}.results());
  EXPECT_EQ(results["format"], "millfoam-charge");
  EXPECT_EQ(results["program"], std::string("millDem ") + version());
  EXPECT_EQ(results["liggghts"].get<std::string>().find("LIGGGHTS"), 0u) << results["liggghts"];
  EXPECT_EQ(results["sense"], "clockwise");
  EXPECT_EQ(results["balls"], 250);
  EXPECT_EQ(results["lost_balls"], 0);
  EXPECT_EQ(results["steps"], plan_->total_steps());
  EXPECT_EQ(results["smallest_diameter_m"], 0.002);
  EXPECT_EQ(results["largest_diameter_m"], 0.003);
  EXPECT_EQ(results["power_W"], result_->power_steadiness.mean);
  EXPECT_TRUE(results["power_error_W"].is_null()) << "30 records are too few to know it";
  EXPECT_EQ(results["steady"], result_->steady());
  EXPECT_EQ(results["ball_overlap_99_m"], result_->ball_overlaps.percentile(0.99));
  EXPECT_NEAR(results["duration_s"], 0.3, 1e-9);
  for (const char* key :
       {"timestep_s", "modulus_Pa", "wall_time_s", "wall_overlap_largest_m", "resting_speed_m_s"})
    EXPECT_GT(results[key], 0) << key;
}

TEST_F(RealRun, AllThatLiggghtsWroteIsWhole) {
  const CaseFolder folder{temporary_->path()};
  for (const auto& dump : find_dumps(folder)) EXPECT_EQ(dump_complaint(dump, 250), "") << dump;
  const auto restarts = find_restarts(folder);
  ASSERT_EQ(restarts.size(), 1u);
  EXPECT_EQ(restart_complaint(restarts[0].file, 250), "");
  EXPECT_NE(restart_complaint(restarts[0].file, 249), "");
  EXPECT_EQ(last_good_restart(folder, *plan_), plan_->turning_steps);
}

TEST_F(RealRun, ARestartFileOfLiggghtsThatIsCutIsToldWhereverItIsCut) {
  const auto file = temporary_->path() / "cut";
  std::filesystem::copy_file(find_restarts({temporary_->path()}).at(0).file, file);
  for (auto size = std::filesystem::file_size(file); size > 0; size -= std::min<std::uintmax_t>(size, 4096)) {
    std::filesystem::resize_file(file, size - 1);
    EXPECT_NE(restart_complaint(file, 250), "") << size - 1;
  }
}

TEST_F(RealRun, ProgressIsALineEveryTenPercentUpToTheEnd) {
  EXPECT_EQ(std::count(progress_->begin(), progress_->end(), '\n'), 11) << *progress_;
  EXPECT_NE(progress_->find("100 %"), std::string::npos);
}

TEST(HardBalls, OfAModulusThatLiggghtsRefusesByDefaultRunToTheEnd) {
  const TemporaryFolder temporary;
  const CaseFolder folder{temporary.path()};
  auto mill = small_mill();
  mill.charge.classes = {mill.charge.classes.back()};
  mill.charge.classes[0].mass /= 10;
  mill.dem.youngs_modulus = 1.1e9;
  mill.dem.settle_time = 0.001;
  mill.dem.duration = 0.002;
  mill.dem.record_interval = 0.001;
  const DemPlan plan = plan_dem(mill);
  tests::write_drum(folder, mill.geometry);
  prepare_folders(folder);
  std::ofstream deck(folder.deck());
  write_deck(deck, mill, plan, find_walls(folder, mill), 1);
  deck.close();
  std::ostringstream progress;
  const tests::Variable program("MILLFOAM_LIGGGHTS", "liggghts");
  EXPECT_EQ(run_liggghts(folder, plan, 1, {progress, false}).balls, 15);
}

}  // namespace
}  // namespace millfoam::dem_driver
