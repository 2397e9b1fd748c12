// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/liggghts_run.hpp"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "dem_driver/child_process.hpp"
#include "dem_driver/progress.hpp"

namespace millfoam::dem_driver {

namespace {

std::string require(const std::string& program, const std::string& package) {
  const auto path = find_on_path(program);
  if (!path) throw RunError(program + " is not on PATH: install it (Debian: package " + package + ")");
  return path->string();
}

std::vector<std::string> command(const CaseFolder& folder, int ranks) {
  std::vector<std::string> words;
  if (ranks > 1) words = {require("mpirun", "openmpi-bin"), "-np", std::to_string(ranks)};
  words.insert(words.end(),
               {require("liggghts", "liggghts"), "-in", folder.deck().filename().string(), "-log", "none"});
  return words;
}

/// For Open MPI (others ignore it): ranks that wait give way and are not tied to a core, so that they do not
/// take time from a rank that works or from another program on the same core; and root has to say twice that
/// it means it.
std::vector<std::string> environment() {
  std::vector<std::string> variables{"OMPI_MCA_mpi_yield_when_idle=1",
                                     "OMPI_MCA_hwloc_base_binding_policy=none"};
  if (geteuid() == 0)
    variables.insert(variables.end(), {"OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"});
  return variables;
}

std::string phase(const LiggghtsLog& log, const DemPlan& plan) {
  if (!log.turning()) return "inserting and settling";
  const long step = log.steps_done() - (plan.total_steps() - plan.turning_steps);
  std::ostringstream text;
  text << "mill turning, t = " << std::fixed << std::setprecision(3)
       << static_cast<double>(step) * plan.step.value << " s";
  return text.str();
}

/// Reads the child's output to its end. Throws RunError without the log's name: the caller adds it.
void follow(ChildProcess& child, LiggghtsLog& log, std::ofstream& file, const DemPlan& plan,
            ProgressOutput output) {
  Progress progress(output.out, output.terminal, plan.total_steps());
  try {
    while (const auto line = child.read_line()) {
      file << *line << '\n' << std::flush;
      log.read(*line);
      progress.show(log.steps_done(), phase(log, plan));
    }
  } catch (const RunError&) {
    progress.end();
    throw;
  }
  progress.end();
  const int code = child.wait();
  if (!log.error().empty()) throw RunError("LIGGGHTS stopped: " + log.error());
  if (code != 0) throw RunError("LIGGGHTS stopped with exit code " + std::to_string(code));
  if (!log.finished()) throw RunError("LIGGGHTS ended before the deck's last line");
}

}  // namespace

RunResult run_liggghts(const CaseFolder& folder, const DemPlan& plan, int ranks, ProgressOutput progress) {
  const auto words = command(folder, ranks);
  std::ofstream file(folder.log());
  if (!file) throw RunError(folder.log().string() + ": cannot be written");
  LiggghtsLog log(plan);
  const auto start = std::chrono::steady_clock::now();
  try {
    ChildProcess child(words, folder.dem(), environment());
    follow(child, log, file, plan, progress);
  } catch (const RunError& error) {
    throw RunError(std::string(error.what()) + "\nlog: " + folder.log().string() + ", its last lines:\n" +
                   log.last_lines());
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;

  RunResult result;
  result.wall_time = elapsed.count();
  result.resting_speed = std::sqrt(2 * log.resting_energy() / plan.charge.mass());
  result.largest_overlap = log.largest_overlap();
  result.dumps = find_dumps(folder).size();
  if (static_cast<long>(result.dumps) != plan.dumps)
    throw RunError(folder.dumps().string() + ": " + std::to_string(result.dumps) + " dumps, expected " +
                   std::to_string(plan.dumps));
  return result;
}

void print_result(std::ostream& out, const DemPlan& plan, const RunResult& result) {
  const double particle_steps =
      static_cast<double>(plan.charge.balls()) * static_cast<double>(plan.total_steps());
  out << "done: " << plan.charge.balls() << " balls, " << plan.total_steps() << " steps of "
      << std::setprecision(4) << plan.step.value * 1e6 << " us in " << std::setprecision(3)
      << result.wall_time << " s (" << particle_steps / result.wall_time / 1e6
      << " million particle-steps per second)\n"
      << "charge at DEM time 0: rms speed " << result.resting_speed << " m/s\n"
      << "largest overlap of two balls seen: " << result.largest_overlap * 1e6 << " um, "
      << 100 * result.largest_overlap / plan.charge.classes.back().diameter << " % of the smallest diameter\n"
      << result.dumps << " dumps, one every " << plan.step.steps_per_record << " steps\n";
}

}  // namespace millfoam::dem_driver
