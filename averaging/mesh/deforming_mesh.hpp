// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <mutex>
#include <utility>

#include "averaging/mesh/cell_tree.hpp"
#include "averaging/mesh/mesh_file.hpp"
#include "averaging/mesh/moving_mesh.hpp"

namespace millfoam::averaging {

/// The points of a mesh file over time, linear between the file's times. It keeps the points of two times,
/// and may be used by several threads.
class MeshSeries {
 public:
  /// Throws as MeshReader.
  explicit MeshSeries(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }                 ///< of the file
  const MeshTopology& topology() const { return reader_.topology(); }         ///< the same at all times
  double begin() const { return reader_.time0() + reader_.times().front(); }  ///< DEM time, s
  double end() const { return reader_.time0() + reader_.times().back(); }     ///< DEM time, s

  /// Points at a DEM time, s. Throws std::out_of_range, naming the file and the time, outside [begin, end],
  /// and MeshFileError.
  MeshPoints points_at(double time) const;

 private:
  using Shared = std::shared_ptr<const MeshPoints>;
  Shared read(std::size_t number) const;

  std::filesystem::path path_;
  MeshReader reader_;
  mutable std::mutex mutex_;
  mutable std::array<std::pair<std::size_t, Shared>, 2> kept_;
};

/// A mesh whose points are given over time, in the lab's frame.
class DeformingMesh : public MovingMesh {
 public:
  /// Throws as MeshGeometry for the first of the series' times.
  explicit DeformingMesh(std::shared_ptr<const MeshSeries> series);

  std::unique_ptr<MovingMesh> clone() const override { return std::make_unique<DeformingMesh>(series_); }

  /// Throws as `MeshSeries::points_at`, and std::invalid_argument naming the file, the time and the cell when
  /// a cell is turned inside out.
  void begin_record(double time) override;

  const MeshGeometry& geometry() const override { return geometry_; }
  const CellSearch& search() const override { return tree_; }
  const Eigen::Isometry3d& into_mesh() const override { return stays_; }

 private:
  std::shared_ptr<const MeshSeries> series_;
  MeshGeometry geometry_;
  CellTree tree_;
  Eigen::Isometry3d stays_ = Eigen::Isometry3d::Identity();
};

}  // namespace millfoam::averaging
