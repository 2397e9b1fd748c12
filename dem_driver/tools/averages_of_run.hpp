// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "averaging/tools/live_options.hpp"
#include "dem_driver/averages_order.hpp"
#include "dem_driver/case_folder.hpp"
#include "dem_driver/dem_plan.hpp"
#include "meshing/mill/mill_reader.hpp"

namespace millfoam::dem_driver {

/// The averages that millDem has made while the mill turns: those of `averages.live`, and those of --average.
class AveragesOfRun {
 public:
  /// Checks them as millAverage does, also the cells' period, and notes them in the plan. The plan must have
  /// its begin. Errors of one name its options (`naming_options`).
  /// @param walls  wall_fingerprints of the run
  /// @param options  a text of millAverage's options for each
  /// @param out  gets sentences about them
  /// Throws meshing::KeyError where nothing could be averaged at all (`dem.dumps: no`), and
  /// std::runtime_error or std::invalid_argument.
  AveragesOfRun(const meshing::MillDescription& description, const CaseFolder& folder,
                const std::map<std::string, std::string>& walls, const std::vector<std::string>& options,
                DemPlan& plan, std::ostream& out);

  /// Writes the file for millLiggghts, or removes that of an earlier run.
  void write_order() const;

  /// Writes the solids files of the complete run and prints their ledgers. The run's file and results must be
  /// there.
  /// @param keep  whole files of this run that hold these averages are kept; their ledgers count, too
  /// Throws std::runtime_error when the ledger of one is beyond its tolerance, and as finish_live.
  void finish(bool keep, std::ostream& out) const;

 private:
  /// Throws std::runtime_error where the averages take the case's walls, and these are not the run's.
  void require_walls() const;
  /// Checks one, and notes it in the plan and for millLiggghts. Throws as the constructor.
  void order(const averaging::AverageRequest& request, DemPlan& plan, std::ostream& out);
  bool finish_one(std::size_t number, bool keep, std::ostream& out) const;

  const meshing::Mill& mill_;
  const CaseFolder& folder_;
  std::map<std::string, std::string> walls_;  ///< fingerprints
  const DemPlan& plan_;
  AveragesOrder order_;
  std::vector<std::string> texts_;  ///< of the options of each; empty: the mill's averages
  std::vector<averaging::LiveRequest> requests_;
};

}  // namespace millfoam::dem_driver
