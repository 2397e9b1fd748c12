// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/run_file.hpp"

#include <cmath>
#include <stdexcept>

#include "dem_driver/json_file.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

void write_run_file(const CaseFolder& folder, const meshing::Mill& mill, const DemPlan& plan,
                    const std::map<std::string, std::string>& walls) {
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
  if (!walls.empty()) run["wall_files"] = walls;
  write_json(folder.run_file(), run);
}

CompleteRun read_run_file(const fs::path& file) {
  const auto run = JsonObject::read(file);
  if (!run) throw std::runtime_error(file.string() + ": no such file, expected that of a complete run");
  CompleteRun found;
  if (const auto mill = run->find_object("mill"))
    found.charge = mill->find<std::string>("charge").value_or("");
  const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
  found.time_step = run->get<double>("timestep_s", "a positive number", positive);
  const double begin = run->find<double>("begin_s").value_or(0);
  const double steps =
      (begin + run->get<double>("duration_s", "a time in s above 0", positive)) / found.time_step;
  if (!(steps > 0 && steps < 1e15)) run->refuse("duration_s", "a number of steps of 'timestep_s'");
  found.end_step = std::lround(steps);
  return found;
}

}  // namespace millfoam::dem_driver
