// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "dem_driver/dem_plan.hpp"

namespace millfoam::dem_driver {

/// A dry run that cannot be used; the message says what went wrong.
class RunError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Follows LIGGGHTS' output line by line: how far it is, and whether every ball is still there.
class LiggghtsLog {
 public:
  /// `plan` is the one that the deck was written from; it must outlive this object. A run that is `resumed`
  /// has all its balls from the start.
  LiggghtsLog(const DemPlan& plan, bool resumed);

  /// Takes the next line. Throws RunError when an insertion brought another number of balls than asked, when
  /// balls were lost, or when the kinetic energy is not finite. An ERROR of LIGGGHTS is kept (`error()`),
  /// because lines that explain it may follow.
  void read(const std::string& line);

  /// Steps since the first insertion, those of the parts before a resumed one too; of the last line that
  /// counts them.
  long steps_done() const { return steps_done_; }
  long balls() const { return balls_; }                ///< of the last line that counts them
  bool turning() const { return turning_; }            ///< DEM time 0 is reached
  bool finished() const { return finished_; }          ///< the deck came to its end
  const std::string& error() const { return error_; }  ///< first line that begins with ERROR, or empty
  std::optional<long> restart_step() const { return restart_step_; }  ///< of the last complete restart file
  /// Step of the turning mill up to which all dumps are written; nothing before the first.
  std::optional<long> dumped_until() const { return dumped_until_; }
  const std::string& version() const { return version_; }  ///< of LIGGGHTS, by its first line
  bool begun() const { return begun_; }  ///< LIGGGHTS itself has printed, not only what was to start it
  std::string first_lines() const;       ///< for a message, each on its own line, without rules
  std::string last_lines() const;        ///< for a message, each on its own line

 private:
  void read_thermo(const std::vector<std::string>& words);
  void read_insertion(const std::string& line);
  void check_balls(long step, long balls) const;

  const DemPlan& plan_;
  std::vector<std::string> head_;
  std::deque<std::string> tail_;
  std::vector<std::string> columns_;  ///< of the thermo table that is being read, else empty
  std::string error_;
  long expected_balls_ = 0;
  long balls_ = 0;
  long last_step_ = 0;
  long steps_done_ = 0;
  bool begun_ = false;
  bool turning_ = false;
  bool finished_ = false;
  std::optional<long> restart_step_;
  std::optional<long> dumped_until_;
  std::string version_;
};

}  // namespace millfoam::dem_driver
