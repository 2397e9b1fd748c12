// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/exchange/exchange_fields.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace millfoam::averaging {

namespace {

/// Numbers of a message in their order.
class Packer {
 public:
  explicit Packer(ExchangeMessage& message) : numbers_(message.numbers) {}
  void add(double value) { numbers_.push_back(value); }
  void add(const std::vector<double>& values) {
    numbers_.insert(numbers_.end(), values.begin(), values.end());
  }
  void add(const BoxGrid& grid) {
    for (std::size_t a = 0; a < 3; ++a) {
      add(grid.lower()[a]);
      add(grid.upper()[a]);
      add(grid.shape()[a]);
      add(grid.periodic()[a] ? 1 : 0);
    }
  }

 private:
  std::vector<double>& numbers_;
};

class Unpacker {
 public:
  explicit Unpacker(const ExchangeMessage& message) : message_(message) {}
  double number() {
    need(1);
    return message_.numbers[next_++];
  }
  std::vector<double> numbers(std::size_t count) {
    need(count);
    const auto first = message_.numbers.begin() + static_cast<std::ptrdiff_t>(next_);
    next_ += count;
    return {first, first + static_cast<std::ptrdiff_t>(count)};
  }
  BoxGrid grid() {
    Vector3 lower{};
    Vector3 upper{};
    VoxelIndex shape{};
    std::array<bool, 3> periodic{};
    for (std::size_t a = 0; a < 3; ++a) {
      lower[a] = number();
      upper[a] = number();
      shape[a] = static_cast<int>(number());
      periodic[a] = number() != 0;
    }
    return {lower, upper, shape, periodic};
  }
  std::size_t left() const { return message_.numbers.size() - next_; }
  void end() const {
    if (left() > 0) wrong();
  }

 private:
  void need(std::size_t count) const {
    if (count > left()) wrong();
  }
  [[noreturn]] void wrong() const {
    throw ExchangeError(
        "a message '" + message_.kind + "' of " + std::to_string(message_.numbers.size()) +
        " numbers has another length than expected: both programs must be of the same version");
  }

  const ExchangeMessage& message_;
  std::size_t next_ = 0;
};

}  // namespace

ExchangeMessage pack(const FlowOffer& offer) {
  ExchangeMessage message{FlowOffer::kind, offer.program, {}};
  Packer to(message);
  to.add(offer.polydispersity ? 1 : 0);
  to.add(offer.time);
  return message;
}

FlowOffer unpack_flow_offer(const ExchangeMessage& message) {
  Unpacker from(message);
  FlowOffer offer{from.number() != 0, 0, message.text};
  offer.time = from.number();
  from.end();
  return offer;
}

ExchangeMessage pack(const BallsOffer& offer) {
  ExchangeMessage message{BallsOffer::kind, offer.program + '\n' + offer.mill, {}};
  Packer to(message);
  to.add(offer.grid);
  to.add(offer.time0);
  to.add(offer.angular_velocity.value_or(std::numeric_limits<double>::quiet_NaN()));
  return message;
}

BallsOffer unpack_balls_offer(const ExchangeMessage& message) {
  Unpacker from(message);
  BallsOffer offer{from.grid(), from.number(), std::nullopt, {}, {}};
  const double speed = from.number();
  if (speed == speed) offer.angular_velocity = speed;
  const std::size_t end = std::min(message.text.find('\n'), message.text.size());
  offer.program = message.text.substr(0, end);
  if (end < message.text.size()) offer.mill = message.text.substr(end + 1);
  from.end();
  return offer;
}

ExchangeMessage pack(const ForcesUntil& forces) {
  ExchangeMessage message{ForcesUntil::kind, {}, {}};
  const BallFields& fields = forces.fields;
  Packer to(message);
  to.add(forces.time);
  to.add(forces.torque);
  for (const auto* field : {&fields.inside, &fields.pressure_force, &fields.exchange, &fields.drag_force,
                            &fields.solidity, &fields.diameter})
    to.add(*field);
  return message;
}

ForcesUntil unpack_forces(const ExchangeMessage& message, std::size_t voxels) {
  Unpacker from(message);
  ForcesUntil forces;
  forces.time = from.number();
  forces.torque = from.number();
  BallFields& fields = forces.fields;
  fields.inside = from.numbers(voxels);
  fields.pressure_force = from.numbers(3 * voxels);
  fields.exchange = from.numbers(voxels);
  fields.drag_force = from.numbers(3 * voxels);
  fields.solidity = from.numbers(voxels);
  fields.diameter = from.numbers(voxels);
  from.end();
  return forces;
}

ExchangeMessage pack(const SolidsAt& solids) {
  ExchangeMessage message{SolidsAt::kind, {}, {}};
  const SolidsWindow& fields = solids.fields;
  Packer to(message);
  to.add(solids.time);
  to.add(solids.deposited);
  for (const auto* field :
       {&fields.solidity, &fields.velocity, &fields.diameter, &fields.diameter43, &fields.inside_fraction})
    to.add(*field);
  return message;
}

SolidsAt unpack_solids(const ExchangeMessage& message, std::size_t voxels) {
  Unpacker from(message);
  SolidsAt solids;
  solids.time = from.number();
  solids.deposited = from.number();
  SolidsWindow& fields = solids.fields;
  fields.solidity = from.numbers(voxels);
  fields.velocity = from.numbers(3 * voxels);
  fields.diameter = from.numbers(voxels);
  fields.diameter43 = from.numbers(voxels);
  if (from.left() > 0) fields.inside_fraction = from.numbers(voxels);
  from.end();
  return solids;
}

}  // namespace millfoam::averaging
