// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/mesh_diffusion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "averaging/mesh/periodic_faces.hpp"

namespace millfoam::averaging {

namespace {

/// Largest part of a cell's total that may leave it in a step. Below 1 nothing becomes negative; about half
/// also leaves no pattern of the steps behind.
constexpr double largest_part = 0.6;

/// Above this, smoothing a record takes too long.
constexpr double most_steps = 1e5;

/// Of the sums over a record's particles.
constexpr std::size_t usual_components = 8;

/// Two cells and how much passes between them per time and difference of density, m.
struct Link {
  std::size_t a;
  std::size_t b;
  double conductance;
};

double area(const MeshGeometry& mesh, std::size_t face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int f = mesh.first_facet(face); f < mesh.first_facet(face + 1); ++f) {
    const Facet& facet = mesh.facets()[static_cast<std::size_t>(f)];
    const auto corner = [&](int i) {
      return mesh.points()[static_cast<std::size_t>(facet.corners[static_cast<std::size_t>(i)])];
    };
    for (int i = 2; i < facet.corner_count; ++i) {
      sum += (corner(i - 1) - corner(0)).cross(corner(i) - corner(0)) / 2;
    }
  }
  return sum.norm();
}

std::vector<Link> links(const MeshGeometry& mesh, std::optional<double> period) {
  const MeshTopology& topology = mesh.topology();
  std::vector<Link> result;
  const auto join = [&](int first, int second, std::size_t face, const Eigen::Vector3d& shift) {
    const auto a = static_cast<std::size_t>(first), b = static_cast<std::size_t>(second);
    // One cell that spans the period is its own neighbour: nothing passes.
    if (a != b)
      result.push_back({a, b, area(mesh, face) / (mesh.centres()[a] - mesh.centres()[b] + shift).norm()});
  };
  for (std::size_t face = 0; face < topology.internal_faces(); ++face) {
    join(topology.owner[face], topology.neighbour[face], face, Eigen::Vector3d::Zero());
  }
  if (!period) return result;
  for (const auto& [low, high] : periodic_faces(mesh, *period)) {
    const auto face = static_cast<std::size_t>(low);
    join(topology.owner[face], topology.owner[static_cast<std::size_t>(high)], face, {0, 0, *period});
  }
  return result;
}

/// Steps that the diffusion takes, so that no cell gives away more than `largest_part` of its total in one.
/// @param rate  [cells] part of the total that leaves per unit of width^2
int count_steps(double width, const std::vector<double>& rate) {
  const auto fastest = std::max_element(rate.begin(), rate.end());
  const double steps = std::max(1.0, std::ceil(width * width / 4 * *fastest / largest_part));
  if (steps <= most_steps) return static_cast<int>(steps);
  std::ostringstream message;
  message << "smoothing over " << width << " m takes " << steps << " steps because of the small cell "
          << fastest - rate.begin() << "; expected at most " << most_steps
          << ": take a smaller width or a mesh without such cells";
  throw std::invalid_argument(message.str());
}

}  // namespace

MeshDiffusion::MeshDiffusion(const MeshGeometry& mesh, double width, std::optional<double> period) {
  if (!(width > 0) || !std::isfinite(width)) {
    throw std::invalid_argument("the smoothing width is " + std::to_string(width) +
                                " m, expected a length above 0");
  }
  const std::vector<Link> all = links(mesh, period);
  std::vector<double> rate(mesh.cells(), 0.0);  // part of the total that leaves per unit of width^2
  begin_.assign(mesh.cells() + 1, 0);
  for (const Link& link : all) {
    for (const std::size_t cell : {link.a, link.b}) {
      rate[cell] += link.conductance / mesh.volumes()[cell];
      ++begin_[cell + 1];
    }
  }
  steps_ = count_steps(width, rate);
  const double step = width * width / 4 / steps_;

  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    begin_[c + 1] += begin_[c];
    kept_.push_back(1 - step * rate[c]);
  }
  source_.resize(begin_.back());
  part_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  const auto add = [&](std::size_t to, std::size_t from, double conductance) {
    source_[next[to]] = from;
    part_[next[to]++] = step * conductance / mesh.volumes()[from];
  };
  for (const Link& link : all) {
    add(link.a, link.b, link.conductance);
    add(link.b, link.a, link.conductance);
  }
}

template <std::size_t Components>
void MeshDiffusion::step(const std::vector<double>& from, std::vector<double>& to, std::size_t some) const {
  // With a number of components that the compiler knows, it keeps a cell's sums in registers.
  const std::size_t components = Components > 0 ? Components : some;
  for (std::size_t cell = 0; cell < kept_.size(); ++cell) {
    double* const sum = &to[cell * components];
    const double* const own = &from[cell * components];
    for (std::size_t k = 0; k < components; ++k) sum[k] = kept_[cell] * own[k];
    for (std::size_t s = begin_[cell]; s < begin_[cell + 1]; ++s) {
      const double* const source = &from[source_[s] * components];
      for (std::size_t k = 0; k < components; ++k) sum[k] += part_[s] * source[k];
    }
  }
}

void MeshDiffusion::apply(std::vector<double>& totals, std::size_t components) const {
  assert(totals.size() == kept_.size() * components);
  std::vector<double> other(totals.size());
  for (int n = 0; n < steps_; ++n) {
    if (components == usual_components) {
      step<usual_components>(totals, other, components);
    } else {
      step<0>(totals, other, components);
    }
    totals.swap(other);
  }
}

}  // namespace millfoam::averaging
