// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/contact_statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace millfoam::dem_driver {

namespace {

std::uint64_t key_of(std::int32_t ball, std::int32_t other) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(ball)) << 32 |
         static_cast<std::uint32_t>(other);
}

}  // namespace

int ContactKinds::of_balls(int first, int second) const {
  const auto [low, high] = std::minmax(first, second);
  assert(low >= 0 && high < classes_);
  return high * (high + 1) / 2 + low;
}

int ContactKinds::of_wall(int ball, int part) const {
  assert(ball >= 0 && ball < classes_ && part >= 0 && part < parts_);
  return classes_ * (classes_ + 1) / 2 + ball * parts_ + part;
}

ContactKinds::Bodies ContactKinds::bodies(int kind) const {
  assert(kind >= 0 && kind < size());
  const int pairs = classes_ * (classes_ + 1) / 2;
  if (kind >= pairs) return {(kind - pairs) / parts_, -1 - (kind - pairs) % parts_};
  int high = 0;
  while ((high + 1) * (high + 2) / 2 <= kind) ++high;
  return {kind - high * (high + 1) / 2, high};
}

int energy_bin(double energy) {
  if (!(energy >= lowest_energy)) return 0;
  const double bin = 1 + std::floor(energy_bins_per_decade * std::log10(energy / lowest_energy));
  return static_cast<int>(std::min<double>(bin, energy_bins - 1));
}

double energy_edge(int edge) {
  assert(edge >= 0 && edge < energy_edges);
  return lowest_energy * std::pow(10.0, static_cast<double>(edge) / energy_bins_per_decade);
}

namespace {

double* bin_numbers(std::vector<double>& numbers, int kind, double energy) {
  return numbers.data() + static_cast<std::size_t>(kind) * ContactSums::numbers_per_kind + 3 +
         static_cast<std::size_t>(energy_bin(energy)) * ContactSums::numbers_per_bin;
}

}  // namespace

void ContactSums::add_work(int kind, const ContactWork& work) {
  double* at = numbers.data() + static_cast<std::size_t>(kind) * numbers_per_kind;
  at[0] += work.normal;
  at[1] += work.tangential;
  at[2] += work.rolling;
}

void ContactSums::add_touch(int kind, double energy) {
  bin_numbers(numbers, kind, energy)[0] += 1;
}

void ContactSums::add_collision(int kind, const ContactWork& work) {
  double* at = bin_numbers(numbers, kind, work.total());
  at[1] += 1;
  at[2] += work.normal;
  at[3] += work.tangential;
  at[4] += work.rolling;
}

KindSums ContactSums::of(int kind) const {
  const double* at = numbers.data() + static_cast<std::size_t>(kind) * numbers_per_kind;
  KindSums sums{{at[0], at[1], at[2]}, {}};
  at += 3;
  for (int bin = 0; bin < energy_bins; ++bin, at += numbers_per_bin)
    sums.bins.push_back({at[0], at[1], {at[2], at[3], at[4]}});
  return sums;
}

void ContactSums::clear() {
  std::fill(numbers.begin(), numbers.end(), 0.0);
}

ContactStatistics::ContactStatistics(const ContactKinds& kinds) : sums(kinds), slots_(16) {}

std::size_t ContactStatistics::home_of(std::uint64_t key) const {
  return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15U) >> shift_);  // Fibonacci hashing
}

std::size_t ContactStatistics::find(std::uint64_t key) const {
  const std::size_t last = slots_.size() - 1;
  std::size_t slot = home_of(key);
  for (; slots_[slot] != 0; slot = (slot + 1) & last) {
    const OpenContact& contact = open_[slots_[slot] - 1];
    if (key_of(contact.ball, contact.other) == key) break;
  }
  return slot;
}

void ContactStatistics::grow() {
  slots_.assign(2 * slots_.size(), 0U);
  --shift_;
  for (std::size_t i = 0; i < open_.size(); ++i)
    slots_[find(key_of(open_[i].ball, open_[i].other))] = static_cast<std::uint32_t>(i + 1);
}

void ContactStatistics::insert(const OpenContact& contact) {
  open_.push_back(contact);
  if (slots_.size() < 2 * open_.size()) return grow();
  slots_[find(key_of(contact.ball, contact.other))] = static_cast<std::uint32_t>(open_.size());
}

void ContactStatistics::add(std::int32_t ball, std::int32_t other, int kind, double energy,
                            const ContactWork& work) {
  sums.add_work(kind, work);
  const std::uint32_t known = slots_[find(key_of(ball, other))];
  if (known == 0) {
    if (counts_touches_) sums.add_touch(kind, energy);
    insert({ball, other, kind, step_, work});
    return;
  }
  OpenContact& contact = open_[known - 1];
  contact.work += work;
  contact.step = step_;
}

void ContactStatistics::erase(std::size_t index) {
  const std::size_t last = slots_.size() - 1;
  std::size_t free = find(key_of(open_[index].ball, open_[index].other));
  // Closes the gap, so that no probe ends before its contact
  for (std::size_t slot = (free + 1) & last; slots_[slot] != 0; slot = (slot + 1) & last) {
    const OpenContact& contact = open_[slots_[slot] - 1];
    const std::size_t home = home_of(key_of(contact.ball, contact.other));
    if (((slot - home) & last) < ((slot - free) & last)) continue;
    slots_[free] = slots_[slot];
    free = slot;
  }
  slots_[free] = 0;
  if (index + 1 < open_.size()) {
    const OpenContact& moved = open_.back();
    slots_[find(key_of(moved.ball, moved.other))] = static_cast<std::uint32_t>(index + 1);
    open_[index] = moved;
  }
  open_.pop_back();
}

void ContactStatistics::end_step() {
  for (std::size_t i = 0; i < open_.size();) {
    if (open_[i].step == step_) {
      ++i;
      continue;
    }
    sums.add_collision(open_[i].kind, open_[i].work);
    erase(i);
  }
  ++step_;
}

std::vector<OpenContact> ContactStatistics::take(const std::function<bool(const OpenContact&)>& leaves) {
  std::vector<OpenContact> taken;
  for (std::size_t i = 0; i < open_.size();) {
    if (!leaves(open_[i])) {
      ++i;
      continue;
    }
    taken.push_back(open_[i]);
    erase(i);
  }
  return taken;
}

void ContactStatistics::put(const OpenContact& contact) {
  const std::uint32_t known = slots_[find(key_of(contact.ball, contact.other))];
  if (known == 0) {
    insert(contact);
    open_.back().step = step_;
  } else {
    open_[known - 1].work += contact.work;
  }
}

}  // namespace millfoam::dem_driver
