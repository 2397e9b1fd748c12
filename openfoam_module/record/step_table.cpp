// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/record/step_table.hpp"

#include <charconv>
#include <stdexcept>
#include <string>

namespace millfoam::record {

namespace {

using Value = std::optional<double>;

/// As few digits as give back the same number.
std::string written(const Value& value) {
  if (!value) return "nan";
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), *value);
  return {text.data(), end.ptr};
}

Value component(const std::optional<std::array<double, 3>>& vector, std::size_t axis) {
  return vector ? Value((*vector)[axis]) : std::nullopt;
}

}  // namespace

const std::array<StepColumn, 32> step_columns{{
    {"time_s", [](const StepRow& r) -> Value { return r.time; }},
    {"deltaT_s", [](const StepRow& r) -> Value { return r.delta_t; }},
    {"courant", [](const StepRow& r) -> Value { return r.courant; }},
    {"courant_surface", [](const StepRow& r) -> Value { return r.surface_courant; }},
    {"courant_air", [](const StepRow& r) -> Value { return r.air_courant; }},
    {"voidage_change", [](const StepRow& r) -> Value { return r.voidage_change; }},
    {"pressure_iterations", [](const StepRow& r) -> Value { return r.pressure_iterations; }},
    {"pressure_residual", [](const StepRow& r) -> Value { return r.pressure_residual; }},
    {"slurry_m3", [](const StepRow& r) -> Value { return r.slurry; }},
    {"fluid_m3", [](const StepRow& r) -> Value { return r.fluid; }},
    {"alpha_min", [](const StepRow& r) -> Value { return r.alpha_min; }},
    {"alpha_max_minus_1", [](const StepRow& r) -> Value { return r.alpha_above; }},
    {"without_room_m3", [](const StepRow& r) -> Value { return r.without_room; }},
    {"solids_m3", [](const StepRow& r) { return r.solids; }},
    {"volume_correction", [](const StepRow& r) { return r.volume_correction; }},
    {"solids_moved_m3", [](const StepRow& r) { return r.solids_moved; }},
    {"largest_reynolds", [](const StepRow& r) { return r.largest_reynolds; }},
    {"beyond_law", [](const StepRow& r) { return r.beyond_law; }},
    {"solidity_below", [](const StepRow& r) { return r.solidity_below; }},
    {"solidity_above", [](const StepRow& r) { return r.solidity_above; }},
    {"reynolds_below", [](const StepRow& r) { return r.reynolds_below; }},
    {"reynolds_above", [](const StepRow& r) { return r.reynolds_above; }},
    {"force_mean", [](const StepRow& r) { return r.force_mean; }},
    {"force_95", [](const StepRow& r) { return r.force_95; }},
    {"given_force_x_N", [](const StepRow& r) { return component(r.given_force, 0); }},
    {"given_force_y_N", [](const StepRow& r) { return component(r.given_force, 1); }},
    {"given_force_z_N", [](const StepRow& r) { return component(r.given_force, 2); }},
    {"given_torque_Nm", [](const StepRow& r) { return r.given_torque; }},
    {"continuity_residual_per_s", [](const StepRow& r) { return r.continuity_residual; }},
    {"continuity_speed_m_per_s", [](const StepRow& r) { return r.continuity_speed; }},
    {"slip_m_per_s", [](const StepRow& r) { return r.slip; }},
    {"wall_s", [](const StepRow& r) -> Value { return r.wall; }},
}};

StepTable::StepTable(const std::filesystem::path& path) : path_(path), out_(path) {
  const char* separator = "";
  for (const StepColumn& column : step_columns) {
    out_ << separator << column.name;
    separator = ",";
  }
  out_ << '\n' << std::flush;
  if (!out_) throw std::runtime_error(path_.string() + ": cannot be written");
}

void StepTable::add(const StepRow& row) {
  std::string line;
  for (const StepColumn& column : step_columns)
    line += (line.empty() ? "" : ",") + written(column.value(row));
  out_ << line + '\n' << std::flush;
  if (!out_) throw std::runtime_error(path_.string() + ": cannot be written; is the disk full?");
}

}  // namespace millfoam::record
