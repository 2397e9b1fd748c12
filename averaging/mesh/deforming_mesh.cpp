// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/deforming_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace millfoam::averaging {

MeshSeries::MeshSeries(const std::filesystem::path& path) : path_(path), reader_(path) {}

MeshSeries::Shared MeshSeries::read(std::size_t number) const {
  const std::lock_guard lock(mutex_);
  for (const auto& [known, points] : kept_) {
    if (points && known == number) return points;
  }
  auto points = std::make_shared<const MeshPoints>(reader_.read_points(number));
  kept_[0] = std::exchange(kept_[1], {number, points});
  return points;
}

MeshPoints MeshSeries::points_at(double time) const {
  const std::vector<double>& times = reader_.times();
  const double flow_time = time - reader_.time0();
  // A DEM time that was made by adding the same time0 may have lost its last digit.
  const double rounding = 1e-12 * std::max(std::abs(time), std::abs(reader_.time0()));
  if (!(flow_time >= times.front() - rounding && flow_time <= times.back() + rounding)) {
    std::ostringstream message;
    message << path_.string() << ": DEM time " << time << " s is outside the mesh's times, which go from "
            << begin() << " to " << end() << " s";
    throw std::out_of_range(message.str());
  }
  const auto above = std::upper_bound(times.begin(), times.end(), flow_time);
  const auto next = static_cast<std::size_t>(above - times.begin());
  if (next == 0) return *read(0);
  if (next == times.size()) return *read(next - 1);
  const Shared before = read(next - 1), after = read(next);
  const double part = (flow_time - times[next - 1]) / (times[next] - times[next - 1]);
  MeshPoints points(*before);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] += part * ((*after)[i] - points[i]);
  return points;
}

DeformingMesh::DeformingMesh(std::shared_ptr<const MeshSeries> series)
    : series_(std::move(series)),
      geometry_(series_->topology(), series_->points_at(series_->begin())),
      tree_(geometry_) {}

void DeformingMesh::begin_record(double time) {
  const MeshPoints points = series_->points_at(time);
  try {
    geometry_.move(points);
  } catch (const std::invalid_argument& error) {
    std::ostringstream message;
    message << series_->path().string() << ": at DEM time " << time << " s: " << error.what();
    throw std::invalid_argument(message.str());
  }
  tree_.update();
}

}  // namespace millfoam::averaging
