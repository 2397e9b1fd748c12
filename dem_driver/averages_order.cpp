// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/averages_order.hpp"

#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <variant>

#include "dem_driver/json_file.hpp"
#include "meshing/files/file_fingerprint.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

using averaging::AverageRequest;
using averaging::BoxGrid;
using averaging::CylinderGrid;
using averaging::CylinderRequest;
using averaging::DepositionMethod;
using averaging::GridRequest;
using averaging::MeshRequest;

namespace {

constexpr char order_format[] = "millfoam-live-averages";

/// How a file of a request is written in JSON.
using PathAs = std::function<std::string(const fs::path&)>;

Json optional_number(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

std::optional<double> optional_number(const Json& value) {
  return value.is_null() ? std::nullopt : std::optional<double>(value.get<double>());
}

/// A text of a motion with the name of its table replaced.
std::string with_table(const std::string& motion, const PathAs& path) {
  std::istringstream words(motion);
  std::string kind, source, file, rest;
  if (!(words >> kind >> source >> file) || source != "table") return motion;
  std::getline(words, rest);
  return kind + ' ' + source + ' ' + path(file) + rest;
}

Json grid_json(const BoxGrid& grid, const PathAs&) {
  return {{"kind", "box"},
          {"lower_m", grid.lower()},
          {"upper_m", grid.upper()},
          {"shape", grid.shape()},
          {"periodic", grid.periodic()}};
}

Json grid_json(const CylinderRequest& cylinder, const PathAs&) {
  const CylinderGrid& grid = cylinder.grid;
  return {
      {"kind", "cylinder"},         {"radii_m", grid.radii()},       {"ends_m", grid.ends()},
      {"shape", grid.shape()},      {"periodic", grid.periodic_z()}, {"cylindrical", cylinder.cylindrical},
      {"turning", cylinder.turning}};
}

Json grid_json(const MeshRequest& mesh, const PathAs& path) {
  Json motion = Json::array();
  for (const std::string& text : mesh.motion) motion.push_back(with_table(text, path));
  return {{"kind", "cells"},
          {"mesh", path(mesh.file)},
          {"motion", motion},
          {"at_rest", mesh.at_rest},
          {"period_m", optional_number(mesh.period_z)},
          {"smoothing_m", mesh.smoothed ? Json(mesh.smoothing) : Json()}};
}

GridRequest grid_of(const Json& json) {
  const auto kind = json.at("kind").get<std::string>();
  if (kind == "box")
    return BoxGrid(json.at("lower_m"), json.at("upper_m"), json.at("shape"), json.at("periodic"));
  if (kind == "cylinder") {
    CylinderRequest cylinder(CylinderGrid(json.at("radii_m"), json.at("ends_m"), json.at("shape"),
                                          json.at("periodic").get<bool>()));
    cylinder.cylindrical = json.at("cylindrical");
    cylinder.turning = json.at("turning");
    return cylinder;
  }
  MeshRequest mesh;
  mesh.file = json.at("mesh").get<std::string>();
  mesh.motion = json.at("motion").get<std::vector<std::string>>();
  mesh.at_rest = json.at("at_rest");
  mesh.period_z = optional_number(json.at("period_m"));
  mesh.smoothed = !json.at("smoothing_m").is_null();
  if (mesh.smoothed) mesh.smoothing = json.at("smoothing_m");
  return mesh;
}

Json request_json(const AverageRequest& request, const PathAs& path) {
  Json walls = Json::array(), windows = Json::array();
  for (const fs::path& file : request.walls) walls.push_back(path(file));
  for (const averaging::WindowsRequest& series : request.windows)
    windows.push_back(optional_number(series.length));
  return {{"grid", std::visit([&](const auto& grid) { return grid_json(grid, path); }, request.grid)},
          {"method", request.method == DepositionMethod::exact ? "exact" : "sample"},
          {"template", request.template_points},
          {"walls", walls},
          {"solidity_cap", optional_number(request.solidity_cap)},
          {"windows_s", windows},
          {"start_s", optional_number(request.start)},
          {"end_s", optional_number(request.end)},
          {"largest_outside", request.largest_outside}};
}

AverageRequest request_of(const Json& json, const fs::path& folder) {
  AverageRequest request(grid_of(json.at("grid")));
  if (auto* mesh = std::get_if<MeshRequest>(&request.grid)) mesh->file = folder / mesh->file;
  request.method = json.at("method") == "exact" ? DepositionMethod::exact : DepositionMethod::sample;
  request.template_points = json.at("template");
  for (const Json& file : json.at("walls")) request.walls.push_back(folder / file.get<std::string>());
  request.solidity_cap = optional_number(json.at("solidity_cap"));
  for (const Json& length : json.at("windows_s")) request.windows.push_back({optional_number(length), {}});
  request.start = optional_number(json.at("start_s"));
  request.end = optional_number(json.at("end_s"));
  request.largest_outside = json.at("largest_outside");
  return request;
}

AveragesOrder order_of(const Json& json, const fs::path& folder) {
  AveragesOrder order;
  order.run.settings.timestep = json.at("timestep_s");
  order.run.settings.angular_velocity = json.at("angular_velocity_rad_s").get<double>();
  order.run.settings.sauter_diameter = json.at("sauter_diameter_m");
  order.run.begin = json.at("begin");
  order.run.interval = json.at("interval");
  order.run.balls = json.at("balls");
  for (const Json& averages : json.at("averages"))
    order.averages.push_back({averages.at("id"), request_of(averages, folder)});
  return order;
}

}  // namespace

std::string averages_id(const AverageRequest& request) {
  return fingerprint(request_json(request, file_fingerprint).dump());
}

averaging::LiveFiles averages_files(const fs::path& dem, std::size_t number) {
  return {dem / ("averages_" + std::to_string(number + 1))};
}

void write_averages_order(const fs::path& file, const meshing::Mill& mill, const AveragesOrder& order) {
  const fs::path folder = fs::absolute(file).parent_path();
  const PathAs path = [&](const fs::path& of) { return fs::relative(of, folder).string(); };
  const averaging::LiveRun& run = order.run;
  Json json = begin_result("live-averages", mill);
  json["timestep_s"] = run.settings.timestep;
  json["angular_velocity_rad_s"] = run.settings.angular_velocity.value_or(0);
  json["sauter_diameter_m"] = run.settings.sauter_diameter;
  json["begin"] = run.begin;
  json["interval"] = run.interval;
  json["balls"] = run.balls;
  json["averages"] = Json::array();
  for (const OrderedAverages& averages : order.averages) {
    Json entry = {{"id", averages.id}};
    entry.update(request_json(averages.request, path));
    json["averages"].push_back(entry);
  }
  write_json(file, json);
}

AveragesOrder read_averages_order(const fs::path& file) {
  std::ifstream in(file);
  if (!in)
    throw std::runtime_error(file.string() + ": cannot be read, expected the file that millDem writes");
  const Json json = Json::parse(in, nullptr, false);
  if (!json.is_object() || json.value("format", std::string()) != order_format)
    throw std::runtime_error(file.string() + ": is not of the format " + order_format +
                             ": run millDem again");
  try {
    return order_of(json, file.parent_path());
  } catch (const Json::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what() + ": run millDem again");
  }
}

}  // namespace millfoam::dem_driver
