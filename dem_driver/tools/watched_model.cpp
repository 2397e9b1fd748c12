// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/tools/watched_model.hpp"

#ifdef SUPERQUADRIC_ACTIVE_FLAG
// LIGGGHTS' model of superquadrics takes these names without their scope
#include <liggghts/math_extra_liggghts_nonspherical.h>
using namespace MathExtraLiggghtsNonspherical;
#endif
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

/// The arms of a contact's force: from the centres of two balls, of which the second may be a wall.
std::array<Triple, 2> arms_of(const models::SurfacesIntersectData& data, const LAMMPS_NS::Atom& atom) {
  std::array<Triple, 2> arms = {};
#ifdef NONSPHERICAL_ACTIVE_FLAG
  arms[0] = minus(data.contact_point, atom.x[data.i]);
  if (!data.is_wall) arms[1] = minus(data.contact_point, atom.x[data.j]);
#else
  static_cast<void>(atom);
  for (std::size_t k = 0; k < 3; ++k) {
    arms[0][k] = -data.cri * data.en[k];
    if (!data.is_wall) arms[1][k] = data.crj * data.en[k];
  }
#endif
  return arms;
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
  const auto [arm, other_arm] = arms_of(data, *atom);
  seen.contact = {
      triple_of(data.en), data.Fn, triple_of(on_ball.delta_F), triple_of(on_ball.delta_torque), arm,
      other_arm};
  if (!data.is_wall) {
    into.balls.push_back(seen);
    return;
  }
#ifdef NONSPHERICAL_ACTIVE_FLAG
  const Triple point = triple_of(data.contact_point);
#else
  const Triple point = minus(atom->x[data.i], data.delta);
#endif
  into.walls.push_back(
      {seen, data.fix_mesh, data.fix_mesh->triMesh()->id(data.j), triple_of(data.v_j), point});
}

constexpr int watched_surface = 41;  // of LIGGGHTS' numbers up to 63 one that is free
#ifdef SUPERQUADRIC_ACTIVE_FLAG
constexpr int surface = models::SURFACE_SUPERQUADRIC;
#else
constexpr int surface = models::SURFACE_DEFAULT;
#endif
using Style = models::GranStyle<models::HERTZ, models::TANGENTIAL_HISTORY, models::COHESION_OFF,
                                models::ROLLING_CDT, surface>;
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
