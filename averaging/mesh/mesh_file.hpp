// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "averaging/mesh/poly_mesh.hpp"

/// @file
/// mesh.h5, by which a flow's mesh reaches this room. Layout: FORMATS.md.

namespace millfoam::averaging {

/// The version of the layout that is written and that can be read.
inline constexpr int mesh_version = 1;

/// A mesh file that cannot be read or written; the message names the file and the reason.
class MeshFileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws MeshFileError when there is something at `path` that is no mesh file, so that no other file is lost
/// to a name typed wrong.
void require_mesh_or_nothing(const std::filesystem::path& path);

/// Writes a mesh and its points at one or many times. Until `finish` the file is called `path` + ".part" and
/// says that it is not complete. All members throw MeshFileError.
class MeshWriter {
 public:
  /// Makes `path` + ".part", replacing an older one.
  /// @param path   of the finished file
  /// @param topology  faces and cells, the same at all times
  /// @param time0  DEM time, s, at flow time 0
  MeshWriter(const std::filesystem::path& path, const MeshTopology& topology, double time0);
  ~MeshWriter();
  MeshWriter(const MeshWriter&) = delete;
  MeshWriter& operator=(const MeshWriter&) = delete;

  /// Appends the points at a flow time, s, after the last one.
  void append(double time, const MeshPoints& points);

  /// Marks the file complete and gives it its name, replacing an older file. Throws when no points were
  /// appended.
  void finish();

 private:
  struct Open;
  std::filesystem::path path_;
  std::filesystem::path part_;
  std::unique_ptr<Open> open_;
};

/// Reads a mesh file.
class MeshReader {
 public:
  /// Opens and checks the file: there, HDF5, of this format and version, complete, a topology that `check`
  /// accepts, times in order. Throws MeshFileError.
  explicit MeshReader(const std::filesystem::path& path);
  ~MeshReader();
  /// Takes over the open file; the other reader must not be used any more.
  MeshReader(MeshReader&&) noexcept;
  MeshReader& operator=(MeshReader&&) noexcept;

  const MeshTopology& topology() const;      ///< faces and cells, the same at all times
  double time0() const;                      ///< DEM time, s, at flow time 0
  const std::vector<double>& times() const;  ///< flow times, s, rising; at least one

  /// Points at time `number`, from 0. Throws MeshFileError for a number beyond the last or a coordinate that
  /// is not finite.
  MeshPoints read_points(std::size_t number) const;

 private:
  struct Open;
  std::filesystem::path path_;
  std::unique_ptr<Open> open_;
};

}  // namespace millfoam::averaging
