// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/mesh_diffusion.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

namespace millfoam::averaging {

namespace {

using Eigen::Vector3d;

constexpr int steps = 4;

std::size_t at(int number) {
  return static_cast<std::size_t>(number);
}

Vector3d area(const MeshGeometry& geometry, std::size_t face) {
  Vector3d sum = Vector3d::Zero();
  for (int f = geometry.first_facet(face); f < geometry.first_facet(face + 1); ++f) {
    const Facet& facet = geometry.facets()[at(f)];
    const Vector3d& a = geometry.points()[at(facet.corners[0])];
    for (int i = 2; i < facet.corner_count; ++i) {
      const Vector3d& b = geometry.points()[at(facet.corners[at(i - 1)])];
      sum += (b - a).cross(geometry.points()[at(facet.corners[at(i)])] - a) / 2;
    }
  }
  return sum;
}

Vector3d middle(const MeshGeometry& geometry, std::size_t face) {
  const MeshTopology& topology = geometry.topology();
  Vector3d sum = Vector3d::Zero();
  for (int i = topology.face_begin[face]; i < topology.face_begin[face + 1]; ++i) {
    sum += geometry.points()[at(topology.face_points[at(i)])];
  }
  return sum / (topology.face_begin[face + 1] - topology.face_begin[face]);
}

/// Boundary faces across z at one end of the mesh.
std::vector<std::size_t> faces_at(const MeshGeometry& geometry, double z, double tolerance) {
  std::vector<std::size_t> found;
  for (std::size_t f = geometry.topology().internal_faces(); f < geometry.topology().faces(); ++f) {
    const Vector3d normal = area(geometry, f).normalized();
    if (std::abs(normal.z()) > 0.99 && std::abs(middle(geometry, f).z() - z) <= tolerance) found.push_back(f);
  }
  return found;
}

[[noreturn]] void refuse_face(std::size_t face, double period) {
  std::ostringstream message;
  message << "mesh: face " << face << " at an end of the mesh has no counterpart " << period
          << " m away along z: the mesh does not repeat";
  throw std::invalid_argument(message.str());
}

}  // namespace

MeshDiffusion::MeshDiffusion(const MeshGeometry& geometry, double width, std::optional<double> period_z)
    : volumes_(geometry.volumes()) {
  if (!(width > 0 && std::isfinite(width))) {
    throw std::invalid_argument("the width of smoothing is " + std::to_string(width) +
                                " m, expected a positive number");
  }
  const double step = width * width / 4 / steps;
  const MeshTopology& topology = geometry.topology();
  for (std::size_t face = 0; face < topology.internal_faces(); ++face) {
    const int owner = topology.owner[face], neighbour = topology.neighbour[face];
    const double distance = (geometry.centres()[at(neighbour)] - geometry.centres()[at(owner)]).norm();
    links_.push_back({owner, neighbour, step * area(geometry, face).norm() / distance});
  }
  if (period_z) join_ends(geometry, *period_z, step);
  build_matrix();
}

void MeshDiffusion::join_ends(const MeshGeometry& geometry, double period, double step) {
  const double tolerance = 1e-6 * geometry.box().diagonal().norm();
  const std::vector<int>& owner = geometry.topology().owner;
  const auto lower = faces_at(geometry, geometry.box().min().z(), tolerance);
  const auto upper = faces_at(geometry, geometry.box().max().z(), tolerance);
  std::multimap<double, std::size_t> upper_by_x;
  for (const std::size_t face : upper) upper_by_x.emplace(middle(geometry, face).x(), face);
  for (const std::size_t face : lower) {
    const Vector3d sought = middle(geometry, face) + Vector3d(0, 0, period);
    const auto last = upper_by_x.upper_bound(sought.x() + tolerance);
    const auto found =
        std::find_if(upper_by_x.lower_bound(sought.x() - tolerance), last, [&](const auto& entry) {
          return (middle(geometry, entry.second) - sought).norm() <= 2 * tolerance;
        });
    if (found == last) refuse_face(face, period);
    const int below = owner[face], above = owner[found->second];
    upper_by_x.erase(found);
    // A cell that is its own neighbour has nothing to give to itself.
    if (below == above) continue;
    const Vector3d image = geometry.centres()[at(below)] + Vector3d(0, 0, period);
    const double distance = (image - geometry.centres()[at(above)]).norm();
    links_.push_back({above, below, step * area(geometry, face).norm() / distance});
  }
  if (!upper_by_x.empty()) refuse_face(upper_by_x.begin()->second, -period);
}

void MeshDiffusion::build_matrix() {
  std::vector<Eigen::Triplet<double>> entries;
  const int cells = static_cast<int>(volumes_.size());
  for (int cell = 0; cell < cells; ++cell) entries.emplace_back(cell, cell, volumes_[at(cell)]);
  for (const auto& [owner, neighbour, conductance] : links_) {
    entries.emplace_back(owner, owner, conductance);
    entries.emplace_back(neighbour, neighbour, conductance);
    entries.emplace_back(owner, neighbour, -conductance);
    entries.emplace_back(neighbour, owner, -conductance);
  }
  matrix_.resize(cells, cells);
  matrix_.setFromTriplets(entries.begin(), entries.end());
}

void MeshDiffusion::step(Eigen::VectorXd& totals) const {
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(1e-14);
  solver.setMaxIterations(10000);
  solver.compute(matrix_);
  const Eigen::VectorXd before =
      totals.cwiseQuotient(Eigen::VectorXd::Map(volumes_.data(), static_cast<Eigen::Index>(volumes_.size())));
  const Eigen::VectorXd after = solver.solveWithGuess(totals, before);
  // What one cell loses the other gains, to the last bit, whatever the solver left over.
  for (const auto& [owner, neighbour, conductance] : links_) {
    const double flux = conductance * (after[neighbour] - after[owner]);
    totals[owner] += flux;
    totals[neighbour] -= flux;
  }
}

void MeshDiffusion::apply(std::vector<double>& totals, int components) const {
  const auto cells = static_cast<Eigen::Index>(volumes_.size());
  assert(totals.size() == volumes_.size() * at(components));
  for (int c = 0; c < components; ++c) {
    Eigen::Map<Eigen::VectorXd, 0, Eigen::InnerStride<>> component(totals.data() + c, cells,
                                                                   Eigen::InnerStride<>(components));
    Eigen::VectorXd values = component;
    const bool had_negative = values.minCoeff() < 0;
    if (values.isZero(0)) continue;
    for (int s = 0; s < steps; ++s) step(values);
    if (!had_negative) {
      // Only rounding makes values below 0; what it took too much goes back to where there is most.
      Eigen::Index largest = 0;
      values.maxCoeff(&largest);
      const double too_much = values.cwiseMin(0).sum();
      values = values.cwiseMax(0);
      values[largest] += too_much;
    }
    component = values;
  }
}

}  // namespace millfoam::averaging
