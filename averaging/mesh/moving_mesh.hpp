// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "averaging/mesh/cell_search.hpp"
#include "averaging/mesh/mesh_geometry.hpp"
#include "averaging/mesh/motion.hpp"

namespace millfoam::averaging {

/// A mesh whose place is known at every time. A point of the lab is transformed into the mesh's frame and
/// located there. One object serves one thread.
class MovingMesh {
 public:
  virtual ~MovingMesh() = default;

  /// Another one for another thread.
  virtual std::unique_ptr<MovingMesh> clone() const = 0;

  /// Brings the mesh to its place at a DEM time, s. Throws std::out_of_range when that is not known.
  virtual void begin_record(double time) = 0;

  virtual const MeshGeometry& geometry() const = 0;        ///< in the mesh's frame
  virtual const CellSearch& search() const = 0;            ///< in the mesh's frame
  virtual const Eigen::Isometry3d& into_mesh() const = 0;  ///< from the lab's frame

 protected:
  MovingMesh() = default;
  MovingMesh(const MovingMesh&) = default;
  MovingMesh& operator=(const MovingMesh&) = default;
};

/// A mesh with what is prepared to find its cells, for as many threads as there are.
struct PreparedMesh {
  std::shared_ptr<const MeshGeometry> geometry;  ///< shape of the cells
  std::shared_ptr<const CellSearch> search;      ///< finds the cell of a point
};

/// Prepares a mesh whose cells keep their shape. Throws as MeshGeometry.
PreparedMesh prepare(const MeshTopology& topology, const MeshPoints& points);

/// A mesh that moves rigidly. With P the motion's place, a point x of the lab at time t is at
///
///     P(t_r) P(t)^-1 x
///
/// in the mesh's frame, in which the mesh's points are where they were at the reference time t_r.
class RigidMesh : public MovingMesh {
 public:
  /// @param mesh  in its frame
  /// @param motion  of the mesh
  /// @param reference_time  DEM time, s, for which the mesh's points hold
  RigidMesh(PreparedMesh mesh, std::shared_ptr<const Motion> motion, double reference_time);

  std::unique_ptr<MovingMesh> clone() const override { return std::make_unique<RigidMesh>(*this); }
  void begin_record(double time) override;
  const MeshGeometry& geometry() const override { return *mesh_.geometry; }
  const CellSearch& search() const override { return *mesh_.search; }
  const Eigen::Isometry3d& into_mesh() const override { return into_mesh_; }

 private:
  PreparedMesh mesh_;
  std::shared_ptr<const Motion> motion_;
  Eigen::Isometry3d reference_;
  Eigen::Isometry3d into_mesh_ = Eigen::Isometry3d::Identity();
};

}  // namespace millfoam::averaging
