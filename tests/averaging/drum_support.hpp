// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "averaging/mesh/deforming_mesh.hpp"
#include "tests/averaging/mesh_support.hpp"
#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {

/// Of the drum about the z axis from z = 0, m.
inline constexpr double drum_radius = 0.06, drum_length = 0.024;

/// Of hexahedra, 4 x 4 in its core and 3 rings of 16 around it, in 4 layers.
inline TestMesh drum() {
  return drum_mesh(drum_radius, drum_length, 4, 3, 4);
}

/// A drum that is squeezed along y by a tenth in a second and turns about z meanwhile.
struct DeformingDrum : ::testing::Test {
  TemporaryFolder folder;
  TestMesh mesh = drum();
  std::shared_ptr<const MeshSeries> series;

  static MeshPoints squeezed(MeshPoints points, double by) {
    for (Eigen::Vector3d& p : points) p.y() *= 1 - by;
    return points;
  }

  DeformingDrum() {
    MeshWriter writer(folder / "mesh.h5", mesh.topology, 2.0);
    writer.append(0, mesh.points);
    writer.append(0.4, squeezed(mesh.points, 0.04));
    writer.append(1, squeezed(mesh.points, 0.1));
    writer.finish();
    series = std::make_shared<const MeshSeries>(folder / "mesh.h5");
  }
};

}  // namespace millfoam::averaging
