// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/forecast.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <ostream>
#include <sstream>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/child_process.hpp"
#include "dem_driver/contact_order.hpp"
#include "dem_driver/deck.hpp"
#include "dem_driver/deck_outputs.hpp"
#include "dem_driver/folder_preparation.hpp"
#include "dem_driver/liggghts_run.hpp"
#include "dem_driver/pairs.hpp"
#include "dem_driver/segments.hpp"
#include "dem_driver/wall_parts.hpp"
#include "meshing/files/output_file.hpp"
#include "meshing/mill/mill_charge.hpp"
#include "meshing/mill_mesh/section_blocks.hpp"
#include "meshing/walls/stirred_walls.hpp"
#include "meshing/walls/wall_files.hpp"
#include "meshing/walls/wall_surface.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

constexpr double trial_steps = 2000;
constexpr double most_trial_contacts = 200;  // dumps
// Both measured on 55 000 balls of 5 mm, on one and on two ranks.
constexpr double memory_per_ball = 2000;
constexpr double restart_per_ball = 440;

class TrialFolder {
 public:
  TrialFolder() {
    std::string name = (fs::temp_directory_path() / "millDem-plan-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": no temporary folder");
    path_ = name;
  }
  ~TrialFolder() {
    std::error_code ignored;
    if (!kept_) fs::remove_all(path_, ignored);
  }
  /// Leaves the folder where it is.
  void keep() { kept_ = true; }
  TrialFolder(const TrialFolder&) = delete;
  TrialFolder& operator=(const TrialFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  bool kept_ = false;
};

/// Balls times steps over the time of LIGGGHTS' loops while the mill turned.
double logged_rate(const fs::path& file) {
  std::ifstream in(file);
  bool turning = false;
  double time = 0;
  double work = 0;
  for (std::string line; std::getline(in, line);) {
    turning = turning || line.rfind(turning_mark, 0) == 0;
    if (!turning || line.rfind("Loop time of", 0) != 0) continue;
    // Loop time of 4.2 on 2 procs for 1130 steps with 3521 atoms
    std::istringstream words(line);
    std::string word;
    double seconds = 0;
    double ranks = 0;
    double steps = 0;
    double balls = 0;
    words >> word >> word >> word >> seconds >> word >> ranks >> word >> word >> steps >> word >> word >>
        balls;
    time += seconds;
    work += steps * balls;
  }
  if (!(time > 0)) throw RunError(file.string() + ": no time of a loop, expected that of the turning mill");
  return work / time;
}

double dump_bytes_per_ball(const CaseFolder& folder, const DemPlan& plan) {
  if (plan.dumps == 0) return 0;
  double bytes = 0;
  for (const auto& dump : find_dumps(folder)) bytes += static_cast<double>(fs::file_size(dump));
  return bytes / static_cast<double>(plan.dumps * plan.charge.balls());
}

double contact_bytes_per_ball(const CaseFolder& folder, const DemPlan& plan) {
  if (plan.contact_dumps == 0) return 0;
  double bytes = 0;
  for (const char* kind : contact_kinds)
    for (const auto& contacts : find_contacts(folder, kind))
      bytes += static_cast<double>(fs::file_size(contacts.file));
  return bytes / static_cast<double>(plan.contact_dumps * plan.charge.balls());
}

/// Balls times steps of the whole run: those of a round move from their insertion on.
double work_of(const DemPlan& plan) {
  double inserted = 0;
  double work = 0;
  const auto& rounds = plan.charge.rounds;
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    for (const auto& insertion : rounds[i]) inserted += static_cast<double>(insertion.count);
    work += inserted * static_cast<double>(i + 1 < rounds.size() ? plan.round_steps : plan.settle_steps);
  }
  return work + inserted * static_cast<double>(plan.turning_steps);
}

/// A periodic slice of the mill with some balls.
void take_trial_slice(const meshing::Mill& mill, const DemPlan& whole, int ranks, meshing::Mill& trial) {
  const double largest = whole.charge.classes.front().diameter;
  // A slice may be no shorter, also of a mill with ends that is
  const double least = meshing::fewest_diameters_of_period * mill.charge.longest_way();
  const double shortest =
      std::max(least, std::min(mill.geometry.length, std::max(2.5, 1.6 * ranks) * largest));
  const double balls = whole.charge.has_shapes() ? trial_shaped_balls : trial_balls;
  const double wanted = mill.geometry.length * balls / static_cast<double>(whole.charge.balls());
  trial.geometry.length = std::clamp(wanted, shortest, std::max(shortest, mill.geometry.length));
  trial.geometry.ends = meshing::Ends::periodic;
  trial.geometry.inlet.reset();
  trial.geometry.grates.reset();
  trial.geometry.pulp_lifters.reset();
  // No class vanishes: it would no longer set the skin of the neighbour lists as it does in the mill.
  for (auto& size : trial.charge.classes)
    size.mass = std::max(size.mass * trial.geometry.length / mill.geometry.length,
                         meshing::ball_mass(trial, size.diameter));
}

/// The stirred mill smaller, with the same speed of the tips, so that fewer of the same balls fill it as
/// high.
void shrink_stirred_mill(const meshing::Mill& mill, const DemPlan& whole, meshing::Mill& trial) {
  const double scale = std::cbrt(trial_shaped_balls / static_cast<double>(whole.charge.balls()));
  if (scale >= 1) return;
  meshing::Geometry& geometry = trial.geometry;
  meshing::Impeller& impeller = *geometry.impeller;
  std::vector<double*> lengths = {&geometry.diameter,         &geometry.length,
                                  &impeller.shaft_diameter,   &impeller.shaft_end,
                                  &trial.charge.start_radius, &trial.charge.start_length,
                                  &trial.charge.start_bottom, &trial.charge.start_core};
  for (auto& pins : impeller.pins)
    lengths.insert(lengths.end(), {&pins.height, &pins.length, &pins.thickness});
  for (auto& disc : impeller.discs)
    lengths.insert(lengths.end(), {&disc.height, &disc.diameter, &disc.thickness});
  for (double* length : lengths) *length *= scale;
  trial.angular_velocity /= scale;
  for (auto& size : trial.charge.classes)
    size.mass = std::max(size.mass * std::pow(scale, 3), meshing::ball_mass(mill, size.diameter));
}

meshing::WallSurface walls_of(const meshing::Mill& mill) {
  if (mill.machine() == meshing::Machine::stirred) return meshing::make_stirred_walls(mill.geometry);
  const auto section = meshing::make_cross_section(mill.geometry, mill.resolution);
  return meshing::make_wall_surface(section, mill.geometry.length);
}

}  // namespace

meshing::Mill trial_mill(const meshing::Mill& mill, int ranks) {
  meshing::Mill trial = mill;
  const long steps_between_contacts = plan_dem(mill).contact_steps;
  trial.dem.contact_interval = 0;
  trial.dem.youngs_modulus = std::max(smallest_modulus, std::min(1e7, mill.ball.youngs_modulus));
  trial.dem.largest_overlap = 0;
  trial.dem.soften_below = 0;
  trial.dem.pool_level.reset();

  const DemPlan whole = plan_dem(trial);
  // A stirred mill has no slice: its trial is the whole mill, or a smaller one where a step takes longer
  if (mill.machine() == meshing::Machine::tumbling)
    take_trial_slice(mill, whole, ranks, trial);
  else if (whole.charge.has_shapes())
    shrink_stirred_mill(mill, whole, trial);

  trial.dem.settle_time = 0.1;
  trial.dem.record_interval = trial_steps / 10 * whole.step.value;
  trial.dem.duration = trial_steps * whole.step.value;
  // As often as in the mill, so that the rate has the time that writing them takes; but not so often that
  // the trial fills a disk
  if (steps_between_contacts > 0)
    trial.dem.contact_interval = std::clamp(static_cast<double>(steps_between_contacts),
                                            trial_steps / most_trial_contacts, trial_steps) *
                                 whole.step.value;
  return trial;
}

namespace {

/// Runs the trial mill in an empty folder.
Cost measure_in(const CaseFolder& folder, const meshing::Mill& mill, int ranks) {
  const meshing::Mill trial = trial_mill(mill, ranks);
  meshing::write_walls(walls_of(trial), trial.geometry.ends, folder.walls());
  const DemPlan plan = plan_dem(trial);
  prepare_folders(folder);
  const auto parts = find_walls(folder, trial);
  replace_file(folder.deck(), [&](std::ostream& out) { write_deck(out, trial, plan, parts, ranks); });
  if (plan.watches_contacts)
    write_contact_order(folder.contact_order(), trial, contact_order_of(trial, plan, parts, folder.walls()));
  std::ostringstream unseen;
  run_liggghts(folder, plan, ranks, {unseen, false});
  return {logged_rate(folder.log()), dump_bytes_per_ball(folder, plan),
          largest_child_memory() - memory_per_ball * static_cast<double>(plan.charge.balls()) / ranks,
          contact_bytes_per_ball(folder, plan)};
}

}  // namespace

Cost measure_cost(const meshing::Mill& mill, int ranks) {
  TrialFolder temporary;
  try {
    return measure_in({temporary.path()}, mill, ranks);
  } catch (const RunError&) {
    temporary.keep();  // the message names files of it
    throw;
  }
}

Forecast forecast(const DemPlan& plan, const Cost& cost, int ranks) {
  const auto balls = static_cast<double>(plan.charge.balls());
  Forecast result;
  result.steps = plan.total_steps();
  result.wall_time = work_of(plan) / cost.rate;
  const double histogram = 2 * overlap_bins * 16.0 * static_cast<double>(plan.turning_steps) /
                           static_cast<double>(plan.restart_steps);
  const double dumps = cost.dump * static_cast<double>(plan.dumps);
  const double contacts = cost.contacts * static_cast<double>(plan.contact_dumps);
  result.disk = balls * (dumps + contacts + restart_per_ball) + histogram + plan.averages_bytes;
  result.memory = ranks * cost.memory + balls * memory_per_ball;
  return result;
}

void print_forecast(std::ostream& out, const Forecast& forecast, const Cost& cost, int ranks) {
  const long minutes = std::lround(forecast.wall_time / 60);
  out << std::setprecision(3) << "plan for " << ranks << " rank(s), from a trial at " << cost.rate / 1e6
      << " million particle-steps per second\n"
      << "  steps      " << forecast.steps << "\n  wall time  ";
  if (forecast.wall_time < 120)
    out << forecast.wall_time << " s";
  else
    out << minutes / 60 << " h " << std::setw(2) << std::setfill('0') << minutes % 60 << " min"
        << std::setfill(' ');
  out << "\n  disk       " << forecast.disk / 1e9 << " GB\n  memory     " << forecast.memory / 1e9 << " GB\n";
}

}  // namespace millfoam::dem_driver
