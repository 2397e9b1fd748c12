// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/cell_setup.hpp"

#include <stdexcept>

#include "averaging/grids/neighbours.hpp"
#include "averaging/sharing/box_exact.hpp"
#include "averaging/sharing/box_sampling.hpp"

namespace millfoam::averaging {

namespace {

std::unique_ptr<CellSharing> sharing(const BoxGrid& grid, SharingMethod method, int points) {
  if (method == SharingMethod::exact) return std::make_unique<BoxExact>(grid, points);
  return std::make_unique<BoxSampling>(grid, points);
}

}  // namespace

CellSetup set_up(const AverageRequest& request, const RunSettings&,
                 const std::function<void(const std::string&)>&) {
  const auto& grid = std::get<BoxGrid>(request.grid);
  CellSetup setup{grid, sharing(grid, request.method, request.template_points), {}, nullptr, nullptr, {}, 0};
  setup.room.neighbours = neighbours(grid);
  return setup;
}

}  // namespace millfoam::averaging
