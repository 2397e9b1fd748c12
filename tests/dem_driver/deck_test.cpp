// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/deck.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "meshing/mill/mill_charge.hpp"
#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::message_of;
using tests::small_mill;

std::string deck_of(const meshing::Mill& mill, const std::vector<std::string>& parts = {"shell"},
                    int ranks = 1) {
  std::ostringstream out;
  write_deck(out, mill, plan_dem(mill), parts, ranks);
  return out.str();
}

bool has_line(const std::string& deck, const std::string& wanted) {
  std::istringstream in(deck);
  for (std::string line; std::getline(in, line);)
    if (line == wanted) return true;
  return false;
}

/// All words that follow `word` in the deck.
std::vector<std::string> after(const std::string& deck, const std::string& word) {
  std::istringstream in(deck);
  std::vector<std::string> found;
  for (std::string last, now; in >> now; last = now)
    if (last == word) found.push_back(now);
  return found;
}

TEST(Deck, APeriodicSliceIsPeriodicAlongTheAxisFromZeroToItsLength) {
  const std::string deck = deck_of(small_mill());
  EXPECT_TRUE(has_line(deck, "boundary f f p"));
  EXPECT_NE(deck.find(" 0 0.012 units box"), std::string::npos);
}

TEST(Deck, AMillWithPlainEndsIsClosedAndItsBoxReachesBeyondTheEnds) {
  auto mill = small_mill();
  mill.geometry.ends = meshing::Ends::plain;
  const std::string deck = deck_of(mill, {"shell", "feedEnd", "dischargeEnd"});
  EXPECT_TRUE(has_line(deck, "boundary f f f"));
  EXPECT_NE(deck.find(" -0.0008 0.0128 units box"), std::string::npos);
}

TEST(Deck, LiggghtsIsToldThatAModulusAboveItsLimitIsMeant) {
  auto mill = small_mill();
  mill.dem.youngs_modulus = largest_soft_modulus;
  EXPECT_FALSE(has_line(deck_of(mill), "hard_particles yes"));
  mill.dem.youngs_modulus = 1.1e9;
  const std::string deck = deck_of(mill);
  EXPECT_TRUE(has_line(deck, "hard_particles yes"));
  EXPECT_LT(deck.find("hard_particles"), deck.find("pair_style"));
  std::ostringstream resumed;
  write_resume_deck(resumed, mill, plan_dem(mill), {"shell"}, 1, 400);
  EXPECT_TRUE(has_line(resumed.str(), "hard_particles yes"));
}

/// A stirred mill of the size of the small drum.
meshing::Mill stirred_mill() {
  auto mill = small_mill();
  mill.geometry.ends = meshing::Ends::plain;
  mill.geometry.length = 0.06;
  mill.geometry.impeller = meshing::Impeller{0.008, 0.004, {{0.012, 0.03, 0.004, 0, 2}}};
  mill.charge.start_radius = 0.0195;
  mill.charge.start_core = 0.0045;
  mill.charge.start_bottom = 0.0145;
  mill.charge.start_length = 0.045;
  return mill;
}

TEST(Deck, OfAStirredMillTheImpellerAloneTurnsUnderGravityAlongTheAxis) {
  const std::string deck = deck_of(stirred_mill(), {"impeller", "shell", "base", "lid"});
  EXPECT_NE(deck.find("gravity 9.81 vector 0 0 -1\n"), std::string::npos);
  EXPECT_NE(deck.find("fix turn_impeller all move/mesh mesh impeller"), std::string::npos);
  EXPECT_EQ(deck.find("turn_shell"), std::string::npos);
  EXPECT_TRUE(has_line(deck, "variable height atom mass*9.81*z"));
  EXPECT_TRUE(has_line(deck, "variable torque equal 0+f_impeller[6]"));
  EXPECT_NE(deck.find(" f_impeller[6] f_shell[6] f_base[6] f_lid[6] file partTorques.0.txt\n"),
            std::string::npos);
}

TEST(Deck, RanksSplitAStirredMillAcrossItsAxis) {
  std::ostringstream out;
  const auto mill = stirred_mill();
  write_deck(out, mill, plan_dem(mill), {"impeller", "shell", "base", "lid"}, 6);
  EXPECT_TRUE(has_line(out.str(), "processors 2 3 1"));
}

TEST(Deck, OfAStirredMillBallsAreReleasedAroundTheShaftAboveThePins) {
  const std::string deck = deck_of(stirred_mill(), {"impeller", "shell", "base", "lid"});
  // The largest balls have a diameter of 3 mm
  EXPECT_TRUE(has_line(deck, "region around1 cylinder z 0 0 0.018 0.016 0.058 units box"));
  EXPECT_TRUE(has_line(deck, "region core1 cylinder z 0 0 0.006 0.0145 0.061 side out units box"));
  EXPECT_TRUE(has_line(deck, "region start1 intersect 2 around1 core1"));
}

/// The small drum whose balls of 3 mm are superquadrics.
meshing::Mill mill_with_shapes() {
  auto mill = small_mill();
  mill.charge.classes.back().shape = meshing::scaled_to({{1.5, 1, 1}, 4}, 0.003);
  mill.dem.curvature_limit = 10;
  return mill;
}

TEST(Deck, ABallOfAnotherShapeMakesAllOfThemSuperquadrics) {
  const std::string deck = deck_of(mill_with_shapes());
  EXPECT_TRUE(has_line(deck, "atom_style superquadric"));
  const std::string model = "gran model hertz tangential history rolling_friction cdt surface superquadric";
  const std::string settings = "curvatureLimitFactor 10 meanCurvature yes";
  EXPECT_TRUE(has_line(deck, "pair_style " + model + ' ' + settings));
  EXPECT_TRUE(has_line(deck, "fix walls all wall/" + model + " mesh n_meshes 1 meshes shell " + settings));
  EXPECT_EQ(deck.find("particletemplate/sphere"), std::string::npos);
  // The balls of 2 mm
  EXPECT_NE(deck.find("shape constant 0.001 0.001 0.001 blockiness constant 2 2\n"), std::string::npos);
  EXPECT_NE(deck.find("blockiness constant 4 4\n"), std::string::npos);
  EXPECT_NE(deck.find("orientation random region"), std::string::npos);
  EXPECT_TRUE(has_line(deck, "fix motion all nve/superquadric integration_scheme 1"));
  EXPECT_NE(deck.find("radius shapex shapey shapez blockiness1 blockiness2 quat1 quat2 quat3 quat4\n"),
            std::string::npos);
  EXPECT_EQ(after(deck, "\"%d").size(), 1U);
}

TEST(Deck, ARunOfSuperquadricsResumesAsOne) {
  const auto mill = mill_with_shapes();
  std::ostringstream deck;
  write_resume_deck(deck, mill, plan_dem(mill), {"shell"}, 1, 500);
  EXPECT_TRUE(has_line(deck.str(), "atom_style superquadric"));
  EXPECT_TRUE(has_line(deck.str(), "fix motion all nve/superquadric integration_scheme 1"));
}

TEST(Deck, EveryPartIsAWallAndEveryPartTurns) {
  const std::string deck = deck_of(small_mill(), {"shell", "lifters", "feedEnd"});
  EXPECT_EQ(after(deck, "n_meshes"), std::vector<std::string>{"3"});
  EXPECT_NE(deck.find("meshes shell lifters feedEnd\n"), std::string::npos);
  for (const std::string part : {"shell", "lifters", "feedEnd"}) {
    EXPECT_NE(deck.find("mesh/surface/stress file ../walls/" + part + ".stl type 2"), std::string::npos);
    EXPECT_NE(deck.find("move/mesh mesh " + part + " rotate"), std::string::npos);
  }
}

TEST(Deck, ANegativeSpeedTurnsAboutMinusZWithAPositivePeriod) {
  const std::string deck = deck_of(small_mill());
  EXPECT_NE(deck.find("rotate origin 0 0 0 axis 0 0 -1 period 0.523598775598299"), std::string::npos) << deck;
}

TEST(Deck, APositiveSpeedTurnsAboutPlusZ) {
  auto mill = small_mill();
  mill.angular_velocity = 12;
  EXPECT_NE(deck_of(mill).find("axis 0 0 1 period 0.5235"), std::string::npos);
}

TEST(Deck, AMillAtRestHasNoMovingMesh) {
  auto mill = small_mill();
  mill.angular_velocity = 0;
  EXPECT_EQ(deck_of(mill).find("move/mesh"), std::string::npos);
}

TEST(Deck, TheClockIsSetBackBeforeTheMillTurnsAndTheDumpsBegin) {
  const std::string deck = deck_of(small_mill());
  const auto reset = deck.find("reset_timestep 0");
  EXPECT_NE(reset, std::string::npos);
  EXPECT_LT(deck.rfind("insert/pack"), reset);
  EXPECT_GT(deck.find("move/mesh"), reset);
  EXPECT_GT(deck.find("dump balls"), reset);
}

TEST(Deck, TheFolderOfTheDumpsIsMadeByTheDeckWhichMayBeRunAlone) {
  auto mill = small_mill();
  const std::string deck = deck_of(mill);
  EXPECT_TRUE(has_line(deck, "shell mkdir ../dumps"));
  EXPECT_LT(deck.find("shell mkdir ../dumps"), deck.find("dump balls"));
  std::ostringstream resumed;
  write_resume_deck(resumed, mill, plan_dem(mill), {"shell"}, 1, 400);
  EXPECT_TRUE(has_line(resumed.str(), "shell mkdir ../dumps"));
  mill.dem.dumps = false;
  EXPECT_FALSE(has_line(deck_of(mill), "shell mkdir ../dumps"));
}

TEST(Deck, TheTurningRunIsAWholeNumberOfDumpIntervals) {
  const auto mill = small_mill();
  const DemPlan plan = plan_dem(mill);
  EXPECT_EQ(plan.dumps, 31);
  EXPECT_EQ(plan.turning_steps, 30 * plan.step.steps_per_record);
  EXPECT_NE(deck_of(mill).find("run " + std::to_string(plan.turning_steps) + " upto"), std::string::npos);
}

TEST(Deck, ADurationThatIsNotAWholeNumberOfRecordsIsRoundedUp) {
  auto mill = small_mill();
  mill.dem.duration = 0.295;
  EXPECT_EQ(plan_dem(mill).dumps, 31);
}

TEST(Deck, TheRunCommandsAddUpToTheStepsThatProgressCounts) {
  auto mill = small_mill();
  for (auto& size : mill.charge.classes) size.mass *= 2;
  long sum = 0;
  for (const auto& steps : after(deck_of(mill), "run")) sum += std::atol(steps.c_str());
  EXPECT_EQ(sum, plan_dem(mill).total_steps());
}

TEST(Deck, PairPropertiesAreBallsFirstWallsSecond) {
  const std::string deck = deck_of(small_mill());
  EXPECT_NE(deck.find("coefficientRestitution peratomtypepair 2 0.8 0.7 0.7 0.7\n"), std::string::npos);
  EXPECT_NE(deck.find("coefficientFriction peratomtypepair 2 0.5 0.4 0.4 0.4\n"), std::string::npos);
  EXPECT_NE(deck.find("coefficientRollingFriction peratomtypepair 2 0.01 0.02 0.02 0.02\n"),
            std::string::npos);
  EXPECT_NE(deck.find("youngsModulus peratomtype 5000000 5000000\n"), std::string::npos);
  EXPECT_NE(deck.find("poissonsRatio peratomtype 0.25 0.3\n"), std::string::npos);
}

TEST(Deck, EveryRandomStreamHasItsOwnPrimeAboveTenThousand) {
  const std::string deck = deck_of(small_mill());
  std::vector<std::string> seeds = after(deck, "seed");
  for (const char* style : {"particletemplate/sphere", "particledistribution/discrete"})
    for (const auto& seed : after(deck, style)) seeds.push_back(seed);
  EXPECT_EQ(static_cast<long>(seeds.size()), 3 * plan_dem(small_mill()).insertions());
  EXPECT_EQ(std::set<std::string>(seeds.begin(), seeds.end()).size(), seeds.size());
  for (const auto& text : seeds) {
    const long seed = std::atol(text.c_str());
    EXPECT_GT(seed, 10000);
    for (long divisor = 2; divisor * divisor <= seed; ++divisor) EXPECT_NE(seed % divisor, 0) << seed;
  }
}

TEST(Deck, ATitleOfTwoLinesIsNoCommand) {
  meshing::Mill mill = small_mill();
  mill.title = "drum\nquit";
  EXPECT_FALSE(has_line(deck_of(mill), "quit"));
}

TEST(Deck, TwoSeedsHaveNoRandomStreamInCommon) {
  meshing::Mill mill = small_mill();
  std::set<std::string> streams;
  std::size_t count = 0;
  for (const int seed : {1, 2, 100000}) {
    mill.dem.seed = seed;
    for (const auto& stream : after(deck_of(mill), "seed")) {
      streams.insert(stream);
      ++count;
    }
  }
  EXPECT_EQ(streams.size(), count);
}

TEST(Deck, RollingFrictionIsAConstantDirectionalTorqueForBallsAndWallsAlike) {
  const std::string deck = deck_of(small_mill());
  const std::string model = "gran model hertz tangential history rolling_friction cdt";
  EXPECT_TRUE(has_line(deck, "pair_style " + model));
  EXPECT_NE(deck.find("wall/" + model + " mesh"), std::string::npos);
}

TEST(Deck, NoBallMovesWhileBallsAreInserted) {
  auto mill = small_mill();
  for (auto& size : mill.charge.classes) size.mass *= 2;
  std::istringstream in(deck_of(mill));
  bool moving = false;
  int insertions = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("fix motion", 0) == 0) moving = true;
    if (line == "unfix motion") moving = false;
    if (line.find("insert/pack") == std::string::npos) continue;
    ++insertions;
    EXPECT_FALSE(moving) << line;
  }
  EXPECT_GT(insertions, 2);
  EXPECT_TRUE(moving);
}

TEST(Deck, RanksSplitTheAxisAsOftenAsLeavesEachOneAndAHalfBalls) {
  EXPECT_TRUE(has_line(deck_of(small_mill(), {"shell"}, 2), "processors 1 1 2"));
  EXPECT_TRUE(has_line(deck_of(small_mill(), {"shell"}, 6), "processors 1 3 2"));
  EXPECT_TRUE(has_line(deck_of(small_mill(), {"shell"}, 7), "processors 1 7 1"));
  auto mill = small_mill();
  mill.geometry.length = 0.12;
  EXPECT_TRUE(has_line(deck_of(mill, {"shell"}, 6), "processors 1 1 6"));
}

TEST(Deck, RanksAreAWholeNumberFromOneOn) {
  EXPECT_EQ(read_ranks("1"), 1);
  EXPECT_EQ(read_ranks("24"), 24);
  for (const std::string word : {"0", "-1", "x", "2x", "1.5", "", "99999999999"})
    EXPECT_EQ(message_of([&] { read_ranks(word); }), "-np " + word + ": expected a whole number from 1 on");
}

TEST(Deck, SofterSmallBallsAreATypeOfTheirOwnAndTheWallIsTheLast) {
  auto mill = small_mill();
  mill.dem.youngs_modulus = 2e7;
  mill.dem.soften_below = 0.003;
  const std::string deck = deck_of(mill);
  EXPECT_NE(deck.find("create_box 3 box"), std::string::npos);
  EXPECT_NE(deck.find("youngsModulus peratomtype 20000000 7257747.38"), std::string::npos) << deck;
  EXPECT_NE(deck.find("poissonsRatio peratomtype 0.25 0.25 0.3\n"), std::string::npos);
  EXPECT_NE(deck.find("coefficientFriction peratomtypepair 3 0.5 0.5 0.4 0.5 0.5 0.4 0.4 0.4 0.4\n"),
            std::string::npos);
  EXPECT_NE(deck.find("shell.stl type 3"), std::string::npos);
  EXPECT_EQ(after(deck, "atom_type"), (std::vector<std::string>{"1", "2", "2"}));
}

TEST(Deck, TheNeighbourSkinGrowsWithTheRangeOfSizes) {
  auto mill = small_mill();
  mill.geometry.diameter = 0.1;
  mill.geometry.length = 0.03;
  mill.charge.start_radius = 0.045;
  const auto skin = [&](double largest) {
    mill.charge.classes.back() = {largest, meshing::ball_mass(mill, largest)};
    return after(deck_of(mill), "neighbor").front();
  };
  EXPECT_EQ(skin(0.004), "0.0008");
  EXPECT_EQ(skin(0.012), "0.0012");
  EXPECT_EQ(skin(0.028), "0.002");
}

TEST(Deck, TheNeighbourSkinIsThatOfTheMeasurements) {
  auto mill = small_mill();
  const auto skin_over_smallest = [&](double smallest, double largest) {
    mill.charge.classes = {{largest, meshing::ball_mass(mill, largest)},
                           {smallest, meshing::ball_mass(mill, smallest)}};
    return std::stod(after(deck_of(mill), "neighbor").front()) / smallest;
  };
  EXPECT_NEAR(skin_over_smallest(0.002, 0.008), 0.4, 1e-12);
  EXPECT_NEAR(skin_over_smallest(0.00125, 0.01), 0.8, 1e-12);
}

TEST(Deck, ARestartFileGetsItsNameWhenItIsWhole) {
  const std::string deck = deck_of(small_mill());
  const auto part = deck.find("write_restart restart.part");
  EXPECT_NE(part, std::string::npos);
  EXPECT_GT(deck.find("shell mv restart.part restart.${now}"), part);
}

TEST(Deck, RestartFilesComeEveryWholeNumberOfRecords) {
  const DemPlan plan = plan_dem(small_mill());
  EXPECT_EQ(plan.restart_steps, 10 * plan.step.steps_per_record);
  auto mill = small_mill();
  mill.dem.duration = 10;
  EXPECT_EQ(plan_dem(mill).restart_steps, 20 * plan.step.steps_per_record);
}

TEST(Deck, AResumedRunReadsTheRestartFileInsertsNothingAndKeepsTheClock) {
  const auto mill = small_mill();
  std::ostringstream out;
  write_resume_deck(out, mill, plan_dem(mill), {"shell"}, 1, 700);
  const std::string deck = out.str();
  EXPECT_TRUE(has_line(deck, "read_restart restart.700"));
  EXPECT_EQ(deck.find("insert/pack"), std::string::npos);
  EXPECT_EQ(deck.find("reset_timestep"), std::string::npos);
  EXPECT_EQ(deck.find("create_box"), std::string::npos);
  EXPECT_NE(deck.find("file torque.700.txt"), std::string::npos);
  EXPECT_NE(deck.find("run " + std::to_string(plan_dem(mill).turning_steps) + " upto every"),
            std::string::npos);
}

meshing::Mill mill_with_contacts(double interval) {
  auto mill = small_mill();
  mill.dem.contact_interval = interval;
  return mill;
}

TEST(Deck, WithoutAnIntervalNoContactsAreDumped) {
  const std::string deck = deck_of(small_mill());
  EXPECT_TRUE(has_line(deck, "compute ballOverlaps all pair/gran/local delta"));
  EXPECT_EQ(deck.find("contacts"), std::string::npos);
  EXPECT_EQ(plan_dem(small_mill()).contact_dumps, 0);
}

TEST(Deck, ContactsAndTheirBallsAreDumpedAtTheNearestWholeNumberOfSteps) {
  const double step = plan_dem(small_mill()).step.value;
  const auto mill = mill_with_contacts(7.4 * step);
  const DemPlan plan = plan_dem(mill);
  EXPECT_EQ(plan.contact_steps, 7);
  EXPECT_EQ(plan.contact_dumps, plan.turning_steps / 7 + 1);
  const std::string deck = deck_of(mill);
  for (const std::string kind : {"pairs all local", "walls all local", "contactBalls all custom"})
    EXPECT_NE(deck.find("dump " + kind + " 7 ../contacts/"), std::string::npos) << kind;
  EXPECT_LT(deck.find("reset_timestep"), deck.find("dump pairs"));
  EXPECT_LT(deck.find("dump pairs"), deck.find("upto every"));
}

TEST(Deck, OverlapsAreCountedAtEveryTenthRecordOrAtAnotherThatDividesTheRestarts) {
  DemPlan plan = plan_dem(tests::small_mill());
  const long record = plan.step.steps_per_record;
  for (const auto& [restart, expected] :
       {std::pair{20L, 10L}, {25L, 5L}, {7L, 7L}, {13L, 13L}, {22L, 11L}, {16L, 8L}, {1L, 1L}}) {
    plan.restart_steps = restart * record;
    EXPECT_EQ(plan.overlap_steps(), expected * record) << restart;
    std::ostringstream deck;
    write_deck(deck, tests::small_mill(), plan, {"shell"}, 1);
    const std::string histogram =
        "fix ballOverlapsHistogram all ave/histo " + std::to_string(expected * record) + ' ' +
        std::to_string(restart / expected) + ' ' + std::to_string(restart * record) + " 0 ";
    EXPECT_NE(deck.str().find(histogram), std::string::npos) << restart;
  }
}

TEST(Deck, ContactsShareTheComputeOfTheOverlapsWhichAreItsLastColumn) {
  const std::string deck = deck_of(mill_with_contacts(0.01));
  EXPECT_EQ(after(deck, "compute").front(), "ballOverlaps");
  EXPECT_TRUE(has_line(deck, "compute ballOverlaps all pair/gran/local id force torque delta"));
  EXPECT_TRUE(has_line(deck, "compute wallOverlaps all wall/gran/local pos vel id force torque delta"));
  EXPECT_TRUE(has_line(deck, "compute overlap all reduce max c_ballOverlaps[10]"));
  EXPECT_NE(deck.find("1000 c_ballOverlaps[10] mode vector"), std::string::npos);
  EXPECT_NE(deck.find("1000 c_wallOverlaps[22] mode vector"), std::string::npos);
}

TEST(Deck, ContactsMoreOftenThanEveryStepAreRefused) {
  const std::string message = message_of([] { plan_dem(mill_with_contacts(1e-9)); });
  EXPECT_EQ(message.find("key 'dem.contact_interval' = 1e-09: expected 0 or at least the time-step, "), 0u)
      << message;
  const double step = plan_dem(small_mill()).step.value;
  EXPECT_EQ(plan_dem(mill_with_contacts(step)).contact_steps, 1);
}

/// What plan_dem says of the small mill after a change.
template <typename Change>
std::string refusal(Change change) {
  auto mill = small_mill();
  change(mill.dem);
  return message_of([&] { plan_dem(mill); });
}

TEST(Deck, ARunOfMoreStepsOrDumpsThanCanBeIsRefusedWithTheirNumber) {
  EXPECT_EQ(refusal([](auto& dem) { dem.duration = 1e12; }),
            "key 'dem.duration' = 1e+12: expected at most 1e+09 steps of less than 1 s, these are 1e+12");
  const std::string hours = refusal([](auto& dem) {
    dem.duration = 1e6;
    dem.record_interval = 10;
  });
  EXPECT_EQ(hours.find("key 'dem.duration' = 1e+06: expected at most 1e+09 steps of "), 0u) << hours;
  EXPECT_EQ(refusal([](auto& dem) {
              dem.duration = dem.record_interval = 1e300;
            }).find("key 'dem.duration' = 1e+300: expected at most 1e+09 steps"),
            0u);
  EXPECT_EQ(refusal([](auto& dem) { dem.settle_time = 1e12; }).find("key 'dem.settle_time' = 1e+12"), 0u);
  EXPECT_EQ(refusal([](auto& dem) { dem.record_interval = 1e-7; }),
            "key 'dem.record_interval' = 1e-07: expected at most 1e+06 dumps in 0.3 s, these are 3e+06");
  const std::string contacts = refusal([](auto& dem) {
    dem.duration = 200;
    dem.contact_interval = 1e-4;
  });
  EXPECT_EQ(
      contacts,
      "key 'dem.contact_interval' = 0.0001: expected at most 1e+06 dumps of the contacts, these are 2e+06");
}

TEST(Deck, AResumedRunDumpsContactsAtTheSameSteps) {
  const auto mill = mill_with_contacts(0.01);
  std::ostringstream out;
  write_resume_deck(out, mill, plan_dem(mill), {"shell"}, 1, 700);
  const std::string deck = deck_of(mill);
  const auto begin = deck.find("shell mkdir ../contacts");
  ASSERT_NE(begin, std::string::npos);
  EXPECT_NE(out.str().find(deck.substr(begin)), std::string::npos);
}

TEST(Deck, TheTorqueIsOfAllWalls) {
  EXPECT_TRUE(has_line(deck_of(small_mill(), {"shell", "lifters"}),
                       "variable torque equal 0+f_shell[6]+f_lifters[6]"));
}

TEST(Deck, OnlyARunThatFollowsItsContactsNeedsMillLiggghtsForThem) {
  auto mill = small_mill();
  EXPECT_EQ(deck_of(mill).find("watch"), std::string::npos);
  mill.dem.contact_statistics = true;
  const std::string deck = deck_of(mill);
  EXPECT_EQ(after(deck, "surface"), (std::vector<std::string>{"watched", "watched"}));
  // After the restart and the clock, so that step 0 is the begin of rotation
  EXPECT_TRUE(has_line(deck, watch_command));
  EXPECT_GT(deck.find(watch_command), deck.find("reset_timestep 0"));
}

}  // namespace
}  // namespace millfoam::dem_driver
