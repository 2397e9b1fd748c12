// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "averaging/exchange/exchange_fields.hpp"
#include "averaging/run/cell_setup.hpp"
#include "averaging/values/particle.hpp"
#include "dem_driver/fluid_check.hpp"
#include "dem_driver/fluid_forces.hpp"
#include "dem_driver/fluid_settings.hpp"
#include "dem_driver/rank_group.hpp"
#include "dem_driver/torque_balance.hpp"

namespace millfoam::dem_driver {

/// The forces of a flow that runs at the same time. Flow and balls meet at the end of each time-step of the
/// flow: the balls give their averages at the DEM step that is nearest to it, and get the forces that act
/// until the next one, with the flow's torque by a TorqueBalance. Call everything on all ranks.
class FlowExchange final : public FluidForces {
 public:
  /// Waits for the flow, and makes its acquaintance.
  /// @param order  not without an `exchange`
  /// @param step  of the turning mill at which the run begins or resumes
  /// @param ranks  of the run; must outlive this object
  /// Throws averaging::ExchangeError when the flow is of another version, begins at another time or has
  /// ended, and as averaging::set_up.
  FlowExchange(const FluidOrder& order, long step, RankGroup& ranks);
  ~FlowExchange() override;

  /// Whether balls and flow meet at this step.
  bool due(long step) const { return step >= next_; }

  /// Meets the flow.
  /// @param step   of the run
  /// @param balls  of this rank
  /// Throws averaging::ExchangeError when the flow has ended before the run's last record, and
  /// averaging::SlurryFileError for forces that are not finite, with their voxel, or too strong for the
  /// time-step. The flow is told.
  void meet(long step, const std::vector<BallInFluid>& balls);

  void set_time(double) override {}
  FluidForce on(const BallInFluid& ball) const override;

 private:
  double flow_time(long step) const;
  void greet(long step);
  FluidForce without_balance(const BallInFluid& ball) const;
  averaging::SolidsAt average(long step, const std::vector<BallInFluid>& balls);
  /// The flow's next forces, packed for all ranks; empty when it has ended.
  std::vector<double> ask(const averaging::SolidsAt& solids, long step);
  void check(const averaging::ForcesUntil& forces) const;

  const ExchangeOrder order_;
  const ShapeDrag shapes_;
  const double timestep_;
  const long record_steps_;
  const std::string folder_;
  RankGroup& ranks_;
  averaging::CellSetup cells_;
  std::unique_ptr<averaging::ExchangePipes> pipes_;  ///< of the first rank
  bool polydispersity_ = false;
  std::optional<VoxelField> field_;
  TorqueBalance balance_;
  long next_ = 0;  ///< step of the next meeting
};

}  // namespace millfoam::dem_driver
