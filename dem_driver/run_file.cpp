// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/run_file.hpp"

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "dem_driver/json_file.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

double number(const Json& run, const char* key, const fs::path& file) {
  if (!run.contains(key) || !run[key].is_number())
    throw std::runtime_error(file.string() + ": no number '" + key + "', expected one");
  return run[key].get<double>();
}

}  // namespace

void write_run_file(const CaseFolder& folder, const meshing::Mill& mill, const DemPlan& plan) {
  Json run = begin_result("dumps", mill);
  run["timestep_s"] = plan.step.value;
  run["interval"] = plan.step.steps_per_record;
  run["dumps"] = plan.dumps;
  run["angular_velocity_rad_s"] = mill.angular_velocity;
  run["begin_s"] = plan.begin_time();
  run["duration_s"] = plan.duration();
  run["charge_mass_kg"] = plan.charge.mass();
  run["fines_mass_kg"] = plan.charge.fines_mass();
  run["fluid"] = {{"kind", name_of(plan.fluid.kind)}};
  if (plan.fluid.kind == FluidKind::slurry) {
    run["fluid"]["file_id"] = plan.fluid.file_id;
    run["fluid"]["time"] = name_of(plan.fluid.time);
  }
  write_json(folder.run_file(), run);
}

CompleteRun read_run_file(const fs::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": no such file, expected that of a complete run");
  const Json run = Json::parse(in, nullptr, false);
  if (!run.is_object())
    throw std::runtime_error(file.string() + ": is not a JSON object, expected the file that millDem writes");
  CompleteRun found;
  found.charge = run.value(Json::json_pointer("/mill/charge"), std::string());
  found.time_step = number(run, "timestep_s", file);
  const double begin = run.contains("begin_s") ? number(run, "begin_s", file) : 0;
  const double steps = (begin + number(run, "duration_s", file)) / found.time_step;
  if (!(std::abs(steps) < 1e15))
    throw std::runtime_error(file.string() +
                             ": 'duration_s' is no number of steps of 'timestep_s', expected one");
  found.end_step = std::lround(steps);
  return found;
}

}  // namespace millfoam::dem_driver
