// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/case_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "dem_driver/deck.hpp"
#include "dem_driver/json_file.hpp"
#include "dem_driver/segments.hpp"
#include "dem_driver/wall_check.hpp"
#include "dem_driver/wall_fit.hpp"
#include "meshing/files/file_fingerprint.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

/// Digits without leading zeros, as the decks have them.
std::string without_zeros(const std::string& digits) {
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size() - 1));
}

double number(const Json& run, const char* key, const fs::path& file) {
  if (!run.contains(key) || !run[key].is_number())
    throw std::runtime_error(file.string() + ": no number '" + key + "', expected one");
  return run[key].get<double>();
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
    for (const char* part : {impeller_part, "shell", "base", "lid"})
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

std::vector<fs::path> find_dumps(const CaseFolder& folder) {
  std::vector<fs::path> dumps;
  if (!fs::is_directory(folder.dumps())) return dumps;
  for (const auto& entry : fs::directory_iterator(folder.dumps())) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("dump.", 0) == 0 && entry.path().extension() == ".txt") dumps.push_back(entry.path());
  }
  return dumps;
}

FolderLock::FolderLock(const CaseFolder& folder, std::chrono::milliseconds longest_wait)
    : file_(open(folder.lock().c_str(), O_RDWR | O_CREAT, 0666)) {
  if (file_ < 0) throw std::runtime_error(folder.lock().string() + ": cannot be written");
  constexpr std::chrono::milliseconds between(100);
  for (std::chrono::milliseconds waited(0); flock(file_, LOCK_EX | LOCK_NB) != 0; waited += between) {
    if (waited >= longest_wait) {
      close(file_);
      throw std::runtime_error(folder.dem().string() +
                               ": another millDem runs in this folder, expected one at a time");
    }
    std::this_thread::sleep_for(between);
  }
}

FolderLock::~FolderLock() {
  close(file_);
}

void remove_results(const CaseFolder& folder) {
  for (const auto& file : {folder.run_file(), folder.results(), folder.energy(), folder.torques(),
                           folder.fluid(), folder.contact_power(), folder.contact_spectra(),
                           folder.wall_forces(), folder.overlaps(), folder.charge()})
    fs::remove(file);
}

std::size_t prepare_folders(const CaseFolder& folder) {
  fs::create_directories(folder.dem());
  fs::create_directories(folder.dumps());
  remove_results(folder);
  fs::remove(folder.fluid_order());
  fs::remove(folder.contact_order());
  remove_contact_states(folder, [](long) { return true; });
  fs::remove(folder.averages_order());
  for (const auto& file : find_averages(folder)) fs::remove(file);
  for (const auto& restart : find_restarts(folder)) fs::remove(restart.file);
  for (const char* kind : segment_kinds)
    for (const auto& segment : find_segments(folder, kind)) fs::remove(segment.file);
  for (const char* kind : contact_kinds)
    for (const auto& contacts : find_contacts(folder, kind)) fs::remove(contacts.file);
  const auto old = find_dumps(folder);
  for (const auto& dump : old) fs::remove(dump);
  return old.size();
}

std::string wall_checksums(const CaseFolder& folder, const std::vector<std::string>& parts) {
  std::ostringstream lines;
  for (const auto& part : parts)
    lines << "# wall " << part << ".stl " << without_zeros(file_fingerprint(folder.walls() / (part + ".stl")))
          << '\n';
  return lines.str();
}

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
