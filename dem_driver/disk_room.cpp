// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/disk_room.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "dem_driver/segments.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

// Of every ball, bytes. Measured: 101 in a dump, 255 in the three dumps of the contacts and 290 to 440 in
// a restart file; these are less, so that only impossible runs are refused.
constexpr double least_dump = 80;
constexpr double least_contacts = 150;
constexpr double least_restart = 200;
constexpr double full_disk = 1e6;      // bytes: with less room it counts as full
constexpr double full_per_ball = 500;  // bytes, for each ball

double bytes_free(const fs::path& folder) {
  return static_cast<double>(fs::space(folder).available);
}

std::string megabytes(double bytes) {
  std::ostringstream text;
  text.precision(3);
  if (bytes < 1e9)
    text << bytes / 1e6 << " MB";
  else
    text << bytes / 1e9 << " GB";
  return text.str();
}

/// What the dumps after a step have, bytes.
double removable(const CaseFolder& folder, long step) {
  double bytes = 0;
  const auto add = [&](const NumberedFile& file) {
    if (file.step > step) bytes += static_cast<double>(fs::file_size(file.file));
  };
  for (const auto& dump : find_numbered_dumps(folder)) add(dump);
  for (const char* kind : contact_kinds)
    for (const auto& contacts : find_contacts(folder, kind)) add(contacts);
  return bytes;
}

}  // namespace

double least_disk(const DemPlan& plan, long begin) {
  const auto balls = static_cast<double>(plan.charge.balls());
  const auto steps = static_cast<double>(plan.end_step() - begin);
  const double dumps = plan.dumps > 0 ? steps / static_cast<double>(plan.step.steps_per_record) : 0;
  const double contacts = plan.contact_steps > 0 ? steps / static_cast<double>(plan.contact_steps) : 0;
  const double averages = plan.averages_bytes * steps / static_cast<double>(plan.turning_steps);
  return balls * (dumps * least_dump + contacts * least_contacts + least_restart) + averages;
}

void require_room(const CaseFolder& folder, const DemPlan& plan, long begin) {
  const double needed = least_disk(plan, begin);
  const double available = bytes_free(folder.root) + removable(folder, begin);
  if (needed <= available) return;
  throw std::runtime_error(
      fs::canonical(folder.root).string() + ": the disk has room for " + megabytes(available) +
      ", expected at least " + megabytes(needed) + " for " +
      (plan.dumps > 0 ? std::to_string(plan.dumps) + " dumps of "
                      : "averages, contacts and restart files of ") +
      std::to_string(plan.charge.balls()) +
      " balls: free some room, raise dem.record_interval or dem.contact_interval, or lower dem.duration");
}

std::string free_in_words(const fs::path& folder, long balls) {
  const double available = bytes_free(folder);
  if (available < full_disk + full_per_ball * static_cast<double>(balls))
    return "the disk is full, " + megabytes(available) + " are free";
  return megabytes(available) + " are free on the disk: does a quota or 'ulimit -f' limit the file's size";
}

}  // namespace millfoam::dem_driver
