// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/average_run.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <functional>
#include <utility>

#include "averaging/files/xdmf.hpp"
#include "averaging/run/cell_setup.hpp"
#include "averaging/run/checkpoint.hpp"
#include "averaging/run/dump_checks.hpp"
#include "averaging/run/program.hpp"
#include "averaging/run/record_worker.hpp"
#include "averaging/run/run_plan.hpp"
#include "averaging/run/run_signature.hpp"
#include "averaging/run/solids_output.hpp"
#include "averaging/run/window_series.hpp"
#include "averaging/statistics/redistribution.hpp"

namespace millfoam::averaging {

namespace {

/// Rank 0's part: the blocks go into the windows, the windows into the files.
class Collector {
 public:
  Collector(const AverageRequest& request, const AverageProgress& progress, const RunPlan& plan,
            const CellSetup& setup)
      : request_(request),
        progress_(progress),
        plan_(plan),
        setup_(setup),
        volumes_(plan.dumps, progress.note),
        resume_(request.windows.front().output.string() + ".resume"),
        signature_(signature(request, plan.settings, plan.series, plan.dumps)) {
    const std::size_t cells = cell_count(setup.grid);
    const std::size_t id = std::hash<std::string>()(signature_);
    const std::optional<Checkpoint> earlier = usable_checkpoint(id, cells);
    // New journals are started only when no note of an earlier run can refer to them.
    if (!earlier) std::filesystem::remove(resume_);
    for (std::size_t s = 0; s < plan.series.size(); ++s) {
      series_.emplace_back(request.windows[s].output, plan.series[s], plan.settings.timestep, setup.limits,
                           cells, id, earlier ? earlier->rows[s] : 0);
      if (earlier) series_.back().recorder().open().unpack(earlier->open[s]);
    }
    if (earlier) next_block_ = earlier->reached;
    for (std::size_t b = 0; b < plan.blocks.size(); ++b) {
      const std::size_t records = plan.blocks[b].last - plan.blocks[b].first;
      total_ += records;
      if (b < next_block_) done_ += records;
    }
    if (earlier) {
      progress.note("resuming an unfinished run: " + std::to_string(done_) + " of " + std::to_string(total_) +
                    " dumps are averaged already");
    }
  }

  std::size_t next_block() const { return next_block_; }

  void add(const BlockResult& result) {
    const RecordBlock& block = plan_.blocks[next_block_++];
    for (std::size_t r = block.first; r < block.last; ++r) volumes_.add(r, result.volumes[r - block.first]);
    for (WindowSeries& series : series_) series.add(block, result.moments);
    done_ += block.last - block.first;
    const auto now = std::chrono::steady_clock::now();
    if (std::chrono::duration<double>(now - last_checkpoint_).count() >= request_.checkpoint_interval) {
      save();
      last_checkpoint_ = now;
    }
    progress_.records(done_, total_);
  }

  /// Whether the same run would go on from what is kept for it.
  bool resumes() const { return std::filesystem::exists(resume_); }

  /// Removes what is kept for a run that resumes.
  void forget() const {
    std::error_code no_matter;
    std::filesystem::remove(resume_, no_matter);
    for (const WindowSeries& series : series_) series.forget();
  }

  std::vector<SolidsSummary> finish() {
    save();
    std::vector<SolidsSummary> summaries;
    for (std::size_t s = 0; s < series_.size(); ++s) {
      const WindowsRequest& windows = request_.windows[s];
      const double time0 =
          static_cast<double>(plan_.series[s].windows.front().begin) * plan_.settings.timestep;
      const SolidsHeader header =
          solids_header(request_, windows, plan_.settings, setup_, plan_.metadata, time0, program());
      const WindowRecorder& recorder = series_[s].recorder();
      const auto window = [&](std::size_t row) {
        WindowAverage average = recorder.read(row);
        average.time.expected = static_cast<long long>(plan_.series[s].windows[row].expected);
        return average;
      };
      summaries.push_back(write_solids(windows.output, setup_.grid, header, recorder.finished(), window));
    }
    if (plan_.box) {
      const std::string sentence = missing_period(request_, setup_.grid, *plan_.box,
                                                  largest_share(summaries.front(), &Ledger::outside));
      if (!sentence.empty()) progress_.note(sentence);
    }
    // First the note, so that a kill in between leaves none without its journals.
    forget();
    return summaries;
  }

 private:
  /// How far an earlier run of the same dumps and settings has come, if its windows are all there.
  std::optional<Checkpoint> usable_checkpoint(std::size_t id, std::size_t cells) const {
    std::optional<Checkpoint> earlier = read_checkpoint(resume_);
    if (!earlier) return std::nullopt;
    if (earlier->signature != signature_) {
      progress_.note("an unfinished run had other dumps, settings or another version: starting again");
      return std::nullopt;
    }
    for (std::size_t s = 0; s < earlier->rows.size(); ++s) {
      const std::filesystem::path journal = WindowSeries::journal_path(request_.windows[s].output);
      if (WindowJournal::holds(journal, id, cells, !setup_.limits.whole_volumes.empty(), earlier->rows[s]))
        continue;
      progress_.note("the finished windows in " + journal.string() +
                     " are not those of the unfinished run: starting again");
      return std::nullopt;
    }
    return earlier;
  }

  void save() {
    Checkpoint checkpoint{signature_, next_block_, {}, {}};
    for (WindowSeries& series : series_) {
      WindowRecorder& recorder = series.recorder();
      recorder.sync();
      checkpoint.rows.push_back(recorder.finished());
      checkpoint.open.push_back(recorder.open().packed());
    }
    write_checkpoint(resume_, checkpoint);
  }

  const AverageRequest& request_;
  const AverageProgress& progress_;
  const RunPlan& plan_;
  const CellSetup& setup_;
  VolumeCheck volumes_;
  std::filesystem::path resume_;
  std::string signature_;
  std::vector<WindowSeries> series_;
  std::size_t next_block_ = 0;
  std::size_t done_ = 0;
  std::size_t total_ = 0;
  std::chrono::steady_clock::time_point last_checkpoint_ = std::chrono::steady_clock::now();
};

/// Shares the blocks between the ranks and their threads, and hands the results to `collect` in order.
class BlockLoop {
 public:
  BlockLoop(const RunPlan& plan, const CellSetup& setup, Communicator& communicator, int threads)
      : plan_(plan),
        setup_(setup),
        communicator_(communicator),
        threads_(threads > 0 ? threads : omp_get_max_threads()),
        run_length_(static_cast<std::size_t>(communicator.broadcast(threads_))) {}

  /// @param collect  called on rank 0 with the result of each block from `first` on, in order
  /// Throws what reading, averaging or `collect` threw first.
  void run(std::size_t first, const std::function<void(const BlockResult&)>& collect) {
    const std::size_t blocks = plan_.blocks.size();
#pragma omp parallel num_threads(threads_)
    {
      std::unique_ptr<RecordWorker> worker;
      guarded([&] { worker = std::make_unique<RecordWorker>(setup_, plan_.dumps, plan_.settings.timestep); });
#pragma omp for ordered schedule(dynamic, 1)
      for (std::size_t b = first; b < blocks; ++b) {
        const BlockResult* result = nullptr;
        if (owner(b) == communicator_.rank()) guarded([&] { result = &worker->process(plan_.blocks[b]); });
#pragma omp ordered
        guarded([&] { deliver(b, result, collect); });
      }
    }
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  /// Ranks take turns with as many blocks as they have threads.
  int owner(std::size_t block) const {
    return static_cast<int>(block / run_length_ % static_cast<std::size_t>(communicator_.size()));
  }

  /// Ranks send the numbers of the moments, and the volumes behind them.
  void deliver(std::size_t block, const BlockResult* result,
               const std::function<void(const BlockResult&)>& collect) {
    if (communicator_.rank() == 0 && result != nullptr) {
      collect(*result);
    } else if (communicator_.rank() == 0) {
      const std::size_t cells = cell_count(setup_.grid), packed = WindowMoments::packed_size(cells);
      std::vector<double> numbers(packed + plan_.blocks[block].last - plan_.blocks[block].first);
      communicator_.receive(owner(block), numbers);
      const auto volumes = numbers.begin() + static_cast<std::ptrdiff_t>(packed);
      BlockResult received{WindowMoments(cells), {volumes, numbers.end()}};
      numbers.resize(packed);
      received.moments.unpack(numbers);
      collect(received);
    } else if (result != nullptr) {
      std::vector<double> numbers = result->moments.packed();
      numbers.insert(numbers.end(), result->volumes.begin(), result->volumes.end());
      communicator_.send(numbers);
    }
  }

  /// No exception may leave a parallel region: the first is kept, and the rest of the work is skipped.
  template <typename Action>
  void guarded(Action&& action) {
    bool failed = false;
#pragma omp atomic read
    failed = failed_;
    if (failed) return;
    try {
      action();
    } catch (...) {
#pragma omp critical(keep_failure)
      {
        if (!failure_) failure_ = std::current_exception();
      }
#pragma omp atomic write
      failed_ = true;
    }
  }

  const RunPlan& plan_;
  const CellSetup& setup_;
  Communicator& communicator_;
  int threads_;
  std::size_t run_length_;
  bool failed_ = false;
  std::exception_ptr failure_;
};

}  // namespace

std::vector<SolidsSummary> average_run(const AverageRequest& request, const AverageProgress& progress,
                                       Communicator& communicator) {
  // A name that cannot be used is refused before the work, not after it.
  for (const WindowsRequest& windows : request.windows) xdmf_path(windows.output);
  const std::vector<FileLock> locks =
      communicator.rank() == 0 ? lock_outputs(request) : std::vector<FileLock>{};
  const RunPlan plan = plan_run(request, progress);
  const CellSetup setup = set_up(request, plan.settings, progress.note);

  std::unique_ptr<Collector> collector;
  if (communicator.rank() == 0) {
    require_cells(plan, setup);
    require_fitting_grid(request, plan, setup);
    collector = std::make_unique<Collector>(request, progress, plan, setup);
  }
  const long long first =
      communicator.broadcast(collector ? static_cast<long long>(collector->next_block()) : 0);
  BlockLoop loop(plan, setup, communicator, request.threads);
  try {
    loop.run(static_cast<std::size_t>(first), [&](const BlockResult& result) { collector->add(result); });
  } catch (const NoRoomError&) {
    // The same run would stop there again
    if (collector) collector->forget();
    throw;
  } catch (...) {
    if (collector && !collector->resumes()) collector->forget();
    throw;
  }
  return collector ? collector->finish() : std::vector<SolidsSummary>{};
}

}  // namespace millfoam::averaging
