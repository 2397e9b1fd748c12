// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "averaging/dumps/dump_header.hpp"
#include "averaging/dumps/run_metadata.hpp"
#include "averaging/run/average_request.hpp"
#include "averaging/run/cell_setup.hpp"
#include "averaging/run/communicator.hpp"
#include "averaging/run/solids_summary.hpp"
#include "averaging/run/window_recorder.hpp"
#include "averaging/statistics/time_windows.hpp"
#include "averaging/values/particle.hpp"

namespace millfoam::averaging {

/// The DEM run whose balls are averaged while it runs.
struct LiveRun {
  RunSettings settings;    ///< the Sauter diameter is that of all balls
  long long begin = 0;     ///< time-step of the first record
  long long interval = 0;  ///< time-steps between two records
  long long balls = 0;     ///< in every record
};

/// The files of averages of a DEM run under way. They stay when the run is complete, so that it can be made
/// longer.
struct LiveFiles {
  std::filesystem::path base;  ///< how all names begin, with the folder: dem/averages_1
  /// Finished windows of series `number` of the request, from 0.
  std::filesystem::path journal(std::size_t number) const;
  /// The state after the record of a time-step.
  std::filesystem::path checkpoint(long long step) const;
};

/// Whether the state after the record of that time-step is there, whole and of the request `id`.
bool has_checkpoint(const LiveFiles& files, const std::string& id, long long step);

/// Averages of the balls of a DEM run, made while it runs: the same windows as those of `average_run`. Every
/// rank of the run has one of these and adds its own balls; rank 0 gets the sums of each record and keeps the
/// windows. So no rank holds all balls. Sums over ranks round differently with the number of ranks and the
/// order of the balls, by about 1e-15 of the values.
///
/// A window is finished when the first record after it arrives. Windows are not bounded by the run's end, so
/// that a run can be made longer; `finish_live` leaves out what the request does not ask for.
class LiveAverages {
 public:
  /// For a run from its begin (`resumed` is nothing), or after the record of the step from which it resumes.
  /// @param request  its dumps, time-step, angular velocity, threads and outputs are not used
  /// @param run  whose balls are averaged
  /// @param files  in which windows and states are kept
  /// @param id  differs between requests that could give different results
  /// @param resumed  the step from which it resumes, if it does
  /// @param communicator  of all ranks; must outlive this object
  /// Throws as `set_up`, SolidsFileError where there is no such state, WindowError.
  LiveAverages(const AverageRequest& request, const LiveRun& run, LiveFiles files, std::string id,
               std::optional<long long> resumed, Communicator& communicator);
  ~LiveAverages();
  LiveAverages(const LiveAverages&) = delete;
  LiveAverages& operator=(const LiveAverages&) = delete;

  /// Adds a record. All ranks must call it, in order of time. Of records in no window the balls are counted.
  /// @param own  the balls of this rank; z may lie outside the period
  /// Throws on rank 0 std::runtime_error when balls are missing, std::invalid_argument when the grid of the
  /// run's first record cannot be meant for the balls, SolidsFileError when the disk is full, and as
  /// `average`; on each rank as `Deposition`.
  void add(const ParticleRecord& own);

  /// Writes the state after the last record; rank 0 waits until it is on the disk. Throws SolidsFileError.
  void checkpoint();

 private:
  struct Series;

  void sum_over_ranks(const ParticleRecord& own, double time);
  bool has_cells_at(double time);
  void count(const ParticleRecord& own);
  void require_balls(double found, long long step) const;

  AverageRequest request_;
  LiveRun run_;
  LiveFiles files_;
  std::string id_;
  Communicator& communicator_;
  CellSetup setup_;
  RecordSums sums_;
  std::vector<Series> series_;
  long long last_ = 0;  ///< time-step of the last record
};

/// What `finish_live` writes.
struct LiveEnd {
  long long step = 0;                         ///< of the run's last record
  std::optional<RunMetadata> metadata;        ///< of the run, for the files' header
  std::optional<double> steady_from;          ///< DEM time, s: windows that begin before are left out
  std::string program;                        ///< that writes the files, with its version
  std::optional<DumpBox> box = std::nullopt;  ///< of the run, for `missing_period`; nothing: not known
};

/// Writes the solids files of a run that has come to its end, as `average_run` does, and returns their
/// summaries. What LiveAverages keeps of the run stays as it is. `note` gets sentences on windows that are
/// not full or left out, and the warning of `missing_period`. Throws WindowError when no window is left, and
/// SolidsFileError.
std::vector<SolidsSummary> finish_live(const AverageRequest& request, const LiveRun& run,
                                       const LiveFiles& files, const std::string& id, const LiveEnd& end,
                                       const std::function<void(const std::string&)>& note);

/// Whether the solids files that `finish_live` would write are there (`are_written`) and hold these averages:
/// the mill's by their fingerprint, others by their cells, method and windows. Walls that others than the
/// mill's averages take are compared by their width alone. Throws as `set_up`, and WindowError.
bool are_finished(const AverageRequest& request, const LiveRun& run, const LiveEnd& end);

/// The windows of each series that a run to the time-step `end` gives. Throws WindowError.
std::vector<WindowPlan> plan_live(const AverageRequest& request, const LiveRun& run, long long end);

/// Bytes of the journals of so many windows of these cells.
double journal_bytes(const CellSetup& setup, const std::vector<WindowPlan>& plans);

}  // namespace millfoam::averaging
