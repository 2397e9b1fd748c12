// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/volume/volume_mesh.hpp"

#include <Eigen/Geometry>

namespace millfoam::meshing {

VolumeMesh turned(VolumeMesh mesh, double angle) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (Eigen::Vector3d& point : mesh.points) point = turn * point;
  return mesh;
}

}  // namespace millfoam::meshing
