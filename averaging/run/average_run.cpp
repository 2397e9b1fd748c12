// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/average_run.hpp"

#include <algorithm>

#include "averaging/sharing/box_sampling.hpp"
#include "averaging/dumps/dump_reader.hpp"
#include "averaging/dumps/dump_series.hpp"
#include "averaging/statistics/time_windows.hpp"
#include "averaging/statistics/window_average.hpp"
#include "averaging/files/xdmf.hpp"

namespace millfoam::averaging {

namespace {

/// The dumps of a run and how they are cut.
struct Job {
  std::vector<DumpFile> dumps;
  double timestep = 0;
  WindowPlan plan;
};

Job prepare(const AverageRequest& request) {
  Job job;
  job.dumps = find_dumps(request.dumps);
  const std::optional<RunNotes> notes = read_run_notes(job.dumps.front().path.parent_path());
  job.timestep = agreed_timestep(request.timestep, notes);
  std::vector<long long> steps;
  for (const DumpFile& dump : job.dumps) steps.push_back(dump.step);
  job.plan = plan_windows(steps, {job.timestep, notes ? notes->interval : std::nullopt, request.window,
                                  request.start, request.end});
  return job;
}

double non_zero(const std::vector<double>& values) {
  return static_cast<double>(values.size()) -
         static_cast<double>(std::count(values.begin(), values.end(), 0.0));
}

/// Sums that become means once all windows are through.
struct Tally {
  double balls = 0;
  double record_voxels = 0;  ///< occupied, over records
  double solidity = 0;
  double window_voxels = 0;  ///< occupied, over windows
};

WindowAverage average_window(const AverageRequest& request, const SphereTemplate& points, const Job& job,
                             const WindowSpan& span, Tally& tally,
                             const std::function<void()>& after_record) {
  WindowAverager averager(request.grid);
  for (std::size_t r = span.first_record; r < span.first_record + span.records; ++r) {
    const RecordSums sums = sample_record(request.grid, points, read_dump(job.dumps[r].path));
    averager.add(sums);
    tally.balls += sums.balls;
    tally.record_voxels += non_zero(sums.volume);
    after_record();
  }
  WindowAverage window = averager.average();
  window.time.begin = static_cast<double>(span.begin) * job.timestep;
  window.time.end = static_cast<double>(span.end) * job.timestep;
  return window;
}

void summarise(const WindowAverage& window, Tally& tally, AverageSummary& summary) {
  summary.windows.push_back(window.time);
  summary.ledgers.push_back(window.ledger);
  for (const double solidity : window.mean.solidity) {
    tally.solidity += solidity;
    summary.largest_solidity = std::max(summary.largest_solidity, solidity);
  }
  tally.window_voxels += non_zero(window.mean.solidity);
}

}  // namespace

AverageSummary average_run(const AverageRequest& request, const AverageProgress& progress) {
  xdmf_path(request.output);  // a name that cannot be used is refused before the work, not after it
  const SphereTemplate points(request.template_points);
  const Job job = prepare(request);
  for (const std::string& sentence : job.plan.notes) progress.note(sentence);

  std::size_t total = 0;
  for (const WindowSpan& span : job.plan.windows) total += span.records;
  const SolidsHeader header{static_cast<double>(job.plan.windows.front().begin) * job.timestep, job.timestep,
                            !request.window};
  SolidsWriter writer(request.output, request.grid, header);
  AverageSummary summary;
  Tally tally;
  for (const WindowSpan& span : job.plan.windows) {
    const WindowAverage window =
        average_window(request, points, job, span, tally, [&] { progress.records(++summary.dumps, total); });
    summarise(window, tally, summary);
    writer.append(window);
  }
  writer.finish();
  write_xdmf(request.output);
  if (tally.record_voxels > 0) summary.balls_per_occupied_voxel = tally.balls / tally.record_voxels;
  if (tally.window_voxels > 0) summary.occupied_solidity = tally.solidity / tally.window_voxels;
  return summary;
}

}  // namespace millfoam::averaging
