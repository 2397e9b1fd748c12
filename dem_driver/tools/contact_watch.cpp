// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/tools/contact_watch.hpp"

#include <liggghts/atom.h>
#include <liggghts/comm.h>
#include <liggghts/fix.h>
#include <liggghts/fix_mesh_surface.h>
#include <liggghts/lammps.h>
#include <liggghts/modify.h>
#include <liggghts/neighbor.h>
#include <liggghts/update.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "dem_driver/contact_order.hpp"
#include "dem_driver/contact_record.hpp"
#include "dem_driver/tools/ball_shape.hpp"
#include "dem_driver/tools/stop.hpp"
#include "dem_driver/tools/watched_model.hpp"

namespace millfoam::dem_driver {

namespace {

using LAMMPS_NS::LAMMPS;
using Triple = std::array<double, 3>;

Triple triple_of(const double* values) {
  return {values[0], values[1], values[2]};
}

Triple minus(const double* first, const double* second) {
  return {first[0] - second[0], first[1] - second[1], first[2] - second[2]};
}

/// Gathers a vector of plain values of all ranks, on rank 0 or on all.
template <typename Value>
std::vector<Value> gather(const std::vector<Value>& values, MPI_Comm world, bool on_all) {
  int ranks = 1;
  MPI_Comm_size(world, &ranks);
  const int bytes = static_cast<int>(values.size() * sizeof(Value));
  std::vector<int> sizes(static_cast<std::size_t>(ranks)), begins(static_cast<std::size_t>(ranks));
  MPI_Allgather(&bytes, 1, MPI_INT, sizes.data(), 1, MPI_INT, world);
  int all = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    begins[i] = all;
    all += sizes[i];
  }
  std::vector<Value> gathered(static_cast<std::size_t>(all) / sizeof(Value));
  if (all == 0) return gathered;
  if (on_all)
    MPI_Allgatherv(values.data(), bytes, MPI_BYTE, gathered.data(), sizes.data(), begins.data(), MPI_BYTE,
                   world);
  else
    MPI_Gatherv(values.data(), bytes, MPI_BYTE, gathered.data(), sizes.data(), begins.data(), MPI_BYTE, 0,
                world);
  return gathered;
}

/// Sums of all ranks, on rank 0.
std::vector<double> reduce(const std::vector<double>& numbers, MPI_Comm world) {
  std::vector<double> sums(numbers.size());
  MPI_Reduce(numbers.data(), sums.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, MPI_SUM, 0, world);
  return sums;
}

/// Follows the contacts at the end of every step, when the velocities are those of the whole step.
class WatchFix : public LAMMPS_NS::Fix {
 public:
  WatchFix(LAMMPS& liggghts, int words, char** word, const ContactOrder& order)
      : Fix(&liggghts, words, word),
        order_(order),
        kinds_(order.kinds()),
        statistics_(kinds_),
        cells_(order.cells()),
        wall_sums_(cells_.size()),
        wall_totals_(cells_.size()),
        start_(static_cast<long>(update->ntimestep)),
        last_(start_) {
    nevery = 1;
    for (std::size_t part = 0; part < order.parts.size(); ++part) {
      parts_.push_back(part_of(order.parts[part]));
      turns_.push_back(order.turns(part));
    }
    statistics_.count_touches(false);
    if (comm->me == 0) begin();
  }

  int setmask() override { return LAMMPS_NS::FixConst::END_OF_STEP; }

  void setup(int) override {
    collector().clear();
    moved_ = true;
  }

  void end_of_step() override {
    // An exception must not pass through LIGGGHTS
    try {
      follow(static_cast<long>(update->ntimestep));
    } catch (const std::exception& failure) {
      stop(failure);
    }
  }

 private:
  LAMMPS_NS::FixMeshSurface* part_of(const std::string& part) {
    auto* fix = dynamic_cast<LAMMPS_NS::FixMeshSurface*>(modify->find_fix_id(part.c_str()));
    if (fix == nullptr) throw std::runtime_error("the deck has no wall '" + part + "' of contacts.json");
    return fix;
  }

  /// On rank 0: files, and the contacts that the run before has left.
  void begin() {
    record_.emplace(".", kinds_, start_);
    const auto state = read_contact_state(".", start_);
    if (!state) return;
    resumes_ = 1;
    homeless_ = state->open;
    wall_steps_ = state->wall_steps;
    if (!state->wall_numbers.empty()) wall_totals_.numbers = state->wall_numbers;
  }

  /// After LIGGGHTS' first exchange of balls: whether the run resumes, and that the walls are those of the
  /// files.
  void begin_following() {
    MPI_Bcast(&resumes_, 1, MPI_INT, 0, world);
    statistics_.count_touches(resumes_ != 0);
    MPI_Bcast(&wall_steps_, 1, MPI_LONG, 0, world);
    require_walls();
    begun_ = true;
  }

  void require_walls() {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      LAMMPS_NS::TriMesh& mesh = *parts_[p]->triMesh();
      const auto& triangles = cells_.parts()[p].triangles;
      for (int i = 0; i < mesh.sizeLocal(); ++i) {
        const auto number = static_cast<std::size_t>(mesh.id(i));
        bool same = number < triangles.size();
        for (int k = 0; k < 3 && same; ++k) {
          Triple node;
          mesh.node(i, k, node.data());
          node = in_wall(p, node);
          double nearest = order_.cell_edge;
          for (const auto& corner : triangles[number])
            nearest =
                std::min(nearest, std::hypot(node[0] - corner[0], node[1] - corner[1], node[2] - corner[2]));
          same = nearest < 1e-3 * order_.cell_edge;
        }
        if (!same)
          throw std::runtime_error("triangle " + std::to_string(number) + " of the wall '" + order_.parts[p] +
                                   "' is not that of its file");
      }
    }
  }

  /// From the lab frame to that of a part's file, in which the part is at rest.
  Triple in_wall(std::size_t part, const Triple& vector) const {
    if (!turns_[part]) return vector;
    return {cosine_ * vector[0] + sine_ * vector[1], cosine_ * vector[1] - sine_ * vector[0], vector[2]};
  }

  void follow(long step) {
    const double angle = order_.angular_velocity * order_.timestep * static_cast<double>(step);
    cosine_ = std::cos(angle);
    sine_ = std::sin(angle);
    if (!begun_) begin_following();
    // The velocities of the other ranks' balls are those of the half step before
    comm->forward_comm();
    if (moved_ || neighbor->ago == 0) {
      hand_over();
      find_classes();
    }
    moved_ = false;
    for (const Seen& seen : collector().balls) add(seen);
    for (const SeenAtWall& seen : collector().walls) add(seen);
    collector().clear();
    statistics_.end_step();
    statistics_.count_touches(true);
    ++wall_steps_;
    if ((step - start_) % order_.block_steps == 0 || step == order_.end_step) end_block(step);
  }

  /// Contacts follow the ball that they are counted with to its rank.
  void hand_over() {
    const auto is_here = [&](const OpenContact& contact) {
      const int index = atom->map(contact.ball);
      return index >= 0 && index < atom->nlocal;
    };
    auto leaving = statistics_.take([&](const OpenContact& contact) { return !is_here(contact); });
    leaving.insert(leaving.end(), homeless_.begin(), homeless_.end());
    homeless_.clear();
    for (const OpenContact& contact : gather(leaving, world, true))
      if (is_here(contact)) statistics_.put(contact);
  }

  /// The class of each ball, ghosts too: that of the nearest diameter.
  void find_classes() {
    classes_.resize(static_cast<std::size_t>(atom->nlocal + atom->nghost));
    const auto& all = order_.diameters;
    for (std::size_t i = 0; i < classes_.size(); ++i) {
      const double diameter = 2 * ball_radius(*atom, static_cast<int>(i));
      const auto nearer = [&](double a, double b) { return std::abs(a - diameter) < std::abs(b - diameter); };
      classes_[i] = static_cast<int>(std::min_element(all.begin(), all.end(), nearer) - all.begin());
    }
  }

  int class_of(int ball) const { return classes_[static_cast<std::size_t>(ball)]; }

  void add(const Seen& seen) {
    const int i = seen.ball, j = seen.other;
    const ContactMotion motion{minus(atom->v[i], atom->v[j]), triple_of(atom->omega[i]),
                               triple_of(atom->omega[j])};
    const auto [low, high] = std::minmax(atom->tag[i], atom->tag[j]);
    statistics_.add(low, high, kinds_.of_balls(class_of(i), class_of(j)), seen.energy,
                    work_of(seen.contact, motion, order_.timestep));
  }

  void add(const SeenAtWall& seen) {
    const int i = seen.ball;
    const auto part =
        static_cast<std::size_t>(std::find(parts_.begin(), parts_.end(), seen.part) - parts_.begin());
    if (part == parts_.size()) throw std::runtime_error("a wall is not in contacts.json");
    const int number = static_cast<int>(part);
    const ContactMotion motion{minus(atom->v[i], seen.velocity.data()), triple_of(atom->omega[i]), {}};
    const ContactWork work = work_of(seen.contact, motion, order_.timestep);
    statistics_.add(atom->tag[i], -1 - number, kinds_.of_wall(class_of(i), number), seen.energy, work);
    const Triple& push = seen.contact.force;
    const double moment = -(seen.point[0] * push[1] - seen.point[1] * push[0]);
    ContactForce in_wall_frame = seen.contact;
    in_wall_frame.normal = in_wall(part, seen.contact.normal);
    in_wall_frame.force = in_wall(part, push);
    const std::size_t cell =
        cells_.cell_of(part, static_cast<std::size_t>(seen.triangle), in_wall(part, seen.point));
    wall_sums_.add(cell, in_wall_frame, moment, work);
  }

  /// Energy of spin of this rank's balls, J.
  double spin_energy() const {
    double energy = 0;
    for (int i = 0; i < atom->nlocal; ++i) {
      const double* spin = atom->omega[i];
      if (atom->superquadric_flag) {
        const double* momentum = atom->angmom[i];
        energy += (spin[0] * momentum[0] + spin[1] * momentum[1] + spin[2] * momentum[2]) / 2;
        continue;
      }
      energy += atom->rmass[i] * atom->radius[i] * atom->radius[i] / 5 *
                (spin[0] * spin[0] + spin[1] * spin[1] + spin[2] * spin[2]);
    }
    return energy;
  }

  void end_block(long step) {
    ContactSums sums(kinds_);
    sums.numbers = reduce(statistics_.sums.numbers, world);
    statistics_.sums.clear();
    const auto wall_numbers = reduce(wall_sums_.numbers, world);
    wall_sums_.clear();
    const double spin = reduce({spin_energy()}, world).front();
    const auto open = gather(statistics_.open(), world, false);
    const bool ends_walls = wall_steps_ >= order_.wall_steps || step == order_.end_step;
    if (comm->me == 0) {
      for (std::size_t k = 0; k < wall_numbers.size(); ++k) wall_totals_.numbers[k] += wall_numbers[k];
      record_->write(step, step - last_, spin, sums);
      if (ends_walls) {
        record_->write(step, wall_steps_, wall_totals_);
        wall_totals_.clear();
      }
      write_contact_state(".", step, {open, ends_walls ? 0 : wall_steps_, wall_totals_.numbers});
    }
    if (ends_walls) wall_steps_ = 0;
    last_ = step;
  }

  ContactOrder order_;
  ContactKinds kinds_;
  ContactStatistics statistics_;
  WallCells cells_;
  WallSums wall_sums_;    ///< of this rank, since the last block
  WallSums wall_totals_;  ///< on rank 0, of all ranks until the last block
  std::vector<LAMMPS_NS::FixMeshSurface*> parts_;
  std::vector<bool> turns_;              ///< whether each part does
  std::optional<ContactRecord> record_;  ///< of rank 0
  std::vector<int> classes_;             ///< of the balls in LIGGGHTS' order
  std::vector<OpenContact> homeless_;    ///< read from a file, not yet on the rank of their ball
  int resumes_ = 0;                      ///< whether the run before has left its contacts
  long start_;
  long last_;  ///< step of the last block
  long wall_steps_ = 0;
  double cosine_ = 1;  ///< of the turning walls' angle
  double sine_ = 0;
  bool moved_ = true;  ///< whether balls may have changed their rank
  bool begun_ = false;
};

}  // namespace

void watch_contacts(LAMMPS& liggghts, const std::filesystem::path& order) {
  // LIGGGHTS' list of fixes takes only styles that it knows, so an idle one of its own is exchanged
  std::string words[] = {"watchContacts", "all", "print", "2000000000", "none"};
  std::vector<char*> word;
  for (std::string& text : words) word.push_back(text.data());
  LAMMPS_NS::Modify& modify = *liggghts.modify;
  modify.add_fix(static_cast<int>(word.size()), word.data());
  const int index = modify.find_fix(word[0]);
  auto fix = std::make_unique<WatchFix>(liggghts, static_cast<int>(word.size()), word.data(),
                                        read_contact_order(order));
  delete modify.fix[index];
  modify.fix[index] = fix.release();
  modify.fmask[index] = modify.fix[index]->setmask();
  collector().follow(liggghts.atom);
}

}  // namespace millfoam::dem_driver
