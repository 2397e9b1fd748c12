// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/turning_speed.hpp"

#include "meshing/mill/mill.hpp"
#include "meshing/mill/yaml_section.hpp"

namespace millfoam::meshing {

double read_turning_speed(Section& in, const SpeedKeys& keys) {
  const std::string& other = keys.other;
  std::optional<std::string> usual_sense = keys.usual_sense;
  const bool other_is_set = in.is_set(other) || in.is_set("rpm");
  if (in.has("angular_velocity") && other_is_set && !in.is_set("angular_velocity"))
    usual_sense = in.number("angular_velocity", keys.angular_velocity) < 0 ? "clockwise" : "anticlockwise";
  in.alternatives({"angular_velocity", other, "rpm"});
  in.displace("angular_velocity", {"sense"});
  if (in.has("angular_velocity")) {
    for (const std::string& key : {other, std::string("rpm"), std::string("sense")})
      if (in.has(key)) in.refuse(key, "either angular_velocity alone, or sense with " + other + " or rpm");
    return in.number("angular_velocity", keys.angular_velocity);
  }
  if (in.has("rpm") && in.has(other)) in.refuse("rpm", "either this key or " + other);
  const double speed = in.has("rpm")
                           ? turn_per_minute * in.number("rpm", turns_per_minute(keys.slowest, keys.fastest))
                           : keys.read_other();
  const Section::Keys senses = {"clockwise", "anticlockwise"};
  const std::string sense =
      usual_sense ? in.choice("sense", senses, *usual_sense) : in.choice("sense", senses);
  return sense == "clockwise" ? -speed : speed;
}

}  // namespace millfoam::meshing
