// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/deforming_mesh.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/averaging/drum_support.hpp"

namespace millfoam::averaging {
namespace {

TEST_F(DeformingDrum, HasPointsThatAreLinearBetweenItsTimes) {
  for (const double part : {0.0, 0.03, 0.04, 0.07, 0.1}) {
    const MeshPoints points = series->points_at(2 + 10 * part), expected = squeezed(mesh.points, part);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT((points[i] - expected[i]).norm(), 1e-16);
  }
}

TEST_F(DeformingDrum, IsNotKnownOutsideItsTimes) {
  for (const double time : {1.99, 3.01, 0.5}) {
    expect_named(message_of<std::out_of_range>([&] { series->points_at(time); }),
                 {"mesh.h5", "outside", "from 2 to 3 s"});
  }
}

TEST_F(DeformingDrum, ACellTurnedInsideOutIsRefusedWithTheTime) {
  MeshWriter writer(folder / "bad.h5", mesh.topology, 0);
  writer.append(0, mesh.points);
  writer.append(1, squeezed(mesh.points, 2));
  writer.finish();
  DeformingMesh bad(std::make_shared<const MeshSeries>(folder / "bad.h5"));
  EXPECT_NO_THROW(bad.begin_record(0.1));
  expect_named(message_of<std::invalid_argument>([&] { bad.begin_record(0.75); }),
               {(folder / "bad.h5").string() + ": at DEM time 0.75 s", "cell 0", "volume"});
}

}  // namespace
}  // namespace millfoam::averaging
