// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/tools/watched_model.hpp"

// The contact models come first: they need the lists of models that CMakeLists.txt writes
#include <liggghts/contact_models.h>
// This one before the next, which lacks it
#include <liggghts/fix_insert_stream.h>
// The templates of pair style and wall
#include <liggghts/fix_wall_gran_base.h>
#include <liggghts/pair_gran_base.h>

#include "dem_driver/deck.hpp"

namespace millfoam::dem_driver {

namespace {

namespace models = LIGGGHTS::ContactModels;
using LAMMPS_NS::LAMMPS;
using Triple = std::array<double, 3>;

Triple triple_of(const double* values) {
  return {values[0], values[1], values[2]};
}

Triple minus(const double* first, const double* second) {
  return {first[0] - second[0], first[1] - second[1], first[2] - second[2]};
}

void collect(const models::SurfacesIntersectData& data, const models::ForceData& on_ball) {
  Collector& into = collector();
  const LAMMPS_NS::Atom* atom = into.followed();
  if (atom == nullptr || !data.computeflag || !data.shearupdate) return;
  // Each rank with one of the two balls computes a contact; the one that has the lower id counts it
  if (!data.is_wall && data.j >= atom->nlocal && atom->tag[data.i] > atom->tag[data.j]) return;
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
    into.balls.push_back(seen);
    return;
  }
  into.walls.push_back({seen, data.fix_mesh, data.fix_mesh->triMesh()->id(data.j), triple_of(data.v_j),
                        minus(atom->x[data.i], data.delta)});
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
    collect(data, first);
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

}  // namespace

Collector& collector() {
  static Collector only;
  return only;
}

void add_watched_model() {
  models::Factory::instance().addSurfaceModel(watched_surface_model, watched_surface);
  LIGGGHTS::PairStyles::Factory::instance().addStyle("gran", static_cast<int>(WatchedStyle::HASHCODE),
                                                     make_pair_style);
  LIGGGHTS::Walls::Factory::instance().addStyle("gran", static_cast<int>(WatchedStyle::HASHCODE), make_wall);
}

}  // namespace millfoam::dem_driver
