// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/mill_key.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "small_mill.hpp"

namespace millfoam::dem_driver {
namespace {

using tests::TemporaryFolder;

/// "mill.yaml:line: …" for an error of this key.
std::string place_of(const std::string& key) {
  const TemporaryFolder temporary;
  const auto file = temporary.path() / "mill.yaml";
  std::ofstream(file) << "title: drum\ncharge:\n  classes:\n    - {diameter: 0.004, mass: 0.02}\n"
                         "    - diameter: 0.002\n      mass: 1e-9\n\ndem:\n  {duration: 1,\n   seed: 3}\n";
  const std::string message = with_place(file, KeyError(key, "7", "less"));
  return message.substr(message.find("mill.yaml"));
}

TEST(MillKey, AnErrorHasTheFormOfThoseOfTheMill) {
  EXPECT_EQ(place_of("dem.seed"), "mill.yaml:10: key 'dem.seed' = 7: expected less");
}

TEST(MillKey, AnItemOfAListHasItsOwnLine) {
  EXPECT_EQ(place_of("charge.classes[1]"), "mill.yaml:5: key 'charge.classes[1]' = 7: expected less");
  EXPECT_EQ(place_of("charge.classes[1].mass").substr(0, 11), "mill.yaml:6");
}

TEST(MillKey, AKeyThatIsLeftToItsDefaultHasTheLineOfItsSection) {
  EXPECT_EQ(place_of("charge.start_radius").substr(0, 12), "mill.yaml:2:");
  EXPECT_EQ(place_of("air.density").substr(0, 12), "mill.yaml:1:");
}

TEST(MillKey, AFileThatIsGoneIsStillNamed) {
  EXPECT_EQ(with_place("no/mill.yaml", KeyError("dem.seed", "7", "less")),
            "no/mill.yaml: key 'dem.seed' = 7: expected less");
}

}  // namespace
}  // namespace millfoam::dem_driver
