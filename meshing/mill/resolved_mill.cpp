// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/resolved_mill.hpp"

#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "meshing/files/json_object.hpp"
#include "meshing/files/output_file.hpp"
#include "meshing/mill/mill_charge.hpp"
#include "meshing/mill/mill_document.hpp"
#include "meshing/mill/mill_fingerprints.hpp"
#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/stirred_geometry.hpp"
#include "millfoam_version.hpp"

namespace millfoam::meshing {
namespace {

using Json = nlohmann::ordered_json;

Json lifters_numbers(const Lifters& lifters) {
  return {{"count", lifters.count},
          {"height_m", lifters.height},
          {"width_m", lifters.width},
          {"top_width_m", lifters.top_width}};
}

Json impeller_numbers(const Geometry& geometry) {
  const Impeller& impeller = *geometry.impeller;
  Json pins = Json::array();
  for (const PinLevel& level : impeller.pins)
    pins.push_back({{"height_m", level.height},
                    {"length_m", level.length},
                    {"thickness_m", level.thickness},
                    {"angle_deg", level.angle},
                    {"arms", level.arms}});
  Json discs = Json::array();
  for (const Disc& disc : impeller.discs)
    discs.push_back(
        {{"height_m", disc.height}, {"diameter_m", disc.diameter}, {"thickness_m", disc.thickness}});
  return {{"shaft_diameter_m", impeller.shaft_diameter},
          {"shaft_end_m", impeller.shaft_end},
          {"radius_m", impeller_radius(impeller)},
          {"top_m", impeller_top(impeller)},
          {"gap_m", impeller_gap(geometry)},
          {"volume_below_top_m3", impeller_volume(geometry, impeller_top(impeller))},
          {"pins", pins},
          {"discs", discs}};
}

/// Numbers of the inside of a stirred mill.
Json stirred_geometry_numbers(const Geometry& geometry) {
  return {{"radius_m", geometry.radius()},
          {"length_m", geometry.length},
          {"section_m2", analytic_section(geometry)},
          {"volume_m3", analytic_volume(geometry)},
          {"impeller", impeller_numbers(geometry)}};
}

Json stirred_speed_numbers(const Mill& mill) {
  return {{"angular_velocity_rad_s", mill.angular_velocity},
          {"sense", mill.sense()},
          {"tip_speed_m_s", std::abs(mill.angular_velocity) * impeller_radius(*mill.geometry.impeller)},
          {"turn_s", mill.turn()}};
}

Json geometry_numbers(const Mill& mill) {
  const Geometry& geometry = mill.geometry;
  Json numbers = {{"radius_m", geometry.radius()},
                  {"length_m", geometry.length},
                  {"whole_length_m", mill.whole_length},
                  {"is_slice", geometry.ends == Ends::periodic},
                  {"ends", geometry.ends == Ends::plain ? "plain" : "periodic"},
                  {"section_m2", analytic_section(geometry)},
                  {"volume_m3", analytic_volume(geometry)},
                  {"flow_volume_m3", flow_volume(geometry)},
                  {"lifters", lifters_numbers(geometry.lifters)},
                  {"inlet", nullptr},
                  {"grates", nullptr},
                  {"pulp_lifters", nullptr}};
  if (geometry.inlet) numbers["inlet"] = {{"radius_m", geometry.inlet->radius}};
  if (geometry.grates)
    numbers["grates"] = {{"inner_radius_m", geometry.grates->inner_radius},
                         {"outer_radius_m", geometry.grates->outer_radius},
                         {"sectors", geometry.grates->sectors},
                         {"sector_share", geometry.grates->sector_share},
                         {"open_fraction", geometry.grates->open_fraction},
                         {"pegged", geometry.grates->pegged}};
  if (geometry.pulp_lifters)
    numbers["pulp_lifters"] = {{"depth_m", geometry.pulp_lifters->depth},
                               {"layers", geometry.pulp_lifters->layers},
                               {"discharge_radius_m", geometry.pulp_lifters->discharge_radius}};
  return numbers;
}

Json speed_numbers(const Mill& mill) {
  const double critical = critical_speed(mill.geometry);
  return {{"angular_velocity_rad_s", mill.angular_velocity},
          {"sense", mill.sense()},
          {"critical_speed_rad_s", critical},
          {"fraction_of_critical", std::abs(mill.angular_velocity) / critical},
          {"turn_s", mill.turn()}};
}

Json shape_numbers(const Superquadric& shape) {
  const auto shadow = [&](double x, double y, double z) { return cross_section(shape, {x, y, z}); };
  return {{"half_axes_m", shape.half_axes},
          {"blockiness", shape.blockiness},
          {"volume_m3", volume(shape)},
          {"surface_m2", surface(shape)},
          {"inertia_over_mass_m2", inertia_over_mass(shape)},
          {"sphericity", sphericity(shape)},
          {"cross_sections_m2", {shadow(1, 0, 0), shadow(0, 1, 0), shadow(0, 0, 1)}},
          {"least_radius_of_curvature_m", least_radius_of_curvature(shape)},
          {"bounding_radius_m", bounding_radius(shape)}};
}

Json charge_numbers(const ChargeNumbers& charge, double packing) {
  Json classes = Json::array();
  for (const BallCount& size : charge.classes) {
    classes.push_back({{"diameter_m", size.diameter},
                       {"count", size.count},
                       {"mass_asked_kg", size.mass_asked},
                       {"mass_kg", size.mass},
                       {"simulated", size.simulated}});
    if (size.shape) classes.back()["shape"] = shape_numbers(*size.shape);
  }
  const double whole = charge.mass + charge.fines_mass;
  return {{"balls", charge.balls},
          {"mass_kg", charge.mass},
          {"volume_m3", charge.volume},
          {"load", charge.load},
          {"load_asked", charge.load_asked},
          {"resting_solidity", packing},
          {"pore_volume_m3", charge.pore_volume},
          {"fines_mass_kg", charge.fines_mass},
          {"fines_share", whole > 0 ? charge.fines_mass / whole : 0},
          {"sauter_diameter_m", charge.sauter_diameter},
          {"sphericity", charge.sphericity},
          {"smallest_diameter_m", charge.smallest_diameter},
          {"largest_diameter_m", charge.largest_diameter},
          {"classes", classes}};
}

Json voxel_numbers(const Voxels& voxels) {
  return {{"lower_m", voxels.lower}, {"upper_m", voxels.upper}, {"shape", voxels.shape}};
}

/// Of the cells of a stirred mill's averages.
Json ring_numbers(const Mill& mill) {
  return {{"radii_m", {0, mill.geometry.radius()}},
          {"ends_m", {0, mill.geometry.length}},
          {"shape", mill.averages.shape()},
          {"frame", mill.averages.rings->turning ? "impeller" : "lab"},
          {"whole_run", mill.averages.whole_run}};
}

Json averages_numbers(const Mill& mill) {
  Json numbers = mill.averages.rings ? ring_numbers(mill) : voxel_numbers(mill.averages.voxels);
  if (!mill.averages.rings) numbers["periodic"] = {false, false, mill.geometry.ends == Ends::periodic};
  numbers["window_s"] = mill.averages.window;
  numbers["start_s"] = mill.averages.start ? Json(*mill.averages.start) : Json("steady");
  numbers["method"] = mill.averages.method;
  numbers["template"] = mill.averages.template_points;
  return numbers;
}

Json start_numbers(const FlowStart& start) {
  if (start.level) return {{"level_m", *start.level}};
  return {{"volume_m3", start.volume}, {"fill", start.fill}};
}

Json steady_numbers(const std::optional<SteadyEnd>& end) {
  if (!end) return nullptr;
  return {{"turns", end->turns}, {"hours", end->hours ? Json(*end->hours) : Json()}};
}

Json flow_numbers(const Mill& mill) {
  const Flow& flow = mill.flow;
  Json averages = voxel_numbers(flow.averages.voxels);
  averages["start_s"] = flow.averages.start;
  averages["window_s"] = flow.averages.window;
  averages["interval_s"] = flow.averages.interval;
  Json numbers{{"solver", flow.solver},
               {"duration_s", flow.duration},
               {"turns", flow.duration / mill.turn()},
               {"steady", steady_numbers(flow.steady)},
               {"balls", flow.balls},
               {"law", flow.law},
               {"multiplier", flow.multiplier},
               {"viscosity", flow.viscosity},
               {"polydispersity", flow.polydispersity},
               {"mixed_drag", flow.mixed_drag},
               {"out_of_range", flow.out_of_range},
               {"coupling", name_of(flow.coupling.kind)},
               {"passes", flow.coupling.passes},
               {"relaxation", flow.coupling.relaxation},
               {"start", start_numbers(flow.start)},
               {"feed_m3_s", flow.feed},
               {"max_courant", flow.max_courant},
               {"max_surface_courant", flow.max_surface_courant},
               {"max_air_courant", flow.max_air_courant},
               {"max_voidage_change", flow.max_voidage_change},
               {"largest_correction", flow.largest_correction},
               {"max_time_step_s", flow.max_time_step},
               {"write_interval_s", flow.write_interval},
               {"slices", flow.slices},
               {"averages_start_s", flow.averages.start},
               {"averages", averages}};
  if (flow.coupling.voxels) numbers["exchange"] = voxel_numbers(*flow.coupling.voxels);
  if (flow.tracer)
    numbers["tracer"] = {{"begin_s", flow.tracer->begin},
                         {"pulse_s", flow.tracer->pulse ? Json(*flow.tracer->pulse) : Json()},
                         {"dispersion_m2_s", flow.tracer->dispersion}};
  return numbers;
}

Json slurry_numbers(const Slurry& slurry) {
  return {{"density_kg_m3", slurry.density},           {"plastic_viscosity_Pa_s", slurry.plastic_viscosity},
          {"yield_stress_Pa", slurry.yield_stress},    {"surface_tension_N_m", slurry.surface_tension},
          {"viscosity_ratio", slurry.viscosity_ratio}, {"liquid_below_1_s", slurry.liquid_below()}};
}

Json air_numbers(const Air& air) {
  return {{"density_kg_m3", air.density}, {"viscosity_Pa_s", air.viscosity}};
}

/// Without slurry a stirred mill has a dry run alone.
Json stirred_numbers(const Mill& mill) {
  Json numbers = {{"machine", "stirred"},
                  {"geometry", stirred_geometry_numbers(mill.geometry)},
                  {"speed", stirred_speed_numbers(mill)},
                  {"charge", charge_numbers(count_charge(mill), mill.charge.packing)},
                  {"materials", materials_numbers(mill)},
                  {"averages", averages_numbers(mill)},
                  {"gravity_m_s2", gravity}};
  numbers["flow"] = nullptr;
  if (!mill.has_flow()) return numbers;
  numbers["slurry"] = slurry_numbers(mill.slurry);
  numbers["air"] = air_numbers(mill.air);
  numbers["resolution"] = {{"cell_size_m", mill.resolution.cell_size}};
  numbers["flow"] = flow_numbers(mill);
  return numbers;
}

Json resolution_numbers(const Mill& mill) {
  const Resolution& resolution = mill.resolution;
  const double last =
      resolution.last_layer > 0 ? resolution.last_layer : mill.geometry.length / resolution.layers;
  return {{"cell_size_m", resolution.counts ? Json() : Json(resolution.cell_size)},
          {"layers", resolution.layers},
          {"last_layer_m", last}};
}

Json derived_numbers(const Mill& mill) {
  if (mill.machine() == Machine::stirred) return stirred_numbers(mill);
  return {{"machine", "tumbling"},
          {"geometry", geometry_numbers(mill)},
          {"speed", speed_numbers(mill)},
          {"charge", charge_numbers(count_charge(mill), mill.charge.packing)},
          {"materials", materials_numbers(mill)},
          {"averages", averages_numbers(mill)},
          {"gravity_m_s2", gravity},
          {"slurry", slurry_numbers(mill.slurry)},
          {"air", air_numbers(mill.air)},
          {"resolution", resolution_numbers(mill)},
          {"flow", flow_numbers(mill)}};
}

}  // namespace

Json result_head(const std::string& format, const std::string& program, const Json& mill) {
  return {{"format", format}, {"program", program + " " + version()}, {"mill", mill}};
}

Json resolved_mill(const MillDescription& description, const std::string& program) {
  const MillDocument& document = *description.document;
  return {{"format", "millfoam-mill"},
          {"version", 1},
          {"program", program + " " + version()},
          {"file", document.source()},
          {"file_fingerprint", document.source_fingerprint()},
          {"set", document.changes()},
          {"lines", document.lines()},
          {"fingerprint", to_json(description.mill.fingerprint)},
          {"mill", document.keys()},
          {"derived", derived_numbers(description.mill)}};
}

namespace {

/// A file that is not a resolved mill, such as the description of the mill itself, is not replaced.
void require_replaceable(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file) || std::filesystem::file_size(file) == 0) return;
  if (!JsonObject::of_format(file, "millfoam-mill"))
    throw std::runtime_error("--resolved " + file.string() +
                             ": exists and is not a resolved mill; expected another file");
}

}  // namespace

void write_resolved_mill(const MillDescription& description, const std::string& program,
                         const std::filesystem::path& file) {
  require_replaceable(file);
  const std::string text = resolved_mill(description, program).dump(2) + '\n';
  if (file == "-")
    std::cout << text << std::flush;
  else
    write_file(file, [&](std::ostream& out) { out << text; });
}

}  // namespace millfoam::meshing
