// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/periodic_faces.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace millfoam::averaging {

namespace {

struct EndFace {
  int face;
  Eigen::Vector3d middle;
};

/// Mean of a face's points.
Eigen::Vector3d middle(const MeshGeometry& mesh, std::size_t face) {
  const MeshTopology& topology = mesh.topology();
  const int begin = topology.face_begin[face], end = topology.face_begin[face + 1];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int p = begin; p < end; ++p) {
    sum += mesh.points()[static_cast<std::size_t>(topology.face_points[static_cast<std::size_t>(p)])];
  }
  return sum / (end - begin);
}

/// Boundary faces in the plane z, in rising order of x.
std::vector<EndFace> faces_at(const MeshGeometry& mesh, double z, double tolerance) {
  std::vector<EndFace> found;
  const MeshTopology& topology = mesh.topology();
  for (std::size_t face = topology.internal_faces(); face < topology.faces(); ++face) {
    const Eigen::Vector3d centre = middle(mesh, face);
    if (std::abs(centre.z() - z) <= tolerance) found.push_back({static_cast<int>(face), centre});
  }
  std::sort(found.begin(), found.end(),
            [](const EndFace& a, const EndFace& b) { return a.middle.x() < b.middle.x(); });
  return found;
}

std::invalid_argument no_partner(const EndFace& face) {
  std::ostringstream message;
  message << "boundary face " << face.face << " at (" << face.middle.transpose()
          << ") m has no partner one period away along z, expected ends that match";
  return std::invalid_argument(message.str());
}

}  // namespace

void require_period(const MeshGeometry& mesh, double period) {
  const double length = mesh.box().sizes().z();
  if (std::abs(length - period) <= 1e-6 * length) return;
  std::ostringstream message;
  message.precision(12);
  message << "the period is " << period << " m, expected the mesh's length along z, " << length
          << " m, to 1e-6 of it";
  throw std::invalid_argument(message.str());
}

std::vector<std::array<int, 2>> periodic_faces(const MeshGeometry& mesh, double period) {
  require_period(mesh, period);
  const double lower = mesh.box().min().z(), upper = mesh.box().max().z();
  const double tolerance = 1e-6 * mesh.box().diagonal().norm();
  const std::vector<EndFace> low = faces_at(mesh, lower, tolerance), high = faces_at(mesh, upper, tolerance);
  std::vector<bool> taken(high.size(), false);
  std::vector<std::array<int, 2>> pairs;
  for (const EndFace& face : low) {
    auto other =
        std::lower_bound(high.begin(), high.end(), face.middle.x() - tolerance,
                         [](const EndFace& candidate, double x) { return candidate.middle.x() < x; });
    const auto matches = [&] { return (other->middle - face.middle).head<2>().norm() <= tolerance; };
    while (other != high.end() && other->middle.x() <= face.middle.x() + tolerance && !matches()) ++other;
    if (other == high.end() || !matches()) throw no_partner(face);
    taken[static_cast<std::size_t>(other - high.begin())] = true;
    pairs.push_back({face.face, other->face});
  }
  const auto left = std::find(taken.begin(), taken.end(), false);
  if (left != taken.end()) throw no_partner(high[static_cast<std::size_t>(left - taken.begin())]);
  return pairs;
}

}  // namespace millfoam::averaging
