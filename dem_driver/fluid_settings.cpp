// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/fluid_settings.hpp"

#include <cassert>
#include <fstream>
#include <stdexcept>

#include "dem_driver/json_file.hpp"
#include "dem_driver/pairs.hpp"
#include "meshing/files/text_numbers.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

constexpr char order_format[] = "millfoam-fluid";

/// A value of a JSON object of a file, which messages name.
template <typename Value>
Value value_of(const Json& json, const char* key, const fs::path& file) {
  try {
    return json.at(key).get<Value>();
  } catch (const Json::exception&) {
    throw std::runtime_error(file.string() + ": key '" + key + "' is missing or wrong: run millDem again");
  }
}

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

ExchangeOrder read_exchange(const Json& json, const fs::path& file) {
  ExchangeOrder order{{value_of<averaging::Vector3>(json, "lower_m", file),
                       value_of<averaging::Vector3>(json, "upper_m", file),
                       value_of<averaging::VoxelIndex>(json, "shape", file),
                       value_of<std::array<bool, 3>>(json, "periodic", file)}};
  order.exact = value_of<bool>(json, "exact", file);
  order.template_points = value_of<int>(json, "template_points", file);
  for (const auto& wall : value_of<std::vector<std::string>>(json, "walls", file))
    order.walls.push_back(file.parent_path() / wall);
  order.angular_velocity = value_of<double>(json, "angular_velocity_rad_s", file);
  order.mill = value_of<std::string>(json, "averages", file);
  order.ball_density = value_of<double>(json, "ball_density_kg_m3", file);
  order.smallest_ball = value_of<double>(json, "smallest_ball_m", file);
  order.rayleigh_fraction = value_of<double>(json, "rayleigh_fraction", file);
  order.begin = value_of<long>(json, "begin", file);
  order.end = value_of<long>(json, "end", file);
  return order;
}

void add_shapes(Json& json, const ShapeDrag& shapes) {
  if (shapes.bed.empty()) return;
  json["slurry"] = {{"density_kg_m3", shapes.slurry.density}, {"viscosity_Pa_s", shapes.slurry.viscosity}};
  for (const drag::ShapeShare& part : shapes.bed)
    json["shapes"].push_back({{"share", part.share}, {"sphericity", part.shape.sphericity}});
}

ShapeDrag read_shapes(const Json& json, const fs::path& file) {
  ShapeDrag shapes;
  if (!json.contains("shapes")) return shapes;
  const auto slurry = value_of<Json>(json, "slurry", file);
  shapes.slurry = {value_of<double>(slurry, "density_kg_m3", file),
                   value_of<double>(slurry, "viscosity_Pa_s", file)};
  for (const auto& part : value_of<std::vector<Json>>(json, "shapes", file)) {
    const auto sphericity = value_of<double>(part, "sphericity", file);
    shapes.bed.push_back({value_of<double>(part, "share", file), {sphericity, sphericity}});
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
  std::ifstream in(file);
  if (!in)
    throw std::runtime_error(file.string() + ": cannot be read, expected the file that millDem writes");
  const Json json = Json::parse(in, nullptr, false);
  if (!json.is_object() || value_of<std::string>(json, "format", file) != order_format)
    throw std::runtime_error(file.string() + ": is not of the format " + order_format +
                             ": run millDem again");
  FluidOrder order;
  order.timestep = value_of<double>(json, "timestep_s", file);
  order.record_steps = value_of<long>(json, "interval", file);
  const auto kind = value_of<std::string>(json, "kind", file);
  if (kind == name_of(FluidKind::flow)) {
    order.fluid.kind = FluidKind::flow;
    order.fluid.file = file.parent_path() / value_of<std::string>(json, "folder", file);
    order.exchange = read_exchange(value_of<Json>(json, "exchange", file), file);
  } else if (kind == name_of(FluidKind::buoyancy)) {
    order.fluid.kind = FluidKind::buoyancy;
    order.fluid.level = value_of<double>(json, "level_m", file);
    order.fluid.density = value_of<double>(json, "density_kg_m3", file);
  } else {
    order.fluid.kind = FluidKind::slurry;
    order.fluid.file = file.parent_path() / value_of<std::string>(json, "file", file);
    order.fluid.file_id = value_of<std::string>(json, "file_id", file);
    const bool windows = value_of<std::string>(json, "time", file) == name_of(FluidTime::windows);
    order.fluid.time = windows ? FluidTime::windows : FluidTime::mean;
  }
  order.fluid.shapes = read_shapes(json, file);
  return order;
}

}  // namespace millfoam::dem_driver
