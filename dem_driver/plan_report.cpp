// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/plan_report.hpp"

#include <cmath>
#include <iomanip>
#include <ostream>

#include "averaging/values/sense_of_rotation.hpp"
#include "dem_driver/json_file.hpp"
#include "meshing/mill/stirred_geometry.hpp"

namespace millfoam::dem_driver {

namespace {

Json limits_of(const TimeStep& step) {
  Json limits = Json::array();
  for (const auto& limit : step.limits)
    limits.push_back({{"name", limit.name}, {"reason", limit.reason}, {"timestep_s", limit.value}});
  return limits;
}

Json softness_of(const meshing::Mill& mill) {
  Json table = Json::array();
  for (const Softness& row : softness_table(mill))
    table.push_back({{"modulus_Pa", row.modulus},
                     {"largest_overlap", row.overlap},
                     {"timestep_s", row.time_step},
                     {"cost", row.cost}});
  return table;
}

Json classes_of(const DemPlan& plan) {
  Json classes = Json::array();
  const auto add = [&](const ClassCount& size, bool simulated) {
    classes.push_back({{"diameter_m", size.diameter},
                       {"simulated", simulated},
                       {"balls", size.count},
                       {"asked_mass_kg", size.mass_asked},
                       {"mass_kg", size.mass_realised},
                       {"surface_m2", size.surface()},
                       {"modulus_Pa", plan.step.stiffness.of_ball(size.diameter)}});
  };
  for (const auto& size : plan.charge.classes) add(size, true);
  for (const auto& size : plan.charge.fines) add(size, false);
  return classes;
}

void add_steps(Json& json, const DemPlan& plan) {
  json.update({{"steps", plan.total_steps()},
               {"rounds", plan.charge.rounds.size()},
               {"round_steps", plan.round_steps},
               {"settle_steps", plan.settle_steps},
               {"turning_steps", plan.turning_steps},
               {"duration_s", plan.duration()},
               {"timestep_s", plan.step.value},
               {"interval", plan.step.steps_per_record},
               {"dumps", plan.dumps},
               {"contact_interval", plan.contact_steps},
               {"contact_dumps", plan.contact_dumps},
               {"restart_interval", plan.restart_steps}});
}

}  // namespace

void print_plan(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan) {
  const char* sense = averaging::sense_of_rotation(mill.angular_velocity);
  out << std::setprecision(3) << "mill: " << mill.geometry.diameter << " m in diameter, "
      << mill.geometry.length << (mill.geometry.impeller ? " m high, " : " m long, ");
  if (mill.angular_velocity == 0)
    out << "at rest\n";
  else if (mill.geometry.impeller)
    out << "stirred " << sense << " seen from above, " << mill.angular_velocity << " rad/s ("
        << std::abs(mill.angular_velocity) * meshing::impeller_radius(*mill.geometry.impeller)
        << " m/s at the tips)\n";
  else
    out << "turns " << sense << " seen with x to the right and y up, " << mill.angular_velocity << " rad/s ("
        << 100 * std::abs(mill.angular_velocity) / meshing::critical_speed(mill.geometry)
        << " % of the critical speed)\n";
  print_advice(out, mill);
  print_time_step(out, plan.step, mill);
  print_charge(out, plan.charge);
}

void write_plan_file(const std::filesystem::path& file, const meshing::Mill& mill, const DemPlan& plan,
                     const std::optional<MeasuredForecast>& forecast) {
  Json json = begin_result("dem-plan", mill);
  add_rotation(json, mill);
  add_steps(json, plan);
  json["limits"] = limits_of(plan.step);
  json["impact_speed_m_s"] = plan.step.impact_speed;
  json["modulus_Pa"] = plan.step.stiffness.modulus;
  json["soften_below_m"] = plan.step.stiffness.soften_below;
  json["expected_overlap"] = {{"ratio", plan.step.overlap.ratio}, {"pair", plan.step.overlap.pair}};
  json["softness"] = softness_of(mill);
  add_charge(json, mill, plan.charge);
  json["classes"] = classes_of(plan);
  if (forecast) {
    json["ranks"] = forecast->ranks;
    json["rate_balls_steps_per_s"] = forecast->cost.rate;
    json["wall_time_s"] = forecast->forecast.wall_time;
    json["disk_bytes"] = forecast->forecast.disk;
    json["memory_bytes"] = forecast->forecast.memory;
  }
  write_json(file, json);
}

}  // namespace millfoam::dem_driver
