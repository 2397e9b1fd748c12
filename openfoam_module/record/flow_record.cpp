// SPDX-License-Identifier: GPL-3.0-or-later
#include "openfoam_module/record/flow_record.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "averaging/values/sense_of_rotation.hpp"
#include "millfoam_version.hpp"
#include "openfoam_module/record/rotation.hpp"

namespace millfoam::record {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* table_name = "steps.csv";
constexpr const char* summary_name = "flow.json";

/// A number, or null where there is none or it is infinite.
Json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json text(const std::string& value) {
  return value.empty() ? Json(nullptr) : Json(value);
}

void add_known(Json& object, const char* key, const std::string& value) {
  if (!value.empty()) object[key] = value;
}

Json limits_of(const FlowSetup& setup) {
  if (!setup.limits) return nullptr;
  return {{"maxCo", setup.limits->courant},
          {"maxAlphaCo", setup.limits->surface_courant},
          {"maxAirCo", setup.limits->air_courant},
          {"maxVoidageChange", setup.limits->voidage_change},
          {"maxDeltaT_s", number(setup.limits->delta_t)}};
}

/// How often a recorded series began again, and for how long its end was held, up to a flow time.
Json beyond_record(const Solids& solids, double time) {
  const double duration = solids.end - solids.begin;
  const bool beyond = !solids.whole_run && duration > 0 && time > duration * (1 + 1e-9);
  const bool repeats = beyond && solids.out_of_range == "repeat";
  const bool holds = beyond && solids.out_of_range == "hold";
  return {{"repeated", repeats ? static_cast<long long>(std::ceil(time / duration * (1 - 1e-9))) - 1 : 0},
          {"held_s", holds ? time - duration : 0.0}};
}

Json solids_of(const FlowSetup& setup, double time) {
  if (!setup.solids) return nullptr;
  const Solids& solids = *setup.solids;
  Json result{{"source", solids.source}, {"file", text(solids.file)}};
  if (solids.file.empty() && solids.program.empty()) return result;
  result["begin_s"] = solids.begin;
  result["end_s"] = solids.end;
  if (!solids.file.empty()) {
    result["windows"] = solids.windows;
    result["whole_run"] = solids.whole_run;
    result["in_time"] = solids.in_time;
    result["out_of_range"] = solids.out_of_range;
    result.update(beyond_record(solids, time));
  }
  result["angular_velocity_rad_s"] = number(solids.angular_velocity);
  result["program"] = text(solids.program);
  result["mill"] = Json::object();
  add_known(result["mill"], "charge", solids.mill_charge);
  add_known(result["mill"], "averages", solids.mill_averages);
  return result;
}

Json drag_of(const FlowSetup& setup) {
  if (!setup.drag) return nullptr;
  const Drag& drag = *setup.drag;
  return {{"law", drag.law},
          {"reference", drag.reference},
          {"multiplier", drag.multiplier},
          {"viscosity", drag.viscosity},
          {"polydispersity", drag.polydispersity},
          {"mixed", drag.mixed},
          {"solidity_range", {number(drag.solidity_min), number(drag.solidity_max)}},
          {"reynolds_range", {number(drag.reynolds_min), number(drag.reynolds_max)}}};
}

/// The records of a case by the time at which their runs began, s.
std::map<double, fs::path> records_of(const fs::path& folder) {
  std::map<double, fs::path> result;
  if (!fs::is_directory(folder)) return result;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    char* end = nullptr;
    const double start = std::strtod(name.c_str(), &end);
    if (end != name.c_str() && *end == '\0') result[start] = entry.path();
  }
  return result;
}

/// Removes what runs left that began after a time: a file of theirs, and their folder where it is empty then.
void remove_later(const fs::path& folder, double begin) {
  for (const auto& [start, path] : records_of(folder)) {
    if (start <= begin) continue;
    fs::remove(path / table_name);
    fs::remove(path / summary_name);
    if (fs::is_empty(path)) fs::remove(path);
  }
}

fs::path prepared_folder(const fs::path& case_folder, const std::string& start, double begin) {
  const fs::path all = case_folder / "postProcessing" / "flow";
  remove_later(all, begin);
  fs::create_directories(all / start);
  return all / start;
}

}  // namespace

bool is_complete(const fs::path& case_folder, double time) {
  const std::map<double, fs::path> found = records_of(case_folder / "postProcessing" / "flow");
  if (found.empty()) return false;
  std::ifstream in(found.rbegin()->second / summary_name);
  const Json last = Json::parse(in, nullptr, false);
  if (!last.is_object() || last.value("complete", Json()) != true || !last.value("end_s", Json()).is_number())
    return false;
  return std::abs(last["end_s"].get<double>() - time) <= 1e-6 * std::max(1.0, std::abs(time));
}

void FlowRecord::Course::add(const std::optional<double>& value, double duration) {
  if (!value) return;
  if (std::abs(*value) > std::abs(largest)) largest = *value;
  integral += *value * duration;
  time += duration;
}

Json FlowRecord::Course::largest_value() const {
  return time > 0 ? Json(largest) : Json(nullptr);
}

Json FlowRecord::Course::mean_value() const {
  return time > 0 ? Json(integral / time) : Json(nullptr);
}

FlowRecord::FlowRecord(const fs::path& case_folder, const std::string& start, const FlowSetup& setup)
    : folder_(prepared_folder(case_folder, start, setup.begin)), setup_(setup), table_(folder_ / table_name) {
  write(false);
}

double FlowRecord::wall_time() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
}

double FlowRecord::end_time() const {
  return steps_ > 0 ? last_.time : setup_.begin;
}

void FlowRecord::add(StepRow row) {
  row.wall = wall_time();
  table_.add(row);
  if (steps_ == 0) first_ = row;
  last_ = row;
  alpha_min_ = steps_ == 0 ? row.alpha_min : std::min(alpha_min_, row.alpha_min);
  alpha_above_ = steps_ == 0 ? row.alpha_above : std::max(alpha_above_, row.alpha_above);
  ++steps_;
  pressure_iterations_ += row.pressure_iterations;
  courant_.add(row.courant, row.delta_t);
  surface_courant_.add(row.surface_courant, row.delta_t);
  air_courant_.add(row.air_courant, row.delta_t);
  voidage_change_.add(row.voidage_change, row.delta_t);
  volume_correction_.add(row.volume_correction, row.delta_t);
  beyond_law_.add(row.beyond_law, row.delta_t);
  solidity_below_.add(row.solidity_below, row.delta_t);
  solidity_above_.add(row.solidity_above, row.delta_t);
  reynolds_below_.add(row.reynolds_below, row.delta_t);
  reynolds_above_.add(row.reynolds_above, row.delta_t);
  if (row.force_mean && row.force_95) {
    force_mean_ += *row.force_mean;
    force_95_ += *row.force_95;
    ++forces_;
  }
  if (row.continuity_residual && row.continuity_speed && row.slip) {
    continuity_residual_ += *row.continuity_residual;
    continuity_speed_ += *row.continuity_speed;
    slip_ += *row.slip;
    ++continuities_;
  }
}

void FlowRecord::set_memory(double bytes) {
  memory_ = bytes;
}

void FlowRecord::set_stages(StageClock::Times stages) {
  stages_ = std::move(stages);
}

void FlowRecord::add_steps(nlohmann::ordered_json& result) const {
  const auto of_steps = [this](double value) { return steps_ > 0 ? number(value) : Json(nullptr); };
  const double steps = static_cast<double>(std::max(steps_, 1LL));
  result["largest"] = {{"courant", courant_.largest_value()},
                       {"courant_surface", surface_courant_.largest_value()},
                       {"courant_air", air_courant_.largest_value()},
                       {"voidage_change", voidage_change_.largest_value()}};
  result["pressure_iterations_per_step"] = of_steps(pressure_iterations_ / steps);
  result["slurry_m3"] = {{"first", of_steps(first_.slurry)}, {"last", of_steps(last_.slurry)}};
  result["fluid_m3"] = {{"first", of_steps(first_.fluid)}, {"last", of_steps(last_.fluid)}};
  result["alpha"] = {{"min", of_steps(alpha_min_)}, {"max_minus_1", of_steps(alpha_above_)}};
  result["without_room_m3"] = of_steps(last_.without_room);
}

void FlowRecord::add_balls(nlohmann::ordered_json& result) const {
  result["solids"] = solids_of(setup_, end_time());
  result["volume_correction"] = {{"largest", volume_correction_.largest_value()},
                                 {"mean", volume_correction_.mean_value()}};
  result["drag"] = drag_of(setup_);
  result["beyond_law"] = {
      {"largest", beyond_law_.largest_value()},         {"mean", beyond_law_.mean_value()},
      {"solidity_below", solidity_below_.mean_value()}, {"solidity_above", solidity_above_.mean_value()},
      {"reynolds_below", reynolds_below_.mean_value()}, {"reynolds_above", reynolds_above_.mean_value()}};
  const auto mean = [](double sum, long long times) {
    return times > 0 ? Json(sum / static_cast<double>(times)) : Json(nullptr);
  };
  result["force_on_balls"] = {
      {"mean", mean(force_mean_, forces_)}, {"below_95", mean(force_95_, forces_)}, {"times", forces_}};
  result["solids_continuity"] = {{"residual_per_s", mean(continuity_residual_, continuities_)},
                                 {"speed_m_per_s", mean(continuity_speed_, continuities_)},
                                 {"slip_m_per_s", mean(slip_, continuities_)},
                                 {"times", continuities_}};
}

std::string FlowRecord::summary(bool complete) const {
  Json mill = Json::object();
  add_known(mill, "charge", setup_.mill_charge);
  add_known(mill, "averages", setup_.mill_averages);
  add_known(mill, "flow", setup_.mill_flow);
  Json result{{"format", "millfoam-flow"}, {"program", setup_.solver + " " + version()}, {"mill", mill}};
  result["complete"] = complete;
  result["begin_s"] = setup_.begin;
  result["end_s"] = end_time();
  result["asked_end_s"] = number(setup_.asked_end);
  result["steps"] = steps_;
  result["wall_s"] = wall_time();
  result["stages_s"] = Json::object();
  for (const auto& [stage, time] : stages_) result["stages_s"][stage] = time;
  result["ranks"] = setup_.ranks;
  result["memory_bytes"] = memory_;
  result["openfoam"] = {{"version", text(setup_.openfoam_version)},
                        {"patch", text(setup_.openfoam_patch)},
                        {"build", text(setup_.openfoam_build)}};
  result["rotation"] = {{"angular_velocity_rad_s", setup_.angular_velocity},
                        {"sense", averaging::sense_of_rotation(setup_.angular_velocity)},
                        {"words", described_rotation(setup_.angular_velocity)}};
  result["limits"] = limits_of(setup_);
  add_steps(result);
  add_balls(result);
  return result.dump(2) + '\n';
}

void FlowRecord::write(bool complete) const {
  const fs::path path = folder_ / summary_name;
  const fs::path part = path.string() + ".part";
  {
    std::ofstream out(part);
    out << summary(complete) << std::flush;
    if (!out) throw std::runtime_error(part.string() + ": cannot be written; is the disk full?");
  }
  fs::rename(part, path);
}

}  // namespace millfoam::record
