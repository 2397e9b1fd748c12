// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/tools/averages_of_run.hpp"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>
#include <stdexcept>

#include "averaging/dumps/run_metadata.hpp"
#include "averaging/files/xdmf.hpp"
#include "averaging/run/solids_output.hpp"
#include "averaging/tools/mill_averages.hpp"
#include "meshing/mill/mill_error.hpp"
#include "meshing/walls/wall_files.hpp"
#include "millfoam_version.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

/// sum d^3 / sum d^2 over the balls.
double sauter_diameter(const ChargePlan& charge) {
  double volume = 0, area = 0;
  for (const ClassCount& size : charge.classes) {
    const auto count = static_cast<double>(size.count);
    volume += count * size.diameter * size.diameter * size.diameter;
    area += count * size.diameter * size.diameter;
  }
  return volume / area;
}

averaging::LiveRun run_of(const meshing::Mill& mill, const DemPlan& plan) {
  averaging::LiveRun run;
  run.settings = {plan.step.value, mill.angular_velocity, sauter_diameter(plan.charge)};
  run.begin = plan.begin;
  run.interval = plan.step.steps_per_record;
  run.balls = plan.charge.balls();
  return run;
}

/// Throws for a file that another request is to write; `outputs` are theirs.
void require_other_outputs(const averaging::AverageRequest& request, std::set<fs::path>& outputs) {
  for (const averaging::WindowsRequest& windows : request.windows)
    if (!outputs.insert(fs::weakly_canonical(windows.output)).second)
      throw std::invalid_argument(windows.output.string() +
                                  " would be written twice, expected another file for each: give -o FILE");
}

/// Throws as Deposition where cells are not known at the first or the last record of a window: cells that
/// move may have a table of a part of the run alone.
void require_cells(averaging::Deposition& deposition, const std::vector<averaging::WindowPlan>& plans,
                   const averaging::LiveRun& run) {
  for (const averaging::WindowPlan& plan : plans)
    for (const long long step : {plan.windows.front().begin, plan.windows.back().end - run.interval})
      deposition.begin_record(static_cast<double>(step) * run.settings.timestep);
}

/// Prints what is wrong with a ledger; returns whether it is within the tolerance.
bool judge(const averaging::SolidsSummary& summary, double tolerance, std::ostream& out) {
  const std::vector<std::string> failures = averaging::ledger_failures(summary, tolerance);
  for (const std::string& failure : failures) out << summary.file.string() << ": " << failure << '\n';
  return failures.empty();
}

}  // namespace

AveragesOfRun::AveragesOfRun(const meshing::MillDescription& description, const CaseFolder& folder,
                             const std::map<std::string, std::string>& walls,
                             const std::vector<std::string>& options, DemPlan& plan, std::ostream& out)
    : mill_(description.mill), folder_(folder), walls_(walls), plan_(plan) {
  texts_ = options;
  if (mill_.averages.live) texts_.insert(texts_.begin(), "");
  if (texts_.empty() && !mill_.dem.dumps)
    throw meshing::KeyError("dem.dumps", "no",
                            "yes, or averages.live: yes: without dumps the balls cannot be averaged later");
  order_.run = run_of(mill_, plan);
  for (const std::string& text : texts_)
    requests_.push_back(averaging::live_request(description, text, folder.root.string(), plan.begin_time(),
                                                plan.duration(), plan.step.value));
  std::set<fs::path> outputs;
  for (std::size_t n = 0; n < requests_.size(); ++n)
    averaging::naming_options(texts_[n], [&] { require_other_outputs(requests_[n].request, outputs); });
  require_walls();
  plan.averages_bytes = 0;
  for (std::size_t n = 0; n < requests_.size(); ++n)
    averaging::naming_options(texts_[n], [&] { order(requests_[n].request, plan, out); });
}

void AveragesOfRun::order(const averaging::AverageRequest& request, DemPlan& plan, std::ostream& out) {
  for (const averaging::WindowsRequest& windows : request.windows) averaging::xdmf_path(windows.output);
  averaging::lock_outputs(request);
  const auto setup = averaging::set_up(request, order_.run.settings,
                                       [&](const std::string& sentence) { out << sentence << '\n'; });
  const auto plans = plan_live(request, order_.run, plan.end_step());
  require_cells(*setup.deposition, plans, order_.run);
  plan.averages_bytes += averaging::journal_bytes(setup, plans);
  plan.averages.push_back(averages_id(request));
  order_.averages.push_back({plan.averages.back(), request});
}

void AveragesOfRun::require_walls() const {
  std::error_code none;
  for (const averaging::LiveRequest& averages : requests_)
    for (const fs::path& wall : averages.request.walls)
      if (fs::equivalent(wall.parent_path(), folder_.walls(), none))
        return meshing::require_walls_of_run(folder_.walls(), walls_, "fingerprints at the run's begin");
}

void AveragesOfRun::write_order() const {
  if (requests_.empty())
    fs::remove(folder_.averages_order());
  else
    write_averages_order(folder_.averages_order(), mill_, order_);
}

/// Returns whether the ledger is within the tolerance.
bool AveragesOfRun::finish_one(std::size_t number, bool keep, std::ostream& out) const {
  const averaging::LiveRequest& averages = requests_[number];
  averaging::AverageRequest request = averages.request;
  if (averages.end) request.end = averages.end;
  averaging::LiveEnd end;
  end.step = plan_.end_step();
  end.metadata = averaging::read_run_metadata(folder_.dumps());
  end.program = std::string("millDem ") + version();
  end.box = averaging::box_of_run(mill_);
  averaging::SteadyStart steady;
  if (averages.steady) {
    steady = averaging::steady_start(folder_.results());
    end.steady_from = steady.time;
  }
  bool passes = true;
  if (keep && averaging::are_finished(request, order_.run, end)) {
    for (const averaging::WindowsRequest& windows : request.windows)
      passes = judge(averaging::read_ledgers(windows.output), averages.tolerance, out) && passes;
    return passes;
  }
  if (!steady.warning.empty()) out << steady.warning << '\n';
  for (const averaging::SolidsSummary& summary : averaging::finish_live(
           request, order_.run, averages_files(folder_.dem(), number), plan_.averages[number], end,
           [&](const std::string& sentence) { out << sentence << '\n'; })) {
    out << averaging::report(summary);
    passes = judge(summary, averages.tolerance, out) && passes;
  }
  return passes;
}

void AveragesOfRun::finish(bool keep, std::ostream& out) const {
  bool passes = true;
  require_walls();
  for (std::size_t n = 0; n < requests_.size(); ++n) {
    const bool one = averaging::naming_options(texts_[n], [&] { return finish_one(n, keep, out); });
    passes = one && passes;
  }
  if (!passes) throw std::runtime_error("the averages are beyond their --tolerance, see above");
}

}  // namespace millfoam::dem_driver
