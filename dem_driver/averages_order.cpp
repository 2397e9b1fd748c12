// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/averages_order.hpp"

#include <optional>
#include <sstream>
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
  return {{"kind", "cells"},           {"mesh", path(mesh.file)},
          {"motion", motion},          {"at_rest", mesh.at_rest},
          {"period_m", mesh.period_z}, {"smoothing_m", mesh.smoothed ? Json(mesh.smoothing) : Json()}};
}

GridRequest grid_of(const JsonObject& json, const fs::path& folder) {
  const auto kind = json.get<std::string>("kind");
  if (kind == "box")
    return BoxGrid(json.get<averaging::Vector3>("lower_m"), json.get<averaging::Vector3>("upper_m"),
                   json.get<averaging::VoxelIndex>("shape"), json.get<std::array<bool, 3>>("periodic"));
  if (kind == "cylinder") {
    CylinderRequest cylinder(
        CylinderGrid(json.get<std::array<double, 2>>("radii_m"), json.get<std::array<double, 2>>("ends_m"),
                     json.get<averaging::VoxelIndex>("shape"), json.get<bool>("periodic")));
    cylinder.cylindrical = json.get<bool>("cylindrical");
    cylinder.turning = json.get<bool>("turning");
    return cylinder;
  }
  MeshRequest mesh;
  mesh.file = folder / json.get<std::string>("mesh");
  mesh.motion = json.get<std::vector<std::string>>("motion");
  mesh.at_rest = json.get<bool>("at_rest");
  mesh.period_z = json.get_or_null<double>("period_m");
  const auto smoothing = json.get_or_null<double>("smoothing_m");
  mesh.smoothed = smoothing.has_value();
  mesh.smoothing = smoothing.value_or(mesh.smoothing);
  return mesh;
}

Json request_json(const AverageRequest& request, const PathAs& path) {
  Json walls = Json::array(), windows = Json::array();
  for (const fs::path& file : request.walls) walls.push_back(path(file));
  for (const averaging::WindowsRequest& series : request.windows) windows.push_back(series.length);
  return {{"grid", std::visit([&](const auto& grid) { return grid_json(grid, path); }, request.grid)},
          {"method", request.method == DepositionMethod::exact ? "exact" : "sample"},
          {"template", request.template_points},
          {"walls", walls},
          {"solidity_cap", request.solidity_cap},
          {"windows_s", windows},
          {"start_s", request.start},
          {"end_s", request.end},
          {"largest_outside", request.largest_outside}};
}

AverageRequest request_of(const JsonObject& json, const fs::path& folder) {
  AverageRequest request(grid_of(json.object("grid"), folder));
  const bool exact = json.get<std::string>("method") == "exact";
  request.method = exact ? DepositionMethod::exact : DepositionMethod::sample;
  request.template_points = json.get<int>("template");
  for (const auto& wall : json.get<std::vector<std::string>>("walls")) request.walls.push_back(folder / wall);
  request.solidity_cap = json.get_or_null<double>("solidity_cap");
  for (const auto& length : json.get<std::vector<std::optional<double>>>("windows_s"))
    request.windows.push_back({length, {}});
  request.start = json.get_or_null<double>("start_s");
  request.end = json.get_or_null<double>("end_s");
  request.largest_outside = json.get<double>("largest_outside");
  return request;
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
  const JsonObject json = read_order(file, order_format);
  AveragesOrder order;
  order.run.settings.timestep = json.get<double>("timestep_s");
  order.run.settings.angular_velocity = json.get<double>("angular_velocity_rad_s");
  order.run.settings.sauter_diameter = json.get<double>("sauter_diameter_m");
  order.run.begin = json.get<long long>("begin");
  order.run.interval = json.get<long long>("interval");
  order.run.balls = json.get<long long>("balls");
  for (const JsonObject& averages : json.objects("averages"))
    order.averages.push_back({averages.get<std::string>("id"), request_of(averages, file.parent_path())});
  return order;
}

}  // namespace millfoam::dem_driver
