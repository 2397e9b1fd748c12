// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/moving_mesh.hpp"

#include "averaging/mesh/cell_locator.hpp"

namespace millfoam::averaging {

PreparedMesh prepare(const MeshTopology& topology, const MeshPoints& points) {
  const auto geometry = std::make_shared<const MeshGeometry>(topology, points);
  return {geometry, std::make_shared<const CellLocator>(geometry)};
}

RigidMesh::RigidMesh(PreparedMesh mesh, std::shared_ptr<const Motion> motion, double reference_time)
    : mesh_(std::move(mesh)), motion_(std::move(motion)), reference_(motion_->place(reference_time)) {}

void RigidMesh::begin_record(double time) {
  into_mesh_ = reference_ * motion_->place(time).inverse();
}

}  // namespace millfoam::averaging
