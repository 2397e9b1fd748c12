// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/live_averages.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "averaging/files/solids_file.hpp"
#include "averaging/run/checkpoint.hpp"
#include "averaging/run/dump_checks.hpp"
#include "averaging/run/endless_windows.hpp"
#include "averaging/run/grid_check.hpp"
#include "averaging/run/solids_output.hpp"
#include "averaging/statistics/record_sums.hpp"

namespace millfoam::averaging {

namespace fs = std::filesystem;

namespace {

void ignore(const std::string&) {}

std::size_t hash(const std::string& id) {
  return std::hash<std::string>()(id);
}

/// The state after a record. Throws SolidsFileError where it is not there.
Checkpoint state_at(const LiveFiles& files, const std::string& id, long long step) {
  const fs::path file = files.checkpoint(step);
  std::optional<Checkpoint> state = read_checkpoint(file);
  if (!state || state->signature != id || state->reached != static_cast<std::size_t>(step))
    throw SolidsFileError(file.string() + ": is not the state of these averages after step " +
                          std::to_string(step) + ": run again without --resume");
  return *std::move(state);
}

/// A series as it was after a record. Throws SolidsFileError where its journal is not there.
WindowRecorder recorder_at(const LiveFiles& files, std::size_t number, const CellSetup& setup,
                           const std::string& id, const Checkpoint* state) {
  const fs::path journal = files.journal(number);
  const std::size_t cells = cell_count(setup.grid), rows = state != nullptr ? state->rows[number] : 0;
  if (rows > 0 && !WindowJournal::holds(journal, hash(id), cells, !setup.limits.whole_volumes.empty(), rows))
    throw SolidsFileError(journal.string() + ": lacks windows of the run, expected " + std::to_string(rows) +
                          ": run again without --resume");
  WindowRecorder recorder(journal, setup.limits, cells, hash(id), rows);
  if (state != nullptr) recorder.open().unpack(state->open[number]);
  return recorder;
}

/// Leaves out the windows that begin before a time.
void leave_out_before(double time, double timestep, WindowPlan& plan) {
  const auto early = [&](const WindowSpan& span) {
    return static_cast<double>(span.begin) * timestep < time * (1 - 1e-9);
  };
  const auto first = std::find_if_not(plan.windows.begin(), plan.windows.end(), early);
  std::ostringstream words;
  words << " before " << time << " s, from which on the charge is steady";
  if (first == plan.windows.end())
    throw WindowError("all windows begin" + words.str() +
                      ": raise dem.duration and give --resume, or give averages.start");
  const auto left_out = std::distance(plan.windows.begin(), first);
  plan.windows.erase(plan.windows.begin(), first);
  if (left_out > 0)
    plan.notes.push_back(std::to_string(left_out) + " windows begin" + words.str() + ": they are left out");
}

/// The windows of each series of the files.
std::vector<WindowPlan> plans_of_files(const AverageRequest& request, const LiveRun& run,
                                       const LiveEnd& end) {
  std::vector<WindowPlan> plans = plan_live(request, run, end.step);
  if (end.steady_from)
    for (WindowPlan& plan : plans) leave_out_before(*end.steady_from, run.settings.timestep, plan);
  return plans;
}

/// The header of the file of a series.
SolidsHeader header_of(const AverageRequest& request, std::size_t number, const LiveRun& run,
                       const CellSetup& setup, const LiveEnd& end, const WindowPlan& plan) {
  const double time0 = static_cast<double>(plan.windows.front().begin) * run.settings.timestep;
  return solids_header(request, request.windows[number], run.settings, setup, end.metadata, time0,
                       end.program);
}

}  // namespace

struct LiveAverages::Series {
  EndlessWindows windows;
  std::optional<WindowRecorder> recorder;  ///< of rank 0
};

fs::path LiveFiles::journal(std::size_t number) const {
  return base.string() + ".series_" + std::to_string(number + 1) + ".journal";
}

fs::path LiveFiles::checkpoint(long long step) const {
  return base.string() + '.' + std::to_string(step);
}

bool has_checkpoint(const LiveFiles& files, const std::string& id, long long step) {
  const std::optional<Checkpoint> state = read_checkpoint(files.checkpoint(step));
  if (!state || state->signature != id || state->reached != static_cast<std::size_t>(step)) return false;
  for (std::size_t s = 0; s < state->rows.size(); ++s)
    if (state->rows[s] > 0 && !fs::exists(files.journal(s))) return false;
  return true;
}

LiveAverages::LiveAverages(const AverageRequest& request, const LiveRun& run, LiveFiles files, std::string id,
                           std::optional<long long> resumed, Communicator& communicator)
    : request_(request),
      run_(run),
      files_(std::move(files)),
      id_(std::move(id)),
      communicator_(communicator),
      setup_(set_up(request, run.settings, ignore)),
      last_(resumed.value_or(run.begin - run.interval)) {
  for (const WindowsRequest& windows : request.windows)
    series_.push_back({{request, windows, run.settings.timestep, run.begin}, std::nullopt});
  if (communicator.rank() != 0) return;
  std::optional<Checkpoint> state;
  if (resumed) state = state_at(files_, id_, *resumed);
  for (std::size_t s = 0; s < series_.size(); ++s)
    series_[s].recorder.emplace(recorder_at(files_, s, setup_, id_, state ? &*state : nullptr));
}

LiveAverages::~LiveAverages() = default;

void LiveAverages::require_balls(double found, long long step) const {
  if (found == static_cast<double>(run_.balls)) return;
  std::ostringstream message;
  message << static_cast<long long>(found) << " balls at step " << step << ", expected " << run_.balls;
  throw std::runtime_error(message.str());
}

/// Leaves the record's sums over all balls on rank 0, in one reduction.
void LiveAverages::sum_over_ranks(const ParticleRecord& own, double time) {
  sum_record(*setup_.deposition, own, time, sums_);
  std::vector<double>& numbers = sums_.values;
  const std::size_t cells = numbers.size();
  Ledger& ledger = sums_.ledger;
  numbers.insert(numbers.end(), {ledger.volume_in, ledger.deposited, ledger.outside,
                                 static_cast<double>(own.particles.size())});
  communicator_.sum(numbers);
  ledger = {numbers[cells], numbers[cells + 1], numbers[cells + 2], 0};
  const double balls = numbers[cells + 3];
  numbers.resize(cells);
  if (communicator_.rank() == 0) require_balls(balls, own.step);
}

/// Whether the cells are known at a time, s: those that move may have a table of a part of the run alone.
bool LiveAverages::has_cells_at(double time) {
  try {
    setup_.deposition->begin_record(time);
    return true;
  } catch (const std::out_of_range&) {
    return false;
  }
}

void LiveAverages::count(const ParticleRecord& own) {
  std::vector<double> balls{static_cast<double>(own.particles.size())};
  communicator_.sum(balls);
  if (communicator_.rank() == 0) require_balls(balls[0], own.step);
}

void LiveAverages::add(const ParticleRecord& own) {
  assert(own.step == last_ + run_.interval);
  last_ = own.step;
  const double time = static_cast<double>(own.step) * run_.settings.timestep;
  const bool held = std::any_of(series_.begin(), series_.end(),
                                [&](const Series& series) { return series.windows.hold(own.step); });
  // The first one is compared with the cells
  if (!held && (own.step != run_.begin || !has_cells_at(time))) {
    count(own);
    return;
  }
  sum_over_ranks(own, time);
  if (communicator_.rank() != 0) return;
  if (setup_.walls) sums_.cell_volumes = setup_.walls->inside_volumes(time);
  if (own.step == run_.begin) {
    const std::string found = misfit(setup_, sums_, "the averages of the run", request_.largest_outside);
    if (!found.empty()) throw std::invalid_argument(found);
  }
  if (setup_.diffusion) setup_.diffusion->apply(sums_.values, RecordSums::columns);
  for (Series& series : series_) {
    if (!series.windows.hold(own.step)) continue;
    WindowRecorder& recorder = *series.recorder;
    if (series.windows.window_of(own.step) > recorder.finished())
      recorder.close(series.windows.time_of(recorder.finished()));
    recorder.open().add(sums_);
  }
}

void LiveAverages::checkpoint() {
  if (communicator_.rank() != 0) return;
  Checkpoint state{id_, static_cast<std::size_t>(last_), {}, {}};
  for (Series& series : series_) {
    series.recorder->sync();
    state.rows.push_back(series.recorder->finished());
    state.open.push_back(series.recorder->open().packed());
  }
  write_checkpoint(files_.checkpoint(last_), state);
}

std::vector<WindowPlan> plan_live(const AverageRequest& request, const LiveRun& run, long long end) {
  std::vector<long long> steps;
  for (long long step = run.begin; step <= end; step += run.interval) steps.push_back(step);
  std::vector<WindowPlan> plans;
  for (const WindowsRequest& windows : request.windows)
    plans.push_back(plan_windows(
        steps, {run.settings.timestep, run.interval, windows.length, request.start, request.end}));
  return plans;
}

double journal_bytes(const CellSetup& setup, const std::vector<WindowPlan>& plans) {
  constexpr double numbers_per_cell = 13;
  double windows = 0;
  for (const WindowPlan& plan : plans) windows += static_cast<double>(plan.windows.size());
  return numbers_per_cell * sizeof(double) * windows * static_cast<double>(cell_count(setup.grid));
}

std::vector<SolidsSummary> finish_live(const AverageRequest& request, const LiveRun& run,
                                       const LiveFiles& files, const std::string& id, const LiveEnd& end,
                                       const std::function<void(const std::string&)>& note) {
  const std::vector<FileLock> locks = lock_outputs(request);
  const CellSetup setup = set_up(request, run.settings, ignore);
  const std::vector<WindowPlan> plans = plans_of_files(request, run, end);
  const Checkpoint state = state_at(files, id, end.step);
  std::vector<SolidsSummary> summaries;
  for (std::size_t s = 0; s < request.windows.size(); ++s) {
    const WindowPlan& plan = plans[s];
    for (const std::string& sentence : plan.notes) note(sentence);
    const EndlessWindows windows(request, request.windows[s], run.settings.timestep, run.begin);
    const WindowRecorder recorder = recorder_at(files, s, setup, id, &state);
    const auto window = [&](std::size_t w) {
      const WindowSpan& span = plan.windows[w];
      const TimeWindow time = time_of(span, run.settings.timestep);
      const std::size_t row = windows.window_of(span.begin);
      WindowAverage average = row < recorder.finished() ? recorder.read(row) : recorder.average_open(time);
      const long long records = average.time.records;
      if (records != static_cast<long long>(span.records))
        throw SolidsFileError(files.journal(s).string() + ": the window from " + std::to_string(time.begin) +
                              " s has " + std::to_string(records) + " records, expected " +
                              std::to_string(span.records));
      average.time = time;
      average.time.records = records;
      return average;
    };
    summaries.push_back(write_solids(request.windows[s].output, setup.grid,
                                     header_of(request, s, run, setup, end, plan), plan.windows.size(),
                                     window));
  }
  if (end.box) {
    const std::string sentence =
        missing_period(request, setup.grid, *end.box, largest_share(summaries.front(), &Ledger::outside));
    if (!sentence.empty()) note(sentence);
  }
  return summaries;
}

bool are_finished(const AverageRequest& request, const LiveRun& run, const LiveEnd& end) {
  if (!end.metadata || !are_written(request, *end.metadata)) return false;
  // Their fingerprint covers the rest
  if (!request.mill_averages.empty()) return true;
  const CellSetup setup = set_up(request, run.settings, ignore);
  const std::vector<WindowPlan> plans = plans_of_files(request, run, end);
  for (std::size_t s = 0; s < plans.size(); ++s) {
    std::vector<TimeWindow> windows;
    for (const WindowSpan& span : plans[s].windows) {
      windows.push_back(time_of(span, run.settings.timestep));
      windows.back().records = static_cast<long long>(span.records);
    }
    const SolidsHeader header = header_of(request, s, run, setup, end, plans[s]);
    if (!holds_averages(request.windows[s].output, header, setup.grid, windows)) return false;
  }
  return true;
}

}  // namespace millfoam::averaging
