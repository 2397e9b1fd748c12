// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "openfoam_module/record/stage_clock.hpp"
#include "openfoam_module/record/step_table.hpp"

/// What a flow leaves behind to be read by programs: its folder `postProcessing/flow/START` with
/// steps.csv, a row per time-step, and flow.json, the summary. START is the name of the time at which the run
/// began or resumed. Layout: FORMATS.md.
namespace millfoam::record {

/// Where the balls of a flow came from and what was done beyond the recorded time.
struct Solids {
  std::string source;        ///< in words
  std::string file;          ///< solids.h5 as a path; empty: uniform blocks, or balls of `program`
  double begin = 0;          ///< recorded DEM time, s
  double end = 0;            ///< s
  long long windows = 0;     ///< number of windows
  bool whole_run = false;    ///< one window, which holds all the time
  std::string out_of_range;  ///< error, hold or repeat
  std::string in_time;       ///< window or smooth
  std::optional<double> angular_velocity;  ///< of the mill in the dry run, rad/s
  std::string program;  ///< that wrote the file, or that moves the balls at the same time; empty: none known
  std::string mill_charge;    ///< fingerprint of the charge of the file's mill; empty: not known
  std::string mill_averages;  ///< of that mill and its averages; empty: not known
};

/// The drag that the balls give.
struct Drag {
  std::string law;              ///< name in the table of openfoam_module/drag
  std::string reference;        ///< of the law: author and year
  double multiplier = 1;        ///< on the law's drag
  std::string viscosity;        ///< that the drag feels: plastic or pore
  bool polydispersity = false;  ///< whether it has the factor for a mixture of sizes
  std::string mixed;            ///< drag of cells with slurry and air: weights or permeability
  double solidity_min = 0,      ///< smallest solidity of the law's range
      solidity_max = 1;         ///< largest solidity of the law's range
  double reynolds_min = 0,      ///< smallest particle Reynolds number of the law's range
      reynolds_max = std::numeric_limits<double>::infinity();  ///< largest one
};

/// Bounds of the time-step that controlDict sets.
struct StepLimits {
  double courant = 0;             ///< maxCo, largest Courant number of the flow
  double surface_courant = 0;     ///< maxAlphaCo, the same of cells that the slurry's surface cuts
  double air_courant = 0;         ///< maxAirCo, the same of cells with air alone
  double voidage_change = 0;      ///< maxVoidageChange, largest share by which a cell's voidage may change
  std::optional<double> delta_t;  ///< maxDeltaT, s; nothing: no bound
};

/// What is known of a flow from its start on.
struct FlowSetup {
  std::string solver;                ///< name of the program
  std::string openfoam_version;      ///< 1912
  std::string openfoam_patch;        ///< of that version; empty: none
  std::string openfoam_build;        ///< of a source tree; empty: a package
  int ranks = 1;                     ///< processes of the run
  double begin = 0;                  ///< flow time at which this run begins or resumes, s
  std::optional<double> asked_end;   ///< endTime, s
  double angular_velocity = 0;       ///< of the mesh about z, right-handed, rad/s; 0: at rest
  std::string mill_charge;           ///< fingerprint in constant/millProperties; empty: not known
  std::string mill_averages;         ///< of the mill and its averages
  std::string mill_flow;             ///< of all keys of the mill that a flow depends on
  std::optional<StepLimits> limits;  ///< none: the time-step is fixed
  std::optional<Solids> solids;      ///< none: a flow without balls
  std::optional<Drag> drag;          ///< none: a flow without balls
};

/// Whether the last run that a case's record has came to its end at a flow time. False without a record, or
/// with one that cannot be read.
/// @param case_folder  of the OpenFOAM case
/// @param time  s; compared to a millionth, because names of times are rounded
bool is_complete(const std::filesystem::path& case_folder, double time);

/// Keeps the record of a running flow.
class FlowRecord {
 public:
  /// Begins a new record of a run in `case_folder`/postProcessing/flow/`start` and removes the records
  /// of runs that began later: their steps are computed again.
  /// @param case_folder  of the OpenFOAM case
  /// @param start  name of the time at which the run begins or resumes
  /// @param setup  is copied
  ///
  /// Throws std::runtime_error when a file cannot be written.
  FlowRecord(const std::filesystem::path& case_folder, const std::string& start, const FlowSetup& setup);

  /// Appends a step to steps.csv; `wall` is taken here. Throws std::runtime_error when it cannot be written.
  void add(StepRow row);

  /// What the stages of the steps have taken so far, for flow.json.
  void set_stages(StageClock::Times stages);

  /// The memory of all ranks so far, bytes, for flow.json.
  void set_memory(double bytes);

  /// Writes flow.json by all steps so far. Throws std::runtime_error when it cannot be written.
  /// @param complete  whether the run has come to its end
  void write(bool complete) const;

 private:
  /// A quantity of the steps: largest size, with its sign, and mean over the time in which it was known.
  struct Course {
    double largest = 0;
    double integral = 0;
    double time = 0;
    void add(const std::optional<double>& value, double duration);
    nlohmann::ordered_json largest_value() const;
    nlohmann::ordered_json mean_value() const;
  };

  std::string summary(bool complete) const;
  void add_steps(nlohmann::ordered_json& result) const;
  void add_balls(nlohmann::ordered_json& result) const;
  double end_time() const;
  double wall_time() const;

  std::filesystem::path folder_;
  FlowSetup setup_;
  StepTable table_;
  StageClock::Times stages_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  double memory_ = 0;
  long long steps_ = 0;
  StepRow first_;
  StepRow last_;
  double alpha_min_ = 0;
  double alpha_above_ = 0;
  double pressure_iterations_ = 0;
  Course courant_, surface_courant_, air_courant_, voidage_change_, volume_correction_;
  Course beyond_law_, solidity_below_, solidity_above_, reynolds_below_, reynolds_above_;
  double force_mean_ = 0;  ///< sums over the written times
  double force_95_ = 0;
  long long forces_ = 0;
  double continuity_residual_ = 0;  ///< sums over the written times
  double continuity_speed_ = 0;
  double slip_ = 0;
  long long continuities_ = 0;
};

}  // namespace millfoam::record
