// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_fingerprints.hpp"

#include <nlohmann/json.hpp>

#include "meshing/files/file_fingerprint.hpp"

namespace millfoam::meshing {
namespace {

using Json = nlohmann::ordered_json;

Json material_numbers(const Material& material) {
  return {{"density_kg_m3", material.density},
          {"youngs_modulus_Pa", material.youngs_modulus},
          {"poisson_ratio", material.poisson_ratio}};
}

Json contact_numbers(const Contact& contact) {
  return {{"restitution", contact.restitution},
          {"friction", contact.friction},
          {"rolling_friction", contact.rolling_friction}};
}

/// The keys of `dem`; without a pool as before there was one, with it also its density. Statistics of the
/// contacts and dumps of the balls do not change the motion.
Json dem_numbers(const Json& keys, const Mill& mill) {
  Json dem = keys.at("dem");
  dem.erase("contact_statistics");
  if (mill.dem.pool_level)
    dem["fluid_density"] = mill.slurry.density;
  else
    dem.erase("fluid");
  dem.erase("dumps");
  return dem;
}

/// The keys of `charge` but the one that only allows balls of a size.
Json charge_numbers(const Json& keys) {
  Json charge = keys.at("charge");
  charge.erase("larger_than_gap");
  return charge;
}

/// The keys of `averages` but the time at which they are made.
Json averages_numbers(const Json& keys) {
  Json averages = keys.at("averages");
  averages.erase("live");
  return averages;
}

}  // namespace

Json materials_numbers(const Mill& mill) {
  return {{"ball", material_numbers(mill.ball)},
          {"wall", material_numbers(mill.wall)},
          {"ball_ball", contact_numbers(mill.ball_ball)},
          {"ball_wall", contact_numbers(mill.ball_wall)}};
}

MillFingerprints fingerprints(const Json& keys, const Mill& mill) {
  // Names of materials mean numbers
  const Json materials = materials_numbers(mill);
  const bool stirred = mill.machine() == Machine::stirred;
  Json of = {{"geometry", keys.at("geometry")}};
  of["resolution"] = stirred ? Json::object() : keys.at("resolution");
  // Balls and walls do not see which faces of the end are grates
  Json& geometry = of["geometry"];
  if (geometry.contains("grates") && geometry["grates"].is_object())
    for (const char* key : {"sectors", "sector_share", "open_fraction", "pegged"})
      geometry["grates"].erase(key);
  // Walls have none of the mesh's layers, nor those of its core and ring
  Json& resolution = of["resolution"];
  for (const char* key : {"layers", "last_layer"}) resolution.erase(key);
  if (resolution.contains("counts") && resolution["counts"].is_object())
    for (const char* key : {"core", "ring"}) resolution["counts"].erase(key);
  if (geometry.contains("pulp_lifters") && geometry["pulp_lifters"].is_object())
    geometry["pulp_lifters"].erase("layers");
  MillFingerprints result;
  result.walls = fingerprint(of.dump());
  of["speed"] = keys.at("speed");
  of["charge"] = charge_numbers(keys);
  of["dem"] = dem_numbers(keys, mill);
  of["dem"].erase("duration");
  of["materials"] = materials;
  result.charge = fingerprint(of.dump());
  of["dem"] = dem_numbers(keys, mill);
  of["averages"] = averages_numbers(keys);
  result.averages = fingerprint(of.dump());
  if (!mill.has_flow()) return result;
  of = keys;
  of.erase("machine");
  of["charge"] = charge_numbers(keys);
  of["averages"] = averages_numbers(keys);
  of["dem"] = dem_numbers(keys, mill);
  of["materials"] = materials;
  of.erase("title");
  // A core with all columns is that without the key
  if (const auto& counts = mill.resolution.counts; counts && !counts->halved)
    of["resolution"]["counts"].erase("core");
  // The usual largest viscosity is that without the key
  if (mill.slurry.viscosity_ratio == drag::usual_viscosity_ratio) of["slurry"].erase("viscosity_ratio");
  // How often balls and flow are computed in turn changes none of these flows
  for (const char* key : {"coupling", "passes", "relaxation"}) of["flow"].erase(key);
  // A flow that may take more hours is the same
  if (of["flow"].contains("steady")) of["flow"]["steady"].erase("hours");
  result.flow = fingerprint(of.dump());
  return result;
}

Json to_json(const MillFingerprints& fingerprints) {
  return {{"walls", fingerprints.walls},
          {"charge", fingerprints.charge},
          {"averages", fingerprints.averages},
          {"flow", fingerprints.flow}};
}

}  // namespace millfoam::meshing
