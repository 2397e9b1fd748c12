// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/fluid_forces.hpp"

#include <algorithm>
#include <cmath>

#include "averaging/files/slurry_file.hpp"
#include "dem_driver/case_folder.hpp"
#include "meshing/mill/mill.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::dem_driver {

namespace {

Vector voxel_vector(const std::vector<double>& values, std::size_t voxel) {
  return {values[3 * voxel], values[3 * voxel + 1], values[3 * voxel + 2]};
}

}  // namespace

double BallInFluid::volume() const {
  return pi / 6 * diameter * diameter * diameter;
}

double share_below(double height, double radius) {
  const double cap = std::clamp(radius - height, 0.0, 2 * radius);
  return cap * cap * (3 * radius - cap) / (4 * radius * radius * radius);
}

FluidForce PoolForces::on(const BallInFluid& ball) const {
  const double share = share_below(ball.position[1] - level_, ball.diameter / 2);
  FluidForce force;
  force.pressure[1] = share * density_ * meshing::gravity * ball.volume();
  return force;
}

std::unique_ptr<FluidForces> make_fluid_forces(const FluidSettings& fluid) {
  if (fluid.kind == FluidKind::slurry) {
    if (file_hash(fluid.file) != fluid.file_id)
      throw averaging::SlurryFileError(fluid.file.string() +
                                       ": has changed since millDem checked it, run millDem again");
    return std::make_unique<VoxelForces>(fluid.file, fluid.time);
  }
  return std::make_unique<PoolForces>(fluid.level, fluid.density);
}

double mixture_factor(double y, double solidity) {
  const double voidage = 1 - solidity;
  return voidage / y + solidity + 0.064 * voidage * y;
}

void VoxelForces::Voxel::add(double weight, const Voxel& other) {
  for (std::size_t k = 0; k < 3; ++k) {
    pressure[k] += weight * other.pressure[k];
    drag[k] += weight * other.drag[k];
  }
  exchange += weight * other.exchange;
  solidity += weight * other.solidity;
  diameter += weight * other.diameter;
}

VoxelForces::VoxelForces(const std::filesystem::path& file, FluidTime time) : reader_(file), time_(time) {
  if (time == FluidTime::windows && reader_.header().windows == 0)
    throw averaging::SlurryFileError(
        file.string() +
        ": has no time windows, only a mean over the run; expected a flow's slurry.h5, "
        "or --fluid-time mean");
  set_time(0);
}

VoxelForces::Field VoxelForces::read(std::size_t window) const {
  const averaging::BallFields fields = time_ == FluidTime::mean ? reader_.mean() : reader_.window(window);
  Field field(reader_.grid().size());
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (!(fields.inside[i] > 0)) continue;
    field[i] = {true,
                voxel_vector(fields.pressure_force, i),
                voxel_vector(fields.drag_force, i),
                fields.exchange[i],
                fields.solidity[i],
                fields.diameter[i]};
  }
  return field;
}

void VoxelForces::set_time(double time) {
  if (time_ == FluidTime::mean) {
    if (early_.empty()) early_ = read(0);
    return;
  }
  const std::size_t last = reader_.header().windows - 1;
  // A run's times rise, so the window of the last call is near
  std::size_t window = window_ > last || time < reader_.middle(window_) ? 0 : window_;
  while (window < last && reader_.middle(window + 1) <= time) ++window;
  const std::size_t next = std::min(window + 1, last);
  if (window != window_) {
    early_ = window == window_ + 1 && !late_.empty() ? std::move(late_) : read(window);
    late_ = read(next);
    window_ = window;
  }
  const double begin = reader_.middle(window), length = reader_.middle(next) - begin;
  blend_ = length > 0 ? std::clamp((time - begin) / length, 0.0, 1.0) : 0;
}

VoxelForces::Neighbours VoxelForces::around(double coordinate, int axis) const {
  const auto a = static_cast<std::size_t>(axis);
  const averaging::BoxGrid& grid = reader_.grid();
  const double place = (coordinate - grid.lower()[a]) / grid.spacing()[a] - 0.5;
  const double below = std::floor(place);
  const int count = grid.shape()[a];
  Neighbours result{{-1, -1}, {1 - (place - below), place - below}};
  for (std::size_t side = 0; side < 2; ++side) {
    const double voxel = below + static_cast<double>(side);
    if (grid.periodic()[a])
      result.voxel[side] = static_cast<int>(voxel - count * std::floor(voxel / count));
    else if (voxel >= 0 && voxel < count)
      result.voxel[side] = static_cast<int>(voxel);
  }
  return result;
}

VoxelForces::Voxel VoxelForces::interpolate(const Field& field,
                                            const std::array<Neighbours, 3>& around) const {
  const averaging::BoxGrid& grid = reader_.grid();
  Voxel sum;
  double weights = 0;
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t i = 0; i < 2; ++i) {
        const averaging::VoxelIndex index{around[0].voxel[i], around[1].voxel[j], around[2].voxel[k]};
        if (index[0] < 0 || index[1] < 0 || index[2] < 0) continue;
        const Voxel& voxel = field[grid.offset(index)];
        if (!voxel.fluid) continue;
        const double weight = around[0].weight[i] * around[1].weight[j] * around[2].weight[k];
        sum.add(weight, voxel);
        weights += weight;
      }
  if (!(weights > 0)) return {};
  Voxel mean;
  mean.add(1 / weights, sum);
  mean.fluid = true;
  return mean;
}

FluidForce VoxelForces::on(const BallInFluid& ball) const {
  const auto& x = ball.position;
  const std::array<Neighbours, 3> places{around(x[0], 0), around(x[1], 1), around(x[2], 2)};
  Voxel felt = interpolate(early_, places);
  if (blend_ > 0) {
    const Voxel late = interpolate(late_, places);
    if (felt.fluid && late.fluid) {
      Voxel between;
      between.add(1 - blend_, felt);
      between.add(blend_, late);
      between.fluid = true;
      felt = between;
    } else if (late.fluid) {
      felt = late;
    }
  }
  FluidForce force;
  force.known = felt.fluid;
  if (!felt.fluid) return force;
  double factor = 1;
  if (reader_.header().polydispersity && felt.diameter > 0)
    factor = mixture_factor(ball.diameter / felt.diameter, felt.solidity);
  const double volume = ball.volume();
  for (std::size_t k = 0; k < 3; ++k) {
    force.pressure[k] = volume * felt.pressure[k];
    force.drag[k] = volume * factor * (felt.drag[k] - felt.exchange * ball.velocity[k]);
  }
  return force;
}

}  // namespace millfoam::dem_driver
