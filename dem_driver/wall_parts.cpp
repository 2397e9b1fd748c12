// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/wall_parts.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "dem_driver/wall_check.hpp"
#include "dem_driver/wall_fit.hpp"
#include "meshing/files/file_fingerprint.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

/// Digits of a checksum without leading zeros, as the decks have them.
std::string without_zeros(const std::string& checksum) {
  return checksum.substr(std::min(checksum.find_first_not_of('0'), checksum.size() - 1));
}

}  // namespace

std::vector<std::string> find_walls(const CaseFolder& folder, const meshing::Mill& mill) {
  std::vector<std::string> parts;
  std::vector<Wall> walls;
  const auto take = [&](const std::string& part) {
    const fs::path file = folder.walls() / (part + ".stl");
    if (!fs::exists(file)) return false;
    walls.push_back({file, read_wall(file)});
    parts.push_back(part);
    return true;
  };
  const auto refuse = [&](const std::string& part, const std::string& and_more) {
    throw std::runtime_error((folder.walls() / (part + ".stl")).string() + ": no such wall" + and_more +
                             ", run millMesh first");
  };
  if (mill.machine() == meshing::Machine::stirred) {
    for (const char* part : stirred_parts)
      if (!take(part)) refuse(part, "");
    require_fit(walls, mill.geometry);
    return parts;
  }
  if (!take("shell")) refuse("shell", "");
  // From CAD they may be there without any in the mill
  if (!take("lifters") && mill.geometry.lifters.count > 0) refuse("lifters", "");
  if (mill.geometry.ends == meshing::Ends::plain) {
    const bool has_feed = take("feedEnd"), has_discharge = take("dischargeEnd");
    const EndCover cover = cover_of_ends(walls, mill.geometry);
    const std::string open = ", and the others leave this end open";
    if (!has_feed && cover.feed < least_cover) refuse("feedEnd", open);
    if (!has_discharge && cover.discharge < least_cover) refuse("dischargeEnd", open);
  }
  require_fit(walls, mill.geometry);
  return parts;
}

std::map<std::string, std::string> wall_fingerprints(const CaseFolder& folder,
                                                     const std::vector<std::string>& parts) {
  std::map<std::string, std::string> fingerprints;
  for (const auto& part : parts) fingerprints[part] = file_fingerprint(folder.walls() / (part + ".stl"));
  return fingerprints;
}

std::string wall_checksums(const CaseFolder& folder, const std::vector<std::string>& parts) {
  std::ostringstream lines;
  const auto fingerprints = wall_fingerprints(folder, parts);
  for (const auto& part : parts)
    lines << "# wall " << part << ".stl " << without_zeros(fingerprints.at(part)) << '\n';
  return lines.str();
}

std::vector<std::string> turning_parts(const meshing::Mill& mill, const std::vector<std::string>& parts) {
  return mill.machine() == meshing::Machine::stirred ? std::vector<std::string>{impeller_part} : parts;
}

}  // namespace millfoam::dem_driver
