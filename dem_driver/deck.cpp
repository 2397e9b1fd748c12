// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/deck.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "dem_driver/deck_outputs.hpp"
#include "dem_driver/wall_parts.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::dem_driver {

namespace {

// Constant directional torque (cdt) is what the published rolling friction coefficients of the mills belong
// to. In the 12 cm mill, epsd2 costs the same, also lets the balls come to rest and keeps the kinetic energy
// within 5 %.
constexpr char contact_model[] = "gran model hertz tangential history rolling_friction cdt";

/// The same model, of superquadrics, or such whose contacts are followed: millLiggghts adds that surface to
/// the spheres of LIGGGHTS, millLiggghtsSuperquadric to its superquadrics.
std::string model_of(const DemPlan& plan) {
  std::string model = contact_model;
  if (plan.watches_contacts)
    model += std::string(" surface ") + watched_surface_model;
  else if (plan.charge.has_shapes())
    model += " surface superquadric";
  return model;
}

/// What follows the model in its commands: of superquadrics, the radius of curvature at the contact.
std::string settings_of(const meshing::Mill& mill, const DemPlan& plan) {
  if (!plan.charge.has_shapes()) return "";
  std::ostringstream words;
  words << " curvatureLimitFactor " << mill.dem.curvature_limit << " meanCurvature yes";
  return words.str();
}

/// How the balls move.
const char* motion_of(const DemPlan& plan) {
  return plan.charge.has_shapes() ? "nve/superquadric integration_scheme 1" : "nve/sphere";
}

/// LIGGGHTS needs a different prime above 10000 for every random stream. Each seed has its own range of
/// numbers, so that two seeds have no stream in common.
class Primes {
 public:
  explicit Primes(int seed) : last_(10006 + stretch * seed) {}
  int next() {
    do {
      ++last_;
    } while (!is_prime(last_));
    return last_;
  }

 private:
  static bool is_prime(int number) {
    for (int divisor = 2; divisor <= number / divisor; ++divisor)
      if (number % divisor == 0) return false;
    return true;
  }
  static constexpr int stretch = 10007;
  int last_;
};

bool is_periodic(const meshing::Mill& mill) {
  return mill.geometry.ends == meshing::Ends::periodic;
}

bool is_stirred(const meshing::Mill& mill) {
  return mill.machine() == meshing::Machine::stirred;
}

/// The atom types of LIGGGHTS: balls of equal modulus share one, the wall has the last.
class AtomTypes {
 public:
  explicit AtomTypes(const DemPlan& plan) : stiffness_(plan.step.stiffness) {
    for (const auto& size : plan.charge.classes) {
      const double modulus = stiffness_.of_ball(size.diameter);
      if (std::find(moduli_.begin(), moduli_.end(), modulus) == moduli_.end()) moduli_.push_back(modulus);
    }
  }
  int of_ball(double diameter) const {
    const auto found = std::find(moduli_.begin(), moduli_.end(), stiffness_.of_ball(diameter));
    return 1 + static_cast<int>(found - moduli_.begin());
  }
  int wall() const { return 1 + static_cast<int>(moduli_.size()); }
  const std::vector<double>& ball_moduli() const { return moduli_; }
  double wall_modulus() const { return stiffness_.modulus; }

 private:
  Stiffness stiffness_;
  std::vector<double> moduli_;
};

void write_style(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan, int ranks) {
  const RankGrid grid = is_stirred(mill)
                            ? split_ranks_across(ranks)
                            : split_ranks(ranks, mill.geometry.length, plan.charge.classes.front().diameter);
  out << "units si\natom_style " << (plan.charge.has_shapes() ? "superquadric" : "granular")
      << "\natom_modify map array\nnewton off\ncommunicate single vel yes\n"
      << "processors " << grid.x << ' ' << grid.y << ' ' << grid.z << '\n';
}

void write_box(std::ostream& out, const meshing::Mill& mill, const AtomTypes& types) {
  // The box ends just outside the shell, so that a ball that went through a wall is soon missed and reported.
  const double margin = 0.02 * mill.geometry.diameter;
  const double half = mill.geometry.radius() + margin;
  const double z0 = is_periodic(mill) ? 0 : -margin;
  const double z1 = mill.geometry.length - z0;
  out << "boundary f f " << (is_periodic(mill) ? 'p' : 'f') << '\n'
      << "region box block " << -half << ' ' << half << ' ' << -half << ' ' << half << ' ' << z0 << ' ' << z1
      << " units box\n"
      << "create_box " << types.wall() << " box\n";
}

/// A property of every pair of types: `balls` for two balls, `wall` where one of them is the wall.
void write_matrix(std::ostream& out, const char* id, const char* property, const AtomTypes& types,
                  double balls, double wall) {
  const int count = types.wall();
  out << "fix " << id << " all property/global " << property << " peratomtypepair " << count;
  for (int first = 1; first <= count; ++first)
    for (int second = 1; second <= count; ++second)
      out << ' ' << (std::max(first, second) == count ? wall : balls);
  out << '\n';
}

/// Thickness of the layer in which neighbours are looked for ahead of time, m. A tenth of the largest ball's
/// diameter, but 0.4 to 1 of the smallest's. In the measurements (PERFORMANCE.md) that is the fastest
/// for 2 to 8 mm. For 1.25 to 10 mm it is within 5 % of the fastest, which was 1.5 times as thick. A thicker
/// layer makes longer lists of neighbours, which need memory. With walls of triangles, LIGGGHTS allows only
/// the style `bin`, and other bins than its own were slower.
double neighbour_skin(const ChargePlan& charge) {
  const double smallest = charge.classes.back().diameter;
  return std::clamp(0.1 * charge.classes.front().diameter, 0.4 * smallest, smallest);
}

void write_physics(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan,
                   const AtomTypes& types) {
  // LIGGGHTS refuses such moduli by default, because of the short time-steps that they need
  if (types.wall_modulus() > largest_soft_modulus) out << "hard_particles yes\n";
  out << "neighbor " << neighbour_skin(plan.charge) << " bin\nneigh_modify delay 0\n"
      << "fix youngs all property/global youngsModulus peratomtype";
  for (const double modulus : types.ball_moduli()) out << ' ' << modulus;
  out << ' ' << types.wall_modulus() << "\nfix poisson all property/global poissonsRatio peratomtype";
  for (std::size_t i = 0; i < types.ball_moduli().size(); ++i) out << ' ' << mill.ball.poisson_ratio;
  out << ' ' << mill.wall.poisson_ratio << '\n';
  write_matrix(out, "restitution", "coefficientRestitution", types, mill.ball_ball.restitution,
               mill.ball_wall.restitution);
  write_matrix(out, "friction", "coefficientFriction", types, mill.ball_ball.friction,
               mill.ball_wall.friction);
  write_matrix(out, "rolling", "coefficientRollingFriction", types, mill.ball_ball.rolling_friction,
               mill.ball_wall.rolling_friction);
  out << "pair_style " << model_of(plan) << settings_of(mill, plan) << "\npair_coeff * *\n"
      << "timestep " << plan.step.value << '\n'
      << "fix gravity all gravity " << meshing::gravity << " vector "
      << (is_stirred(mill) ? "0 0 -1" : "0 -1 0") << '\n';
}

void write_walls(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan,
                 const std::vector<std::string>& parts, const AtomTypes& types) {
  for (const auto& part : parts)
    out << "fix " << part << " all mesh/surface/stress file ../walls/" << part << ".stl type " << types.wall()
        << '\n';
  out << "fix walls all wall/" << model_of(plan) << " mesh n_meshes " << parts.size() << " meshes";
  for (const auto& part : parts) out << ' ' << part;
  out << settings_of(mill, plan) << '\n';
}

/// Size and shape in LIGGGHTS' words. It has one kind of balls in a run: a sphere among superquadrics is one
/// with equal half axes.
std::string form_of(const Insertion& insertion, bool superquadrics) {
  const double radius = insertion.diameter / 2;
  std::ostringstream words;
  words.precision(std::numeric_limits<double>::digits10);
  if (!superquadrics) {
    words << " radius constant " << radius;
    return words.str();
  }
  const auto shape = insertion.shape.value_or(meshing::Superquadric{{radius, radius, radius}, 2});
  words << " shape constant";
  for (const double axis : shape.half_axes) words << ' ' << axis;
  words << " blockiness constant " << shape.blockiness << ' ' << shape.blockiness;
  return words.str();
}

/// One insertion: centres in the start cylinder shrunk by the ball's radius. The number asked of
/// `insert/pack` is that of all balls then in the region, so those that are there already are counted first.
void write_insertion(std::ostream& out, const meshing::Mill& mill, const AtomTypes& types,
                     const Insertion& insertion, bool superquadrics, int number, Primes& primes) {
  const double radius = insertion.reach();
  const double length = is_periodic(mill) ? mill.geometry.length : mill.charge.start_length;
  const double z0 = (is_periodic(mill) ? 0 : mill.charge.start_bottom) + radius;
  const std::string id = std::to_string(number);
  const double core = mill.charge.start_core;
  out << "region " << (core > 0 ? "around" : "start") << id << " cylinder z 0 0 "
      << mill.charge.start_radius - radius << ' ' << z0 << ' ' << z0 + length - 2 * radius << " units box\n";
  if (core > 0)
    out << "region core" << id << " cylinder z 0 0 " << core + radius << ' ' << z0 - radius << ' '
        << z0 + length << " side out units box\n"
        << "region start" << id << " intersect 2 around" << id << " core" << id << '\n';
  out << "variable wanted equal count(all,start" << id << ")+" << insertion.count << '\n'
      << "fix ball" << id << " all particletemplate/" << (superquadrics ? "superquadric " : "sphere ")
      << primes.next() << " atom_type " << types.of_ball(insertion.diameter) << " density constant "
      << mill.ball.density << form_of(insertion, superquadrics) << '\n'
      << "fix size" << id << " all particledistribution/discrete " << primes.next() << " 1 ball" << id
      << " 1\n"
      << "fix insert" << id << " all insert/pack seed " << primes.next() << " distributiontemplate size" << id
      << " maxattempt 2000 insert_every once overlapcheck yes all_in no vel constant 0 0 0"
      << (superquadrics ? " orientation random" : "") << " region start" << id
      << " particles_in_region ${wanted}\n"
      << "run 1\n"
      << "print \"" << inserted_mark << ' ' << insertion.count << " of " << insertion.diameter
      << " total ${balls}\"\n"
      << "unfix insert" << id << "\nunfix size" << id << "\nunfix ball" << id << '\n';
}

/// What the fluid does is computed by millLiggghts, which finds the settings next to the deck.
void write_fluid(std::ostream& out, const DemPlan& plan, const char* fix) {
  if (plan.fluid.kind == FluidKind::none) return;
  out << "# " << in_words(plan.fluid) << ": needs millLiggghts and fluid.json\n"
      << "fix " << fix << " all external pf/callback 1 1\n";
}

void write_charge(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan, const AtomTypes& types) {
  Primes primes(mill.dem.seed);
  out << "variable balls equal atoms\n";
  if (plan.fluid.acts_at_rest()) write_fluid(out, plan, fluid_at_rest_fix);
  int number = 0;
  const auto& rounds = plan.charge.rounds;
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    out << "\n# round " << i + 1 << " of " << rounds.size() << '\n';
    if (i > 0) out << "unfix motion\n";
    for (const auto& insertion : rounds[i])
      write_insertion(out, mill, types, insertion, plan.charge.has_shapes(), ++number, primes);
    out << "fix motion all " << motion_of(plan) << "\nrun "
        << (i + 1 < rounds.size() ? plan.round_steps : plan.settle_steps) << '\n';
  }
}

/// From step `start` on, which is 0 or that of a restart file.
void write_turning(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan,
                   const std::vector<std::string>& parts, long start) {
  out << "print \"" << turning_mark << "\"\n";
  write_fluid(out, plan, fluid_fix);
  if (mill.angular_velocity != 0) {
    const double period = 2 * pi / std::abs(mill.angular_velocity);
    for (const auto& part : turning_parts(mill, parts))
      out << "fix turn_" << part << " all move/mesh mesh " << part << " rotate origin 0 0 0 axis 0 0 "
          << (mill.angular_velocity > 0 ? 1 : -1) << " period " << period << '\n';
  }
  write_results(out, mill, plan, parts, start);
  write_averages(out, plan);
  write_dumps(out, plan);
  // Renamed when it is complete, so that a run killed while it writes leaves no half restart file of that
  // name.
  out << "variable now equal step\n";
  write_contacts(out, plan);
  if (plan.watches_contacts) out << watch_command << '\n';
  out << "run " << plan.end_step() << " upto every " << plan.restart_steps
      << " \"write_restart restart.part\" \"shell mv restart.part restart.${now}\" \"print '" << restart_mark
      << " ${now}'\"\n"
      << "print \"" << finished_mark << "\"\n";
}

}  // namespace

int read_ranks(const std::string& word) {
  int ranks = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, ranks);
  if (error != std::errc() || stop != end || ranks < 1)
    throw std::runtime_error("-np " + word + ": expected a whole number from 1 on");
  return ranks;
}

RankGrid split_ranks(int ranks, double length, double largest_diameter) {
  assert(ranks >= 1);
  const double thinnest = 1.5 * largest_diameter;
  int z = std::clamp(static_cast<int>(length / thinnest), 1, ranks);
  while (ranks % z != 0) --z;
  const RankGrid across = split_ranks_across(ranks / z);
  return {across.x, across.y, z};
}

RankGrid split_ranks_across(int ranks) {
  int x = static_cast<int>(std::sqrt(ranks));
  while (ranks % x != 0) --x;
  return {x, ranks / x, 1};
}

void write_deck(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan,
                const std::vector<std::string>& parts, int ranks) {
  if (plan.continues()) return write_resume_deck(out, mill, plan, parts, ranks, plan.begin);
  const AtomTypes types(plan);
  out.precision(std::numeric_limits<double>::digits10);
  out << "# Written by millDem\n";
  write_style(out, mill, plan, ranks);
  write_box(out, mill, types);
  write_physics(out, mill, plan, types);
  write_walls(out, mill, plan, parts, types);
  write_thermo(out, plan);
  write_charge(out, mill, plan, types);
  if (plan.fluid.acts_at_rest()) out << "unfix " << fluid_at_rest_fix << '\n';
  // No insertion is left, so LIGGGHTS lets the clock be set back: step 0 is the start of rotation.
  out << "\nreset_timestep 0\n";
  write_turning(out, mill, plan, parts, 0);
}

void write_resume_deck(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan,
                       const std::vector<std::string>& parts, int ranks, long step) {
  const AtomTypes types(plan);
  out.precision(std::numeric_limits<double>::digits10);
  out << "# Written by millDem\n";
  write_style(out, mill, plan, ranks);
  out << "read_restart restart." << step << '\n';
  write_physics(out, mill, plan, types);
  write_walls(out, mill, plan, parts, types);
  write_thermo(out, plan);
  out << "fix motion all " << motion_of(plan) << '\n';
  write_turning(out, mill, plan, parts, step);
}

}  // namespace millfoam::dem_driver
