// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "meshing/volume/volume_mesh.hpp"

namespace millfoam::meshing {

/// Area vectors and centroids of the faces, volumes and centroids of the cells, as OpenFOAM computes them:
/// faces from triangles about the mean of their points, cells from pyramids about the mean of their faces'
/// centroids.
struct MeshMeasures {
  std::vector<Eigen::Vector3d> face_area;    ///< m^2, along the face's normal
  std::vector<Eigen::Vector3d> face_centre;  ///< m
  std::vector<double> cell_volume;           ///< m^3, negative for a cell turned inside out
  std::vector<Eigen::Vector3d> cell_centre;  ///< m
};

/// The measures of a mesh.
MeshMeasures measure(const VolumeMesh& mesh);

/// The quality of a mesh for a flow solver, with OpenFOAM's definitions (primitiveMeshTools in its source).
struct MeshQuality {
  double volume = 0;         ///< of all cells, m^3
  double smallest_cell = 0;  ///< volume, m^3
  double smallest_edge = 0;  ///< m
  double largest_edge = 0;   ///< m
  /// Degrees between a face's normal and the line between its two cells' centres.
  double max_non_orthogonality = 0;
  double max_skewness = 0;      ///< distance of that line from the face's centre over the face's half-width
  double max_volume_ratio = 1;  ///< of the larger of two neighbouring cells to the smaller

  Eigen::Vector3d smallest_cell_at = Eigen::Vector3d::Zero();          ///< its centre, m
  Eigen::Vector3d max_non_orthogonality_at = Eigen::Vector3d::Zero();  ///< centre of that face, m
  Eigen::Vector3d max_skewness_at = Eigen::Vector3d::Zero();           ///< centre of that face, m
  Eigen::Vector3d max_volume_ratio_at = Eigen::Vector3d::Zero();       ///< centre of that face, m
};

/// The quality of a mesh.
MeshQuality quality(const VolumeMesh& mesh);

/// Volume of the cells before z = `length`, m^3: of the mill without compartments behind its grates.
double chamber_volume(const VolumeMesh& mesh, double length);

/// Largest non-orthogonality that a mill's mesh may have, degrees.
inline constexpr double allowed_non_orthogonality = 45;
/// Largest skewness that a mill's mesh may have.
inline constexpr double allowed_skewness = 1;
/// Largest ratio of two neighbouring cells' volumes that a mill's mesh may have.
inline constexpr double allowed_volume_ratio = 3;
/// Largest error of a mill's mesh in volume, relative to the closed form.
inline constexpr double allowed_volume_error = 0.005;

/// What a mesh may have at most, and what to change otherwise; by default of a tumbling mill.
struct QualityLimits {
  double non_orthogonality = allowed_non_orthogonality;  ///< degrees
  double skewness = allowed_skewness;                    ///< as of MeshQuality
  double volume_ratio = allowed_volume_ratio;            ///< of two neighbouring cells
  double volume_error = allowed_volume_error;            ///< relative
  const char* advice =
      "choose another resolution, lifters that are less high or less wide, or openings whose circles are "
      "further from each other and from the lifters";  ///< for messages
};

/// Throws std::runtime_error with the value, the limit, the place and advice for a mesh that is not good
/// enough; `analytic_volume` in m^3. From z = `length`, m, on, cells are those of pulp lifters.
void require_quality(const MeshQuality& quality, double analytic_volume,
                     double length = std::numeric_limits<double>::infinity(),
                     const QualityLimits& limits = QualityLimits());

}  // namespace millfoam::meshing
