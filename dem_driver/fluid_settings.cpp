// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/fluid_settings.hpp"

#include <cassert>

#include "dem_driver/json_file.hpp"
#include "dem_driver/pairs.hpp"
#include "meshing/files/text_numbers.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

constexpr char order_format[] = "millfoam-fluid";

Json to_json(const ExchangeOrder& order) {
  Json json;
  json["lower_m"] = order.grid.lower();
  json["upper_m"] = order.grid.upper();
  json["shape"] = order.grid.shape();
  json["periodic"] = order.grid.periodic();
  json["exact"] = order.exact;
  json["template_points"] = order.template_points;
  json["walls"] = Json::array();
  for (const fs::path& wall : order.walls) json["walls"].push_back(wall.string());
  json["angular_velocity_rad_s"] = order.angular_velocity;
  json["averages"] = order.mill;
  json["ball_density_kg_m3"] = order.ball_density;
  json["smallest_ball_m"] = order.smallest_ball;
  json["rayleigh_fraction"] = order.rayleigh_fraction;
  json["begin"] = order.begin;
  json["end"] = order.end;
  return json;
}

ExchangeOrder read_exchange(const JsonObject& json, const fs::path& folder) {
  ExchangeOrder order{{json.get<averaging::Vector3>("lower_m"), json.get<averaging::Vector3>("upper_m"),
                       json.get<averaging::VoxelIndex>("shape"), json.get<std::array<bool, 3>>("periodic")}};
  order.exact = json.get<bool>("exact");
  order.template_points = json.get<int>("template_points");
  for (const auto& wall : json.get<std::vector<std::string>>("walls")) order.walls.push_back(folder / wall);
  order.angular_velocity = json.get<double>("angular_velocity_rad_s");
  order.mill = json.get<std::string>("averages");
  order.ball_density = json.get<double>("ball_density_kg_m3");
  order.smallest_ball = json.get<double>("smallest_ball_m");
  order.rayleigh_fraction = json.get<double>("rayleigh_fraction");
  order.begin = json.get<long>("begin");
  order.end = json.get<long>("end");
  return order;
}

void add_shapes(Json& json, const ShapeDrag& shapes) {
  if (shapes.bed.empty()) return;
  json["slurry"] = {{"density_kg_m3", shapes.slurry.density}, {"viscosity_Pa_s", shapes.slurry.viscosity}};
  for (const drag::ShapeShare& part : shapes.bed)
    json["shapes"].push_back({{"share", part.share}, {"sphericity", part.shape.sphericity}});
}

ShapeDrag read_shapes(const JsonObject& json) {
  ShapeDrag shapes;
  if (!json.contains("shapes")) return shapes;
  const JsonObject slurry = json.object("slurry");
  shapes.slurry = {slurry.get<double>("density_kg_m3"), slurry.get<double>("viscosity_Pa_s")};
  for (const JsonObject& part : json.objects("shapes")) {
    const auto sphericity = part.get<double>("sphericity");
    shapes.bed.push_back({part.get<double>("share"), {sphericity, sphericity}});
  }
  return shapes;
}

}  // namespace

std::string name_of(FluidKind kind) {
  switch (kind) {
    case FluidKind::none:
      return "none";
    case FluidKind::buoyancy:
      return "buoyancy";
    case FluidKind::slurry:
      return "slurry";
    case FluidKind::flow:
      return "flow";
  }
  return {};
}

std::string name_of(FluidTime time) {
  return time == FluidTime::mean ? "mean" : "windows";
}

FluidSettings fluid_of(const meshing::Mill& mill) {
  FluidSettings fluid;
  if (!mill.dem.pool_level) return fluid;
  fluid.kind = FluidKind::buoyancy;
  fluid.level = *mill.dem.pool_level;
  fluid.density = mill.slurry.density;
  return fluid;
}

std::string in_words(const FluidSettings& fluid) {
  switch (fluid.kind) {
    case FluidKind::none:
      return "none";
    case FluidKind::buoyancy:
      return "buoyancy in a pool of " + shown(fluid.density) + " kg/m3 up to y = " + shown(fluid.level) +
             " m";
    case FluidKind::slurry:
      return "forces of a flow (slurry.h5 " + fluid.file_id + ", " + name_of(fluid.time) + ")";
    case FluidKind::flow:
      return "forces of a flow that runs at the same time and gets " + fluid.averages;
  }
  return {};
}

namespace {

/// The voxels on which balls meet a flow that runs at the same time.
meshing::Voxels exchange_voxels(const meshing::Mill& mill) {
  return mill.flow.coupling.voxels.value_or(mill.averages.voxels);
}

}  // namespace

std::string averages_in_words(const meshing::Mill& mill) {
  const meshing::Voxels voxels = exchange_voxels(mill);
  const std::string method =
      mill.averages.method == "exact"
          ? "exact averages"
          : "averages by " + std::to_string(mill.averages.template_points) + " points along a diameter";
  const auto point = [](const std::array<double, 3>& at) {
    return "(" + exact(at[0]) + " " + exact(at[1]) + " " + exact(at[2]) + ")";
  };
  return method + " on " + std::to_string(voxels.shape[0]) + " x " + std::to_string(voxels.shape[1]) + " x " +
         std::to_string(voxels.shape[2]) + " voxels from " + point(voxels.lower) + " to " +
         point(voxels.upper) + " m";
}

ExchangeOrder exchange_of(const meshing::Mill& mill, const std::vector<fs::path>& walls, long begin,
                          long end) {
  const meshing::Voxels voxels = exchange_voxels(mill);
  const bool periodic = mill.geometry.ends == meshing::Ends::periodic;
  ExchangeOrder order{{voxels.lower, voxels.upper, voxels.shape, {false, false, periodic}}};
  order.exact = mill.averages.method == "exact";
  order.template_points = mill.averages.template_points;
  order.walls = walls;
  order.angular_velocity = mill.angular_velocity;
  order.mill = mill.fingerprint.averages;
  order.ball_density = mill.ball.density;
  order.smallest_ball = smallest_simulated(mill);
  order.rayleigh_fraction = mill.dem.rayleigh_fraction;
  order.begin = begin;
  order.end = end;
  return order;
}

void write_fluid_order(const fs::path& file, const meshing::Mill& mill, const FluidOrder& order) {
  const FluidSettings& fluid = order.fluid;
  assert(fluid.kind != FluidKind::none);
  Json json = begin_result("fluid", mill);
  json["kind"] = name_of(fluid.kind);
  json["timestep_s"] = order.timestep;
  json["interval"] = order.record_steps;
  if (fluid.kind == FluidKind::buoyancy) {
    json["level_m"] = fluid.level;
    json["density_kg_m3"] = fluid.density;
  } else if (fluid.kind == FluidKind::flow) {
    json["folder"] = fs::relative(fluid.file, file.parent_path()).string();
    json["exchange"] = to_json(order.exchange.value());
  } else {
    json["file"] = fs::relative(fluid.file, file.parent_path()).string();
    json["file_id"] = fluid.file_id;
    json["time"] = name_of(fluid.time);
  }
  add_shapes(json, fluid.shapes);
  write_json(file, json);
}

FluidOrder read_fluid_order(const fs::path& file) {
  const JsonObject json = read_order(file, order_format);
  FluidOrder order;
  order.timestep = json.get<double>("timestep_s");
  order.record_steps = json.get<long>("interval");
  const auto kind = json.get<std::string>("kind");
  if (kind == name_of(FluidKind::flow)) {
    order.fluid.kind = FluidKind::flow;
    order.fluid.file = file.parent_path() / json.get<std::string>("folder");
    order.exchange = read_exchange(json.object("exchange"), file.parent_path());
  } else if (kind == name_of(FluidKind::buoyancy)) {
    order.fluid.kind = FluidKind::buoyancy;
    order.fluid.level = json.get<double>("level_m");
    order.fluid.density = json.get<double>("density_kg_m3");
  } else {
    order.fluid.kind = FluidKind::slurry;
    order.fluid.file = file.parent_path() / json.get<std::string>("file");
    order.fluid.file_id = json.get<std::string>("file_id");
    const bool windows = json.get<std::string>("time") == name_of(FluidTime::windows);
    order.fluid.time = windows ? FluidTime::windows : FluidTime::mean;
  }
  order.fluid.shapes = read_shapes(json);
  return order;
}

}  // namespace millfoam::dem_driver
