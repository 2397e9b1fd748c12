// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/liggghts_run.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "dem_driver/child_process.hpp"
#include "dem_driver/output_check.hpp"
#include "dem_driver/progress.hpp"
#include "dem_driver/segments.hpp"

namespace millfoam::dem_driver {

namespace {

std::string require(const std::string& program, const std::string& package) {
  const auto path = find_on_path(program);
  if (!path) throw RunError(program + " is not on PATH: install it (Debian: package " + package + ")");
  return path->string();
}

/// millLiggghts, which is in the folder of this program, or what MILLFOAM_LIGGGHTS names, a path or a name on
/// PATH; of superquadrics, the program that is linked with their library.
std::string liggghts_program(bool superquadrics) {
  const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  if (superquadrics) {
    const auto program = folder / "millLiggghtsSuperquadric";
    if (!std::filesystem::exists(program))
      throw RunError(program.string() +
                     ": no such program, which the key 'shape' of the charge needs: expected spheres, or the "
                     "program next to millDem: build it with scripts/setup --superquadrics");
    return program.string();
  }
  const char* other = std::getenv("MILLFOAM_LIGGGHTS");
  if (other != nullptr && *other != '\0') {
    if (std::filesystem::path(other).has_parent_path()) return std::filesystem::absolute(other).string();
    return require(other, "liggghts");
  }
  const auto program = folder / "millLiggghts";
  if (!std::filesystem::exists(program))
    throw RunError(program.string() +
                   ": no such program, expected it next to millDem: build or install millFoam "
                   "with the library of LIGGGHTS (Debian: package libliggghts-dev)");
  return program.string();
}

/// setpriv has the program end when millDem does, however that is killed.
std::vector<std::string> command(const std::filesystem::path& deck, const DemPlan& plan, int ranks) {
  const std::string liggghts = liggghts_program(plan.charge.has_shapes());
  std::vector<std::string> words{require("setpriv", "util-linux"), "--pdeathsig", "TERM"};
  if (ranks > 1) words.insert(words.end(), {require("mpirun", "openmpi-bin"), "-np", std::to_string(ranks)});
  words.insert(words.end(), {liggghts, "-in", deck.filename().string(), "-log", "none"});
  return words;
}

/// For Open MPI (others ignore it): ranks that wait give way and are not tied to a core, so that they do not
/// take time from a rank that works or from another program on the same core; and root must confirm twice.
std::vector<std::string> environment() {
  std::vector<std::string> variables{"OMPI_MCA_mpi_yield_when_idle=1",
                                     "OMPI_MCA_hwloc_base_binding_policy=none"};
  if (geteuid() == 0)
    variables.insert(variables.end(), {"OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"});
  return variables;
}

std::string phase(const LiggghtsLog& log, const DemPlan& plan) {
  if (!log.turning()) return "inserting and settling";
  const long step = plan.begin + log.steps_done() - plan.resting_steps();
  std::ostringstream text;
  text << "mill turning, t = " << std::fixed << std::setprecision(3)
       << static_cast<double>(step) * plan.step.value << " s";
  return text.str();
}

/// Step of the oldest restart file to keep when that of `step` is written: itself, or with a flow at the same
/// time the one before. Such a flow may fail at its very end, after the balls: then both compute the last
/// piece again.
long oldest_to_keep(const CaseFolder& folder, const DemPlan& plan, long step) {
  long oldest = step;
  if (plan.fluid.kind == FluidKind::flow)
    for (const NumberedFile& restart : find_restarts(folder))
      if (restart.step < step) oldest = oldest == step ? restart.step : std::max(oldest, restart.step);
  return oldest;
}

/// Reads the child's output to its end. Throws RunError without the log's name: the caller adds it.
void follow(ChildProcess& child, LiggghtsLog& log, std::ofstream& file, const CaseFolder& folder,
            const DemPlan& plan, int ranks, OutputCheck& check, ProgressOutput output) {
  Progress progress(output.out, output.terminal, plan.total_steps());
  std::optional<long> last_restart;
  try {
    while (const auto line = child.read_line()) {
      file << *line << '\n' << std::flush;
      log.read(*line);
      progress.show(log.steps_done(), phase(log, plan));
      if (log.dumped_until()) check.dumps_until(*log.dumped_until());
      if (log.restart_step() != last_restart) {
        last_restart = log.restart_step();
        check.restart(*last_restart);
        remove_restarts_before(folder, oldest_to_keep(folder, plan, *last_restart));
      }
    }
  } catch (const RunError&) {
    progress.end();
    throw;
  }
  progress.end();
  const int code = child.wait();
  if (!log.error().empty()) throw RunError("LIGGGHTS stopped: " + log.error());
  if (code != 0 && ranks > 1 && !log.begun())
    throw RunError("mpirun refused to run LIGGGHTS on " + std::to_string(ranks) + " ranks (exit code " +
                   std::to_string(code) + ")");
  if (code != 0) throw RunError("LIGGGHTS stopped with exit code " + std::to_string(code));
  if (!log.finished()) throw RunError("LIGGGHTS ended before the deck's last line");
}

/// Sum of the times that LIGGGHTS' loops took, s.
double logged_time(const std::filesystem::path& file) {
  std::ifstream in(file);
  const std::string mark = "Loop time of ";
  double sum = 0;
  for (std::string line; std::getline(in, line);)
    if (line.rfind(mark, 0) == 0) sum += std::atof(line.c_str() + mark.size());
  return sum;
}

}  // namespace

void require_programs(const DemPlan& plan, int ranks) {
  command("", plan, ranks);
}

RunResult run_liggghts(const CaseFolder& folder, const DemPlan& plan, int ranks, ProgressOutput progress,
                       std::optional<long> resumed_at) {
  const auto words = command(resumed_at ? folder.resume_deck() : folder.deck(), plan, ranks);
  RunResult result;
  result.ranks = ranks;
  if (resumed_at) result.wall_time = logged_time(folder.log());
  std::ofstream file(folder.log(), resumed_at ? std::ios::app : std::ios::trunc);
  if (!file) throw RunError(folder.log().string() + ": cannot be written");
  LiggghtsLog log(plan, resumed_at.has_value());
  OutputCheck check(folder, plan, resumed_at.value_or(plan.begin));
  const auto start = std::chrono::steady_clock::now();
  try {
    ChildProcess child(words, folder.dem(), environment());
    follow(child, log, file, folder, plan, ranks, check, progress);
  } catch (const RunError& error) {
    // Open MPI gives its reason first, and then much advice.
    const bool of_mpirun = ranks > 1 && !log.begun();
    throw RunError(
        std::string(error.what()) + "\nlog: " + folder.log().string() +
        (of_mpirun ? ", its first lines:\n" + log.first_lines() : ", its last lines:\n" + log.last_lines()));
  }
  result.wall_time += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.memory = ranks * largest_child_memory();
  result.balls = log.balls();
  result.liggghts = log.version();
  result.dumps = find_dumps(folder).size();
  if (static_cast<long>(result.dumps) != plan.dumps)
    throw RunError(folder.dumps().string() + ": " + std::to_string(result.dumps) + " dumps, expected " +
                   std::to_string(plan.dumps));
  const std::string complaint = contacts_complaint(folder, plan, plan.end_step());
  if (!complaint.empty()) throw RunError(complaint);
  check.dumps_until(plan.end_step());
  return result;
}

}  // namespace millfoam::dem_driver
