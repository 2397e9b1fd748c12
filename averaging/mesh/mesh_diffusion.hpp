// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <optional>
#include <vector>

#include "averaging/mesh/mesh_geometry.hpp"

namespace millfoam::averaging {

/// Smooths fields on a mesh by diffusion, so that balls larger than cells give fields on which the laws of drag
/// mean something. What a cell holds spreads as by the kernel exp(-r^2/b^2), b being the width: with c = total /
/// volume,
///
///     dc/dt = D div grad c   for a time T with D T = b^2/4,   no flux through the boundary,
///
/// which gives a point's cloud the variance b^2/2 along each axis. It is solved in four steps of implicit Euler,
/// which keep that variance, sums and signs, with two-point fluxes |S|/d (c_n - c_o) between cells whose centres
/// are d apart; that the line between centres may lean against the face is neglected.
///
/// Source: Sun & Xiao 2015, Int J Multiphase Flow 77:112.
class MeshDiffusion {
 public:
  /// @param width     b, m, positive
  /// @param period_z  length after which the mesh repeats along z, m: its faces at both ends are joined.
  /// Throws std::invalid_argument for a width that is not positive, or when the faces at both ends do not match,
  /// naming the face.
  MeshDiffusion(const MeshGeometry& geometry, double width, std::optional<double> period_z = std::nullopt);

  /// Smooths totals per cell, [cells][components], of any unit: volumes, momenta, numbers. Each component's sum
  /// over the cells is kept to rounding, and none that had no negative value gets one. May be called from
  /// several threads.
  void apply(std::vector<double>& totals, int components) const;

 private:
  /// Two cells between which there is a flux of `conductance` times the difference of c in one step, m^3.
  struct Link {
    int owner;
    int neighbour;
    double conductance;
  };

  void join_ends(const MeshGeometry& geometry, double period, double step);
  void build_matrix();
  void step(Eigen::VectorXd& totals) const;

  std::vector<double> volumes_;
  std::vector<Link> links_;
  Eigen::SparseMatrix<double> matrix_;
};

}  // namespace millfoam::averaging
