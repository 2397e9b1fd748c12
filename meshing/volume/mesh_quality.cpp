// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/volume/mesh_quality.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "meshing/faces/face_geometry.hpp"
#include "meshing/files/text_numbers.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

using Eigen::Vector3d;

/// Relative difference below which two levels are the same.
constexpr double same_level = 1e-9;

void measure_face(const VolumeMesh& mesh, const Quad& face, MeshMeasures& measures) {
  Vector3d middle = Vector3d::Zero();
  for (int p : face) middle += mesh.points[index(p)] / 4;
  Vector3d area = Vector3d::Zero();
  std::array<Vector3d, 4> triangles;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d& a = mesh.points[index(face[i])];
    const Vector3d& b = mesh.points[index(face[(i + 1) % 4])];
    triangles[i] = (a - middle).cross(b - middle) / 2;
    area += triangles[i];
  }
  Vector3d moment = Vector3d::Zero();
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double share = triangles[i].dot(area.normalized());
    moment += share * (mesh.points[index(face[i])] + mesh.points[index(face[(i + 1) % 4])] + middle) / 3;
    sum += share;
  }
  measures.face_area.push_back(area);
  measures.face_centre.push_back(moment / sum);
}

/// Calls visit(cell, face, sign) for both sides of each face; sign is +1 where the normal points out of the
/// cell.
template <typename Visit>
void for_each_side(const VolumeMesh& mesh, const Visit& visit) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    visit(index(mesh.owner[f]), f, 1.0);
    if (f < mesh.neighbour.size()) visit(index(mesh.neighbour[f]), f, -1.0);
  }
}

/// Half the extent of a face in a direction, and at least a share of the distance between the centres.
double half_width(const VolumeMesh& mesh, std::size_t f, const Vector3d& centre, const Vector3d& direction,
                  double least) {
  double width = least;
  for (int p : mesh.faces[f])
    width = std::max(width, std::abs(direction.dot(mesh.points[index(p)] - centre)));
  return width;
}

/// Where `line`, from the cell's centre, meets the face, against the face's centre.
double skewness(const VolumeMesh& mesh, const MeshMeasures& m, std::size_t f, const Vector3d& line,
                double share) {
  const Vector3d to_face = m.face_centre[f] - m.cell_centre[index(mesh.owner[f])];
  const Vector3d miss = to_face - m.face_area[f].dot(to_face) / m.face_area[f].dot(line) * line;
  const Vector3d direction = miss / (miss.norm() + std::numeric_limits<double>::min());
  return miss.norm() / half_width(mesh, f, m.face_centre[f], direction, share * line.norm());
}

/// What to change in mill.yaml; cells from z = `length` on are as long as the pulp lifters' layers.
std::string advice(const Vector3d& place, double length, const QualityLimits& limits) {
  if (place.z() >= length * (1 - same_level))
    return "choose another pulp_lifters.layers or pulp_lifters.depth, so that the layers behind the grates "
           "are "
           "about as thick as the mill's last layer, or another resolution (layers, last_layer)";
  return limits.advice;
}

/// Refuses meshes; `length` as in require_quality.
struct Judge {
  double length;
  const QualityLimits& limits;

  [[noreturn]] void refuse(const std::string& what, const Vector3d& place) const {
    throw std::runtime_error("the mesh has " + what + " at " + described(place) +
                             " m: " + advice(place, length, limits));
  }

  void require_at_most(double limit, double value, const std::string& what, const std::string& unit,
                       const Vector3d& place) const {
    std::ostringstream text;
    text << what << " of " << value << unit << ", above the allowed " << limit << unit << ",";
    if (!(value <= limit)) refuse(text.str(), place);
  }
};

/// Keeps the larger of two values and its place.
void keep_larger(double& value, Vector3d& place, double other, const Vector3d& at) {
  if (!(other > value)) return;
  value = other;
  place = at;
}

}  // namespace

MeshMeasures measure(const VolumeMesh& mesh) {
  MeshMeasures m;
  for (const Quad& face : mesh.faces) measure_face(mesh, face, m);
  const std::size_t cells = index(mesh.cells);
  std::vector<Vector3d> middle(cells, Vector3d::Zero());
  std::vector<int> faces(cells, 0);
  for_each_side(mesh, [&](std::size_t c, std::size_t f, double) {
    middle[c] += m.face_centre[f];
    ++faces[c];
  });
  for (std::size_t c = 0; c < cells; ++c) middle[c] /= faces[c];
  m.cell_volume.assign(cells, 0);
  m.cell_centre.assign(cells, Vector3d::Zero());
  for_each_side(mesh, [&](std::size_t c, std::size_t f, double sign) {
    const double pyramid = sign * m.face_area[f].dot(m.face_centre[f] - middle[c]) / 3;
    m.cell_volume[c] += pyramid;
    m.cell_centre[c] += pyramid * (0.75 * m.face_centre[f] + 0.25 * middle[c]);
  });
  for (std::size_t c = 0; c < cells; ++c) m.cell_centre[c] /= m.cell_volume[c];
  return m;
}

MeshQuality quality(const VolumeMesh& mesh) {
  const MeshMeasures m = measure(mesh);
  MeshQuality q;
  const auto smallest = std::min_element(m.cell_volume.begin(), m.cell_volume.end());
  q.smallest_cell = *smallest;
  q.smallest_cell_at = m.cell_centre[static_cast<std::size_t>(smallest - m.cell_volume.begin())];
  for (double volume : m.cell_volume) q.volume += volume;
  q.smallest_edge = std::numeric_limits<double>::max();
  double most_oblique = -1;  // negative cosine between normal and centres' line
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Quad& face = mesh.faces[f];
      const double edge = (mesh.points[index(face[i])] - mesh.points[index(face[(i + 1) % 4])]).norm();
      q.smallest_edge = std::min(q.smallest_edge, edge);
      q.largest_edge = std::max(q.largest_edge, edge);
    }
    const Vector3d& centre = m.cell_centre[index(mesh.owner[f])];
    const Vector3d normal = m.face_area[f].normalized();
    if (f < mesh.neighbour.size()) {
      const Vector3d line = m.cell_centre[index(mesh.neighbour[f])] - centre;
      keep_larger(most_oblique, q.max_non_orthogonality_at, -line.normalized().dot(normal), m.face_centre[f]);
      keep_larger(q.max_skewness, q.max_skewness_at, skewness(mesh, m, f, line, 0.2), m.face_centre[f]);
      const double ratio = m.cell_volume[index(mesh.owner[f])] / m.cell_volume[index(mesh.neighbour[f])];
      keep_larger(q.max_volume_ratio, q.max_volume_ratio_at, std::max(ratio, 1 / ratio), m.face_centre[f]);
    } else {
      const Vector3d line = normal * normal.dot(m.face_centre[f] - centre);
      keep_larger(q.max_skewness, q.max_skewness_at, skewness(mesh, m, f, line, 0.4), m.face_centre[f]);
    }
  }
  q.max_non_orthogonality = std::acos(std::min(1.0, -most_oblique)) * 180 / pi;
  return q;
}

void require_quality(const MeshQuality& q, double analytic_volume, double length,
                     const QualityLimits& limits) {
  const Judge judge{length, limits};
  std::ostringstream text;
  text << "a cell turned inside out, of " << q.smallest_cell << " m^3,";
  if (!(q.smallest_cell > 0)) judge.refuse(text.str(), q.smallest_cell_at);
  judge.require_at_most(limits.non_orthogonality, q.max_non_orthogonality, "a largest non-orthogonality",
                        " degrees", q.max_non_orthogonality_at);
  judge.require_at_most(limits.skewness, q.max_skewness, "a largest skewness", "", q.max_skewness_at);
  judge.require_at_most(limits.volume_ratio, q.max_volume_ratio,
                        "a largest volume ratio of neighbouring cells", "", q.max_volume_ratio_at);
  const double error = std::abs(q.volume / analytic_volume - 1);
  if (error <= limits.volume_error) return;  // refuses nan too
  text.str("");
  text << "the mesh has a relative error in volume of " << error << ", above the allowed "
       << limits.volume_error << ": " << limits.advice;
  throw std::runtime_error(text.str());
}

double chamber_volume(const VolumeMesh& mesh, double length) {
  const MeshMeasures measures = measure(mesh);
  double sum = 0;
  for (std::size_t cell = 0; cell < measures.cell_volume.size(); ++cell) {
    if (measures.cell_centre[cell].z() < length) sum += measures.cell_volume[cell];
  }
  return sum;
}

}  // namespace millfoam::meshing
