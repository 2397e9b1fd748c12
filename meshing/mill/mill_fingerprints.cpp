// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_fingerprints.hpp"

#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace millfoam::meshing {

std::string fingerprint(const std::string& bytes) {
  std::uint64_t sum = 14695981039346656037U;
  for (const char byte : bytes) sum = (sum ^ static_cast<unsigned char>(byte)) * 1099511628211U;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(sum));
  return text;
}

MillFingerprints fingerprints(const nlohmann::ordered_json& keys) {
  nlohmann::ordered_json of = {{"geometry", keys.at("geometry")}, {"resolution", keys.at("resolution")}};
  of["resolution"].erase("layers");
  MillFingerprints result;
  result.walls = fingerprint(of.dump());
  for (const char* section : {"speed", "charge", "materials", "dem"}) of[section] = keys.at(section);
  of["dem"].erase("duration");
  result.charge = fingerprint(of.dump());
  of["dem"] = keys.at("dem");
  of["averages"] = keys.at("averages");
  result.averages = fingerprint(of.dump());
  of = keys;
  of.erase("title");
  result.flow = fingerprint(of.dump());
  return result;
}

nlohmann::ordered_json to_json(const MillFingerprints& fingerprints) {
  return {{"walls", fingerprints.walls},
          {"charge", fingerprints.charge},
          {"averages", fingerprints.averages},
          {"flow", fingerprints.flow}};
}

}  // namespace millfoam::meshing
