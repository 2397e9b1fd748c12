// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/contact_order.hpp"

#include <algorithm>

#include "dem_driver/json_file.hpp"
#include "dem_driver/wall_parts.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

constexpr char contact_order_format[] = "millfoam-contacts";
constexpr double cells_per_diameter = 60;
/// A stirred mill's triangles are five times as long as wide, and so are their cells.
constexpr double stirred_cells_per_diameter = 15;
constexpr long wall_records = 10;  // of a run

}  // namespace

ContactKinds ContactOrder::kinds() const {
  return {static_cast<int>(diameters.size()), static_cast<int>(parts.size())};
}

bool ContactOrder::turns(std::size_t part) const {
  return std::find(turning_parts.begin(), turning_parts.end(), parts[part]) != turning_parts.end();
}

WallCells ContactOrder::cells() const {
  return {walls, parts, cell_edge};
}

ContactOrder contact_order_of(const meshing::Mill& mill, const DemPlan& plan,
                              const std::vector<std::string>& parts, const fs::path& walls) {
  ContactOrder order;
  // Shapes of the same volume are one class
  for (const auto& size : plan.charge.classes)
    if (std::find(order.diameters.begin(), order.diameters.end(), size.diameter) == order.diameters.end())
      order.diameters.push_back(size.diameter);
  order.parts = parts;
  order.turning_parts = turning_parts(mill, parts);
  order.timestep = plan.step.value;
  order.angular_velocity = mill.angular_velocity;
  const bool stirred = mill.machine() == meshing::Machine::stirred;
  order.cell_edge = mill.geometry.diameter / (stirred ? stirred_cells_per_diameter : cells_per_diameter);
  order.end_step = plan.end_step();
  order.block_steps = plan.restart_steps;
  order.wall_steps = (plan.turning_steps + wall_records - 1) / wall_records;
  order.walls = walls;
  return order;
}

void write_contact_order(const fs::path& file, const meshing::Mill& mill, const ContactOrder& order) {
  Json json = begin_result("contacts", mill);
  json.update({{"diameters_m", order.diameters},
               {"parts", order.parts},
               {"turning_parts", order.turning_parts},
               {"walls", fs::relative(order.walls, file.parent_path()).string()},
               {"timestep_s", order.timestep},
               {"angular_velocity_rad_s", order.angular_velocity},
               {"cell_edge_m", order.cell_edge},
               {"end_step", order.end_step},
               {"block_steps", order.block_steps},
               {"wall_steps", order.wall_steps}});
  write_json(file, json);
}

ContactOrder read_contact_order(const fs::path& file) {
  const JsonObject json = read_order(file, contact_order_format);
  ContactOrder order;
  order.diameters = json.get<std::vector<double>>("diameters_m");
  order.parts = json.get<std::vector<std::string>>("parts");
  order.turning_parts = json.get<std::vector<std::string>>("turning_parts");
  order.walls = file.parent_path() / json.get<std::string>("walls");
  order.timestep = json.get<double>("timestep_s");
  order.angular_velocity = json.get<double>("angular_velocity_rad_s");
  order.cell_edge = json.get<double>("cell_edge_m");
  order.end_step = json.get<long>("end_step");
  order.block_steps = json.get<long>("block_steps");
  order.wall_steps = json.get<long>("wall_steps");
  return order;
}

}  // namespace millfoam::dem_driver
