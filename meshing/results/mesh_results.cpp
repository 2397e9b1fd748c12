// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/results/mesh_results.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "meshing/files/file_fingerprint.hpp"
#include "meshing/files/json_object.hpp"
#include "meshing/files/output_file.hpp"
#include "meshing/mill/mill_fingerprints.hpp"
#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/resolved_mill.hpp"
#include "meshing/walls/wall_files.hpp"

namespace millfoam::meshing {
namespace {

using Json = nlohmann::ordered_json;

void write_json(const std::filesystem::path& file, const Json& json) {
  write_file(file, [&](std::ostream& out) { out << json.dump(2) << '\n'; });
}

Json limited(double value, double limit) {
  return {{"value", value}, {"limit", limit}};
}

}  // namespace

void write_mesh_results(const MillDescription& description, const VolumeMesh& mesh,
                        const MeshQuality& quality, const Openings& openings, double time,
                        const std::filesystem::path& case_folder, const QualityLimits& limits) {
  const double closed_form = flow_volume(description.mill.geometry);
  Json json = result_head("millfoam-mesh", "millMesh", to_json(description.mill.fingerprint));
  json["time0_s"] = time;
  json["cells"] = mesh.cells;
  json["cells_in_section"] = openings.compartment.size();
  json["faces"] = mesh.faces.size();
  json["volume_m3"] = quality.volume;
  json["closed_form_volume_m3"] = closed_form;
  json["quality"] = {
      {"volume_error", limited(std::abs(quality.volume / closed_form - 1), limits.volume_error)},
      {"non_orthogonality_deg", limited(quality.max_non_orthogonality, limits.non_orthogonality)},
      {"skewness", limited(quality.max_skewness, limits.skewness)},
      {"volume_ratio", limited(quality.max_volume_ratio, limits.volume_ratio)}};
  json["smallest_cell_m3"] = quality.smallest_cell;
  json["smallest_edge_m"] = quality.smallest_edge;
  json["largest_edge_m"] = quality.largest_edge;
  json["inlet_area_m2"] = openings.inlet_area;
  json["grate_area_m2"] = openings.grate_area;
  json["outlet_area_m2"] = openings.outlet_area;
  json["smallest_opening_cell_m2"] = openings.smallest_quad;
  write_json(case_folder / "mesh.json", json);
}

void write_wall_results(const std::optional<MillDescription>& description, const WallSurface& walls,
                        double volume, const std::filesystem::path& walls_folder) {
  Json mill = Json::object();
  if (description) mill["walls"] = description->mill.fingerprint.walls;
  Json json = result_head("millfoam-walls", "millMesh", mill);
  json["source"] = description ? "mill" : "cad";
  Eigen::Vector3d low = walls.points.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& point : walls.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  json["lower_m"] = {low.x(), low.y(), low.z()};
  json["upper_m"] = {high.x(), high.y(), high.z()};
  json["volume_m3"] = volume;
  json["triangles"] = Json::object();
  json["files"] = Json::object();
  for (const WallPart& part : walls.parts) {
    if (part.triangles.empty()) continue;
    json["triangles"][part.name] = part.triangles.size();
    const std::filesystem::path file = walls_folder / (part.name + ".stl");
    if (std::filesystem::exists(file)) json["files"][part.name] = file_fingerprint(file);
  }
  write_json(walls_folder / walls_results_name, json);
}

FlowBegin start_of_flow(const Mill& mill, const std::filesystem::path& case_folder) {
  const std::optional<double>& start = mill.averages.start;
  if (!mill.flow.balls) return {start.value_or(0), ""};
  const std::filesystem::path file = case_folder / "solids.json";
  const auto solids = JsonObject::read(file, ": run millAverage again");
  if (!solids) {
    if (start) return {*start, ""};
    return {0,
            "averages.start is 'steady' and there is no solids.json yet: the mesh is turned to DEM time 0; "
            "call millMesh again after millAverage"};
  }
  const auto of_mill = solids->find_object("mill");
  const std::string found = of_mill ? of_mill->find<std::string>("averages").value_or("") : "";
  if (found.empty() || found == mill.fingerprint.averages) return {solids->get<double>("time0_s"), ""};
  const std::string others = file.string() + ": the averages are of another mill (averages " + found +
                             ", this mill's are " + mill.fingerprint.averages + ")";
  if (!start) throw std::runtime_error(others + ": run millDem and millAverage again, with walls by --walls");
  return {*start, others + ": the mesh is turned to averages.start; call millMesh again after millAverage"};
}

}  // namespace millfoam::meshing
