// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/run_plan.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "averaging/dumps/dump_reader.hpp"
#include "averaging/overlap/superquadric.hpp"
#include "averaging/run/dump_checks.hpp"
#include "averaging/run/grid_check.hpp"
#include "averaging/run/named_record.hpp"

namespace millfoam::averaging {

namespace {

/// Records in a block: so many that merging takes little time compared with the records themselves, but few
/// enough for many threads and ranks. It depends only on the run, so that the result does not depend on
/// threads and ranks.
std::size_t block_size(const std::vector<WindowPlan>& plans) {
  std::size_t records = 0;
  for (const WindowPlan& plan : plans) {
    for (const WindowSpan& span : plan.windows) records = std::max(records, span.first_record + span.records);
  }
  return std::clamp<std::size_t>(records / 64, 1, 16);
}

/// sum d^3 / sum d^2; 0 of no balls.
double sauter_diameter(const ParticleRecord& record) {
  double volume = 0, area = 0;
  for (std::size_t p = 0; p < record.particles.size(); ++p) {
    const double d =
        record.shapes.empty() ? 2 * record.particles[p].radius : volume_equivalent_diameter(record.shapes[p]);
    volume += d * d * d;
    area += d * d;
  }
  return area > 0 ? volume / area : 0;
}

}  // namespace

RunPlan plan_run(const AverageRequest& request, const AverageProgress& progress) {
  RunPlan plan;
  plan.dumps = find_dumps(request.dumps);
  plan.metadata = read_run_metadata(plan.dumps.front().path.parent_path());
  if (plan.metadata) require_dumps(*plan.metadata);
  if (plan.metadata && request.whole_run_dumped) require_all_dumps(*plan.metadata, plan.dumps.size());
  plan.settings.timestep = agreed_timestep(request.timestep, plan.metadata);
  plan.settings.angular_velocity = agreed_angular_velocity(request.angular_velocity, plan.metadata);
  const std::optional<long long> interval = plan.metadata ? plan.metadata->interval : std::nullopt;
  std::vector<long long> steps;
  for (const DumpFile& dump : plan.dumps) steps.push_back(dump.step);
  for (const WindowsRequest& windows : request.windows) {
    plan.series.push_back(plan_windows(steps, {plan.settings.timestep, interval, windows.length,
                                               request.start, request.end, request.whole_run_dumped}));
    for (const std::string& sentence : plan.series.back().notes) progress.note(sentence);
  }
  plan.blocks = plan_blocks(plan.series, block_size(plan.series));
  const std::size_t first = plan.blocks.front().first;
  check_numbers_of_balls(plan.dumps, first, plan.blocks.back().last, progress.note);
  const std::filesystem::path& first_dump = plan.dumps[first].path;
  plan.box = read_dump_header(first_dump).box;
  if (plan.box) require_period_of(request, *plan.box, first_dump.string());
  plan.settings.sauter_diameter =
      sauter_diameter(read_dump(plan.dumps[plan.series[0].windows[0].first_record].path));
  return plan;
}

void require_cells(const RunPlan& plan, const CellSetup& setup) {
  const std::unique_ptr<Deposition> deposition = setup.deposition->clone();
  for (const std::size_t r : {plan.blocks.front().first, plan.blocks.back().last - 1}) {
    const DumpFile& dump = plan.dumps[r];
    naming_record(dump.path.string(),
                  [&] { deposition->begin_record(static_cast<double>(dump.step) * plan.settings.timestep); });
  }
}

void require_fitting_grid(const AverageRequest& request, const RunPlan& plan, const CellSetup& setup) {
  const WindowSpan& last = plan.series[0].windows.back();
  std::string first_misfit;
  for (const std::size_t r : {plan.series[0].windows[0].first_record, last.first_record + last.records - 1}) {
    const DumpFile& dump = plan.dumps[r];
    const double time = static_cast<double>(dump.step) * plan.settings.timestep;
    const std::string found =
        misfit(setup, read_dump(dump.path), time, dump.path.string(), request.largest_outside);
    if (found.empty()) return;
    if (first_misfit.empty()) first_misfit = found;
  }
  throw std::invalid_argument(first_misfit);
}

}  // namespace millfoam::averaging
