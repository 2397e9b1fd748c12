// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/fluid_settings.hpp"

#include <cassert>
#include <fstream>
#include <stdexcept>

#include "dem_driver/json_file.hpp"
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

}  // namespace

std::string name_of(FluidKind kind) {
  if (kind == FluidKind::none) return "none";
  return kind == FluidKind::buoyancy ? "buoyancy" : "slurry";
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
  }
  return {};
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
  } else {
    json["file"] = fs::relative(fluid.file, file.parent_path()).string();
    json["file_id"] = fluid.file_id;
    json["time"] = name_of(fluid.time);
  }
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
  if (value_of<std::string>(json, "kind", file) == name_of(FluidKind::buoyancy)) {
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
  return order;
}

}  // namespace millfoam::dem_driver
