// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "dem_driver/contact_work.hpp"

namespace millfoam::dem_driver {

/// The kinds of contacts: every pair of classes of balls, and every class with every part of the walls.
class ContactKinds {
 public:
  /// @param classes, parts  numbers of classes of balls and of parts of the walls
  ContactKinds(int classes, int parts) : classes_(classes), parts_(parts) {}
  /// Their number.
  int size() const { return classes_ * (classes_ + 1) / 2 + classes_ * parts_; }
  /// Of two balls of these classes, from 0, in any order.
  int of_balls(int first, int second) const;
  /// Of a ball of a class and a part of the walls, both from 0.
  int of_wall(int ball, int part) const;
  /// The class of the first body of a kind, and that of the second, which is not below it, or -1 - part.
  struct Bodies {
    int first = 0;   ///< class, from 0
    int second = 0;  ///< class, or -1 - part
  };
  /// The reverse of of_balls and of_wall.
  Bodies bodies(int kind) const;

 private:
  int classes_;
  int parts_;
};

/// Bins of energy, equally wide in its logarithm. The first has what is below `lowest_energy`, also energies
/// below 0, the last what is above the highest edge.
inline constexpr double lowest_energy = 1e-15;  // J
/// Bins in a factor of 10.
inline constexpr int energy_bins_per_decade = 5;
inline constexpr int energy_edges = 18 * energy_bins_per_decade + 1;  ///< up to 1000 J
inline constexpr int energy_bins = energy_edges + 1;                  ///< number of bins
/// The bin of an energy, J; from 0.
int energy_bin(double energy);
/// Edge between the bins `edge` and `edge` + 1, J.
double energy_edge(int edge);

/// One bin of energy of one kind of contacts.
struct BinSums {
  double touches = 0;     ///< collisions whose energy at first touch is in this bin
  double collisions = 0;  ///< collisions that have ended and whose dissipated energy is in this bin
  ContactWork work;       ///< of these whole collisions, J
};

/// What contacts of one kind did in some steps. Numbers add up over ranks and times.
struct KindSums {
  ContactWork work;           ///< in these steps, J
  std::vector<BinSums> bins;  ///< [energy_bins]
};

/// The same of all kinds, as one row of numbers for MPI and files: for each kind `numbers_per_kind`.
class ContactSums {
 public:
  static constexpr std::size_t numbers_per_bin = 5;  ///< in a row
  /// In a row: the work, and all bins.
  static constexpr std::size_t numbers_per_kind = 3 + numbers_per_bin * energy_bins;
  /// Sums of nothing.
  explicit ContactSums(const ContactKinds& kinds)
      : numbers(static_cast<std::size_t>(kinds.size()) * numbers_per_kind) {}
  /// Adds work of a step, J.
  void add_work(int kind, const ContactWork& work);
  /// Adds a collision that begins with this energy, J.
  void add_touch(int kind, double energy);
  /// Adds a collision that has ended, with its whole work, J.
  void add_collision(int kind, const ContactWork& work);
  /// Of one kind.
  KindSums of(int kind) const;
  /// Back to sums of nothing.
  void clear();
  std::vector<double> numbers;  ///< [kinds][numbers_per_kind]
};

/// A contact that has not ended. `ball` is the id of the ball with the lower id, or that at the wall; `other`
/// the other ball's id, or -1 - part.
struct OpenContact {
  std::int32_t ball = 0;   ///< its id
  std::int32_t other = 0;  ///< its id, or -1 - part
  std::int32_t kind = 0;   ///< as ContactKinds
  std::int32_t step = 0;   ///< in which it was last seen, as ContactStatistics counts
  ContactWork work;        ///< since its first touch
};

/// Follows every contact from its first touch to its separation. Touches of one ball with several triangles
/// of one part of the walls are one contact.
class ContactStatistics {
 public:
  /// No contacts yet.
  explicit ContactStatistics(const ContactKinds& kinds);
  /// A contact in this step.
  /// @param ball, other, kind  as OpenContact
  /// @param energy  of the motion along the normal and of the spring, J: at first touch, the collision's
  /// energy
  /// @param work  of this step, J
  void add(std::int32_t ball, std::int32_t other, int kind, double energy, const ContactWork& work);
  /// Ends the step: contacts that were not in it have ended.
  void end_step();
  /// Whether contacts that are new in this step are touches. They are not in the first step that is seen,
  /// because nobody knows when they began. When they end they are collisions, with the work since then.
  void count_touches(bool count) { counts_touches_ = count; }
  /// Contacts that have not ended.
  const std::vector<OpenContact>& open() const { return open_; }
  /// Removes and returns the contacts for which `leaves` is true; another rank has their ball now.
  std::vector<OpenContact> take(const std::function<bool(const OpenContact&)>& leaves);
  /// Continues a contact that another rank, or the run before, has begun.
  void put(const OpenContact& contact);
  ContactSums sums;  ///< since they were cleared

 private:
  std::size_t home_of(std::uint64_t key) const;
  std::size_t find(std::uint64_t key) const;
  void insert(const OpenContact& contact);
  void grow();
  void erase(std::size_t index);

  std::vector<OpenContact> open_;
  std::vector<std::uint32_t> slots_;  ///< 1 + index into open_; 0: free. Open addressing, linear probes
  unsigned shift_ = 60;               ///< 64 - log2 of the number of slots
  std::int32_t step_ = 1;
  bool counts_touches_ = true;
};

}  // namespace millfoam::dem_driver
