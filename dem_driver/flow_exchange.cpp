// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/flow_exchange.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "averaging/files/slurry_file.hpp"
#include "averaging/run/average_request.hpp"
#include "averaging/statistics/record_sums.hpp"
#include "averaging/statistics/window_average.hpp"
#include "meshing/files/text_numbers.hpp"
#include "millfoam_version.hpp"

namespace millfoam::dem_driver {

namespace {

using namespace averaging;

CellSetup cells_of(const ExchangeOrder& order, double timestep) {
  AverageRequest request{order.grid};
  request.method = order.exact ? DepositionMethod::exact : DepositionMethod::sample;
  request.template_points = order.template_points;
  request.walls = order.walls;
  RunSettings settings;
  settings.timestep = timestep;
  settings.angular_velocity = order.angular_velocity;
  return set_up(request, settings, [](const std::string&) {});
}

/// Sums and ledger as one list, for the ranks.
std::vector<double> packed(const RecordSums& sums) {
  std::vector<double> numbers = sums.values;
  const Ledger& ledger = sums.ledger;
  numbers.insert(numbers.end(), {ledger.volume_in, ledger.deposited, ledger.outside, ledger.clipped});
  return numbers;
}

void unpack(std::vector<double> numbers, RecordSums& sums) {
  const auto ledger = numbers.end() - 4;
  sums.ledger = {ledger[0], ledger[1], ledger[2], ledger[3]};
  numbers.resize(numbers.size() - 4);
  sums.values = std::move(numbers);
}

}  // namespace

FlowExchange::FlowExchange(const FluidOrder& order, long step, RankGroup& ranks)
    : order_(order.exchange.value()),
      shapes_(order.fluid.shapes),
      timestep_(order.timestep),
      record_steps_(order.record_steps),
      folder_(order.fluid.file.string()),
      ranks_(ranks),
      cells_(cells_of(order_, order.timestep)),
      next_(step) {
  if (ranks_.rank() == 0) pipes_ = std::make_unique<ExchangePipes>(order.fluid.file, ExchangeSide::balls);
  greet(step);
}

FlowExchange::~FlowExchange() = default;

double FlowExchange::flow_time(long step) const {
  return static_cast<double>(step - order_.begin) * timestep_;
}

void FlowExchange::greet(long step) {
  std::vector<double> numbers;
  if (pipes_) {
    const FlowOffer flow = unpack_flow_offer(pipes_->receive(FlowOffer::kind));
    std::string refusal;
    if (flow.program != version())
      refusal = "the flow is of version " + flow.program + ", the run of the balls of " + version() +
                ", expected the same: build all programs again";
    else if (!(std::abs(flow.time - flow_time(step)) <= timestep_))
      refusal = "the flow begins at its time " + exact(flow.time) + " s, the balls at " +
                exact(flow_time(step)) +
                " s: remove the flow's later times, or the balls' later restart files";
    if (!refusal.empty()) {
      pipes_->refuse(refusal);
      throw ExchangeError(folder_ + ": " + refusal);
    }
    pipes_->send(pack(BallsOffer{order_.grid, static_cast<double>(order_.begin) * timestep_,
                                 order_.angular_velocity, version(), order_.mill}));
    numbers = pack(flow).numbers;
  }
  ranks_.broadcast(numbers);
  const FlowOffer flow = unpack_flow_offer({FlowOffer::kind, {}, numbers});
  polydispersity_ = flow.polydispersity;
  field_.emplace(order_.grid);
}

SolidsAt FlowExchange::average(long step, const std::vector<BallInFluid>& balls) {
  const double time = static_cast<double>(step) * timestep_;
  ParticleRecord record;
  record.step = step;
  record.particles.reserve(balls.size());
  for (const BallInFluid& ball : balls)
    record.particles.push_back({ball.id, ball.position, ball.velocity, ball.diameter / 2});
  RecordSums sums;
  sum_record(*cells_.deposition, record, time, sums);
  std::vector<double> numbers = packed(sums);
  ranks_.sum(numbers);
  SolidsAt solids;
  solids.time = flow_time(step);
  if (!pipes_) return solids;
  unpack(std::move(numbers), sums);
  if (cells_.walls) sums.cell_volumes = cells_.walls->inside_volumes(time);
  WindowMoments moments(cell_count(cells_.grid));
  moments.add(sums);
  WindowAverage mean = averaging::average(moments, cells_.limits);
  solids.deposited = mean.ledger.deposited;
  solids.fields = std::move(mean.mean);
  return solids;
}

void FlowExchange::check(const ForcesUntil& forces) const {
  const BallFields& fields = forces.fields;
  const std::string source = folder_ + ": the flow's forces";
  const std::array<std::pair<const std::vector<double>*, std::size_t>, 6> all{{{&fields.inside, 1},
                                                                               {&fields.pressure_force, 3},
                                                                               {&fields.exchange, 1},
                                                                               {&fields.drag_force, 3},
                                                                               {&fields.solidity, 1},
                                                                               {&fields.diameter, 1}}};
  for (const auto& [values, width] : all)
    if (const auto voxel = not_finite(*values, width, fields.inside))
      throw SlurryFileError(source + " are not finite in " + voxel_in_words(order_.grid, *voxel) +
                            ": the flow has diverged");
  if (!std::isfinite(forces.torque))
    throw SlurryFileError(folder_ + ": the flow's torque on the balls is not finite: the flow has diverged");
  const DragLimits limits{polydispersity_, order_.smallest_ball,     order_.ball_density,
                          timestep_,       order_.rayleigh_fraction, shapes_.largest_factor()};
  require_slow_drag(fields, order_.grid, limits, source);
}

std::vector<double> FlowExchange::ask(const SolidsAt& solids, long step) {
  pipes_->send(pack(solids));
  ExchangeMessage answer = pipes_->receive();
  if (answer.kind == exchange_end) {
    if (step + record_steps_ < order_.end)
      throw ExchangeError(folder_ + ": the flow has ended at its time " + exact(flow_time(step)) +
                          " s, expected " + exact(flow_time(order_.end)) + " s; its log says why");
    return {};
  }
  if (answer.kind != ForcesUntil::kind)
    throw ExchangeError(folder_ + ": the flow sends '" + answer.kind + "', expected '" + ForcesUntil::kind +
                        "': both programs must be of the same version");
  check(unpack_forces(answer, order_.grid.size()));
  return std::move(answer.numbers);
}

void FlowExchange::meet(long step, const std::vector<BallInFluid>& balls) {
  // A step of the flow may be shorter than one of the balls
  while (due(step)) {
    const SolidsAt solids = average(step, balls);
    std::vector<double> numbers;
    if (pipes_) {
      try {
        numbers = ask(solids, step);
      } catch (const std::exception& error) {
        pipes_->refuse(error.what());
        throw;
      }
    }
    ranks_.broadcast(numbers);
    if (numbers.empty()) {
      next_ = std::numeric_limits<long>::max();
      return;
    }
    const ForcesUntil forces = unpack_forces({ForcesUntil::kind, {}, std::move(numbers)}, order_.grid.size());
    field_.emplace(order_.grid, forces.fields);
    balance_ = TorqueBalance(
        forces.torque, balls, [this](const BallInFluid& ball) { return without_balance(ball); },
        order_.smallest_ball, ranks_);
    next_ = order_.begin + std::lround(forces.time / timestep_);
  }
}

FluidForce FlowExchange::on(const BallInFluid& ball) const {
  FluidForce force = without_balance(ball);
  force.balance = balance_.on(ball, force);
  return force;
}

FluidForce FlowExchange::without_balance(const BallInFluid& ball) const {
  return force_on(ball, field_->over(ball.position, ball.diameter), polydispersity_, shapes_);
}

}  // namespace millfoam::dem_driver
