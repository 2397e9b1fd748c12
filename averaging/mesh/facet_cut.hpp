// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "averaging/mesh/mesh_geometry.hpp"

namespace millfoam::averaging {

/// How a facet cuts a sphere.
struct FacetCut {
  /// Whether the facet and the sphere meet, and whether that is certain.
  enum class Kind {
    none,     ///< the facet does not meet the sphere
    clear,    ///< it does, and `beyond` holds
    delicate  ///< it does so near to the sphere's centre that rounding could decide
  };
  Kind kind = Kind::none;  ///< what is known
  double beyond = 0;       ///< volume of the sphere beyond the facet, m^3
};

/// The part of a sphere beyond a facet: of the cone from the sphere's centre over the facet, what is farther
/// than the facet. It counts positive where the centre is on the owner's side and negative on the other. The
/// volume of the sphere in a cell is then
///
///     V = [centre in the cell] 4/3 pi R^3  -  sum over the cell's facets of  +- beyond     (+ for its owner)
///
/// and facets that do not meet the sphere need not be looked at. With h the distance of the facet's plane
/// and, for each edge, p the distance of its line from the foot of the perpendicular from the centre
/// (positive inside), s the coordinate along the line from the point nearest to the foot, both ends cut to
/// the sphere:
///
///     beyond = [foot in facet] pi/3 (R - h)^2 (2R + h)  -  sum over edges K
///     K = 1/3 [ R^3 atan(h s/(p w)) - h (3R^2 - h^2)/2 atan(s/p) + h p s/2 ]   between both ends,
///     w^2 = h^2 + p^2 + s^2
///
/// K is the integral over the angle about the foot of the part of the cap beyond the edge's line. It is the
/// inclusion-exclusion over faces, edges and corners of Strobl, Formella & Poeschel 2016, J Comput Phys
/// 311:158, with all corners of an edge in one formula.
///
/// Delicate are planes nearer than 1e-6 R and edges nearer than 1e-3 R to the centre: for them the sum of
/// `sphere_triangle_volume` over the cell's triangles, which is robust everywhere, should be taken.
FacetCut cut_facet(const Facet& facet, const MeshPoints& points, const Eigen::Vector3d& centre,
                   double radius);

}  // namespace millfoam::averaging
