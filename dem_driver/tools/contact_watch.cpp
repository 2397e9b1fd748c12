// SPDX-License-Identifier: GPL-3.0-or-later
// The headers of the contact models come first: they need the lists of models that CMakeLists.txt writes.
#include <liggghts/contact_models.h>
//
#include <liggghts/fix_insert_stream.h>
//
#include <liggghts/fix_wall_gran_base.h>
#include <liggghts/pair_gran_base.h>
//
#include "dem_driver/tools/contact_watch.hpp"

#include <liggghts/atom.h>
#include <liggghts/comm.h>
#include <liggghts/fix.h>
#include <liggghts/fix_mesh_surface.h>
#include <liggghts/modify.h>
#include <liggghts/neighbor.h>
#include <liggghts/update.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "dem_driver/contact_order.hpp"
#include "dem_driver/contact_record.hpp"
#include "dem_driver/deck.hpp"
#include "dem_driver/tools/stop.hpp"

namespace millfoam::dem_driver {

namespace {

namespace models = LIGGGHTS::ContactModels;
using LAMMPS_NS::LAMMPS;
using Triple = std::array<double, 3>;

/// A contact as the contact model has computed it in this step.
struct Seen {
  int ball = 0;   ///< index of the ball, which is the first body
  int other = 0;  ///< of the second one, or not used
  double energy = 0;
  ContactForce contact;
};

/// One at a wall.
struct SeenAtWall : Seen {
  LAMMPS_NS::FixMeshSurface* part = nullptr;
  int triangle = 0;
  Triple velocity = {};  ///< of the wall
  Triple point = {};     ///< lab frame
};

Triple triple_of(const double* values) {
  return {values[0], values[1], values[2]};
}

Triple minus(const double* first, const double* second) {
  return {first[0] - second[0], first[1] - second[1], first[2] - second[2]};
}

Triple turned(const Triple& vector, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * vector[0] - s * vector[1], s * vector[0] + c * vector[1], vector[2]};
}

/// What the contact model hands over during a step. LIGGGHTS has one pair style and one fix of walls, and makes
/// them itself, so there is one such place for all.
class Collector {
 public:
  void add(const models::SurfacesIntersectData& data, const models::ForceData& on_ball);
  void follow(const LAMMPS_NS::Atom* atom) { atom_ = atom; }
  void clear() {
    balls.clear();
    walls.clear();
  }
  std::vector<Seen> balls;
  std::vector<SeenAtWall> walls;

 private:
  const LAMMPS_NS::Atom* atom_ = nullptr;  ///< nothing: contacts are not followed
};

Collector collector;

void Collector::add(const models::SurfacesIntersectData& data, const models::ForceData& on_ball) {
  if (atom_ == nullptr || !data.computeflag || !data.shearupdate) return;
  // Each rank with one of the two balls computes a contact; the one that has the lower id counts it
  if (!data.is_wall && data.j >= atom_->nlocal && atom_->tag[data.i] > atom_->tag[data.j]) return;
  Seen seen;
  seen.ball = data.i;
  seen.other = data.j;
  seen.energy = data.meff * data.vn * data.vn / 2 + 0.4 * data.kn * data.deltan * data.deltan;
  seen.contact = {triple_of(data.en),
                  data.Fn,
                  triple_of(on_ball.delta_F),
                  triple_of(on_ball.delta_torque),
                  data.cri,
                  data.is_wall ? 0 : data.crj};
  if (!data.is_wall) {
    balls.push_back(seen);
    return;
  }
  walls.push_back({seen, data.fix_mesh, data.fix_mesh->triMesh()->id(data.j), triple_of(data.v_j),
                   minus(atom_->x[data.i], data.delta)});
}

constexpr int watched_surface = 41;  // of LIGGGHTS' numbers up to 63 one that is free
using Style = models::GranStyle<models::HERTZ, models::TANGENTIAL_HISTORY, models::COHESION_OFF,
                                models::ROLLING_CDT, models::SURFACE_DEFAULT>;
using WatchedStyle = models::GranStyle<models::HERTZ, models::TANGENTIAL_HISTORY, models::COHESION_OFF,
                                       models::ROLLING_CDT, watched_surface>;

/// The contact model of the decks. LIGGGHTS' templates call it, so its functions hide those of the base.
class WatchedModel : public models::ContactModel<Style> {
 public:
  using Base = models::ContactModel<Style>;
  using Base::Base;
  int64_t hashcode() { return WatchedStyle::HASHCODE; }
  void surfacesIntersect(models::SurfacesIntersectData& data, models::ForceData& first,
                         models::ForceData& second) {
    Base::surfacesIntersect(data, first, second);
    collector.add(data, first);
  }
};

using WatchedPair = LIGGGHTS::PairStyles::Granular<WatchedModel>;
using WatchedWall = LIGGGHTS::Walls::Granular<WatchedModel>;

LIGGGHTS::PairStyles::IGranularPairStyle* make_pair_style(LAMMPS* liggghts, LAMMPS_NS::PairGran* parent,
                                                          int64_t hash) {
  return new WatchedPair(liggghts, parent, hash);
}

LIGGGHTS::Walls::IGranularWall* make_wall(LAMMPS* liggghts, LAMMPS_NS::FixWallGran* parent, int64_t hash) {
  return new WatchedWall(liggghts, parent, hash);
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
    for (const auto& part : order.parts) parts_.push_back(part_of(part));
    statistics_.count_touches(false);
    if (comm->me == 0) begin();
  }

  int setmask() override { return LAMMPS_NS::FixConst::END_OF_STEP; }

  void setup(int) override {
    collector.clear();
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
    homeless_ = state->open;
    wall_steps_ = state->wall_steps;
    if (!state->wall_numbers.empty()) wall_totals_.numbers = state->wall_numbers;
  }

  /// After LIGGGHTS' first exchange of balls: whether the run resumes, and that the walls are those of the files.
  void begin_following() {
    int resumes = homeless_.empty() ? 0 : 1;
    MPI_Bcast(&resumes, 1, MPI_INT, 0, world);
    statistics_.count_touches(resumes != 0);
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
          node = in_mill(node);
          double nearest = order_.cell_edge;
          for (const auto& corner : triangles[number])
            nearest = std::min(nearest, std::hypot(node[0] - corner[0], node[1] - corner[1], node[2] - corner[2]));
          same = nearest < 1e-3 * order_.cell_edge;
        }
        if (!same)
          throw std::runtime_error("triangle " + std::to_string(number) + " of the wall '" + order_.parts[p] +
                                   "' is not that of its file");
      }
    }
  }

  /// From the lab frame to the frame of the wall files.
  Triple in_mill(const Triple& vector) const {
    return turned(vector, -order_.angular_velocity * order_.timestep * static_cast<double>(update->ntimestep));
  }

  void follow(long step) {
    if (!begun_) begin_following();
    // The velocities of the other ranks' balls are those of the half step before
    comm->forward_comm();
    if (moved_ || neighbor->ago == 0) hand_over();
    moved_ = false;
    for (const Seen& seen : collector.balls) add(seen);
    for (const SeenAtWall& seen : collector.walls) add(seen);
    collector.clear();
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

  int class_of(int ball) const {
    const double diameter = 2 * atom->radius[ball];
    const auto& all = order_.diameters;
    const auto nearer = [&](double a, double b) { return std::abs(a - diameter) < std::abs(b - diameter); };
    return static_cast<int>(std::min_element(all.begin(), all.end(), nearer) - all.begin());
  }

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
    const auto part = static_cast<int>(std::find(parts_.begin(), parts_.end(), seen.part) - parts_.begin());
    if (part == static_cast<int>(parts_.size())) throw std::runtime_error("a wall is not in contacts.json");
    const ContactMotion motion{minus(atom->v[i], seen.velocity.data()), triple_of(atom->omega[i]), {}};
    const ContactWork work = work_of(seen.contact, motion, order_.timestep);
    statistics_.add(atom->tag[i], -1 - part, kinds_.of_wall(class_of(i), part), seen.energy, work);
    const Triple& push = seen.contact.force;
    const double moment = -(seen.point[0] * push[1] - seen.point[1] * push[0]);
    ContactForce in_mill_frame = seen.contact;
    in_mill_frame.normal = in_mill(seen.contact.normal);
    in_mill_frame.force = in_mill(push);
    const std::size_t cell = cells_.cell_of(static_cast<std::size_t>(part),
                                            static_cast<std::size_t>(seen.triangle), in_mill(seen.point));
    wall_sums_.add(cell, in_mill_frame, moment, work);
  }

  void end_block(long step) {
    ContactSums sums(kinds_);
    sums.numbers = reduce(statistics_.sums.numbers, world);
    statistics_.sums.clear();
    const auto wall_numbers = reduce(wall_sums_.numbers, world);
    wall_sums_.clear();
    const auto open = gather(statistics_.open(), world, false);
    const bool ends_walls = wall_steps_ >= order_.wall_steps || step == order_.end_step;
    if (comm->me == 0) {
      for (std::size_t k = 0; k < wall_numbers.size(); ++k) wall_totals_.numbers[k] += wall_numbers[k];
      record_->write(step, step - last_, sums);
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
  std::optional<ContactRecord> record_;  ///< of rank 0
  std::vector<OpenContact> homeless_;    ///< read from a file, not yet on the rank of their ball
  long start_;
  long last_;  ///< step of the last block
  long wall_steps_ = 0;
  bool moved_ = true;  ///< whether balls may have changed their rank
  bool begun_ = false;
};

}  // namespace

void add_watched_model() {
  models::Factory::instance().addSurfaceModel(watched_surface_model, watched_surface);
  LIGGGHTS::PairStyles::Factory::instance().addStyle("gran", static_cast<int>(WatchedStyle::HASHCODE),
                                                     make_pair_style);
  LIGGGHTS::Walls::Factory::instance().addStyle("gran", static_cast<int>(WatchedStyle::HASHCODE), make_wall);
}

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
  collector.follow(liggghts.atom);
}

}  // namespace millfoam::dem_driver
