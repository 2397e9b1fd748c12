// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/json_file.hpp"

#include <ostream>
#include <stdexcept>

#include "averaging/values/sense_of_rotation.hpp"
#include "meshing/files/output_file.hpp"
#include "meshing/mill/mill_shape.hpp"
#include "millfoam_version.hpp"

namespace millfoam::dem_driver {

JsonObject read_order(const std::filesystem::path& file, const std::string& format) {
  const auto order = JsonObject::read(file, ": run millDem again");
  if (!order)
    throw std::runtime_error(file.string() + ": cannot be read, expected the file that millDem writes");
  order->require_format(format);
  return *order;
}

Json begin_result(const std::string& what, const meshing::Mill& mill) {
  return {{"format", "millfoam-" + what},
          {"program", std::string("millDem ") + version()},
          {"mill", {{"walls", mill.fingerprint.walls}, {"charge", mill.fingerprint.charge}}}};
}

void add_rotation(Json& result, const meshing::Mill& mill) {
  result["angular_velocity_rad_s"] = mill.angular_velocity;
  result["sense"] = averaging::sense_of_rotation(mill.angular_velocity);
}

void add_charge(Json& result, const meshing::Mill& mill, const ChargePlan& charge) {
  const double bulk = mill.charge.packing * mill.ball.density * meshing::analytic_volume(mill.geometry);
  result["balls"] = charge.balls();
  result["smallest_diameter_m"] = charge.classes.back().diameter;
  result["largest_diameter_m"] = charge.classes.front().diameter;
  result["simulated_mass_kg"] = charge.mass();
  result["asked_mass_kg"] = charge.asked_mass();
  result["fines_mass_kg"] = charge.fines_mass();
  result["fines_share"] = charge.fines_mass() / charge.asked_mass();
  result["load"] = charge.mass() / bulk;
  result["asked_load"] = charge.asked_mass() / bulk;
}

void write_json(const std::filesystem::path& file, const Json& result) {
  replace_file(file, [&](std::ostream& out) { out << result.dump(2) << '\n'; });
}

}  // namespace millfoam::dem_driver
