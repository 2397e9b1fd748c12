// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/unique_ids.hpp"

#include <algorithm>

namespace millfoam::averaging {

namespace {

/// An id that appears twice; `lowest` is the lowest one, `span` the number of ids from it to the highest.
std::optional<long long> doubled_dense_id(const std::vector<Particle>& particles, long long lowest,
                                          unsigned long long span) {
  std::vector<bool> seen(span);
  for (const Particle& particle : particles) {
    const auto place = static_cast<std::size_t>(particle.id - lowest);
    if (seen[place]) return particle.id;
    seen[place] = true;
  }
  return std::nullopt;
}

std::optional<long long> doubled_sparse_id(const std::vector<Particle>& particles) {
  std::vector<long long> ids(particles.size());
  std::transform(particles.begin(), particles.end(), ids.begin(), [](const Particle& p) { return p.id; });
  std::sort(ids.begin(), ids.end());
  const auto twin = std::adjacent_find(ids.begin(), ids.end());
  return twin == ids.end() ? std::nullopt : std::optional(*twin);
}

}  // namespace

std::optional<std::pair<std::size_t, std::size_t>> find_duplicates(const std::vector<Particle>& particles) {
  if (particles.size() < 2) return std::nullopt;
  long long lowest = particles.front().id, highest = lowest;
  for (const Particle& particle : particles) {
    lowest = std::min(lowest, particle.id);
    highest = std::max(highest, particle.id);
  }
  // Unsigned, because the distance between two long long may be more than a long long holds.
  const auto distance = static_cast<unsigned long long>(highest) - static_cast<unsigned long long>(lowest);
  const auto id = distance < 64 * particles.size() ? doubled_dense_id(particles, lowest, distance + 1)
                                                   : doubled_sparse_id(particles);
  if (!id) return std::nullopt;
  const auto is_it = [&](const Particle& particle) { return particle.id == *id; };
  const auto first = std::find_if(particles.begin(), particles.end(), is_it);
  const auto second = std::find_if(std::next(first), particles.end(), is_it);
  return std::pair(static_cast<std::size_t>(first - particles.begin()),
                   static_cast<std::size_t>(second - particles.begin()));
}

}  // namespace millfoam::averaging
