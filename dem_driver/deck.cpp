// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/deck.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "dem_driver/pi.hpp"

namespace millfoam::dem_driver {

namespace {

constexpr double smallest_modulus = 5e6;
// Constant directional torque (cdt) is what the published rolling friction coefficients of the mills belong
// to. In the 12 cm mill, epsd2 costs the same, comes to rest as well and keeps the kinetic energy within 5 %.
constexpr char contact_model[] = "gran model hertz tangential history rolling_friction cdt";

/// LIGGGHTS wants a different prime above 10000 for every random stream. Each seed has a stretch of numbers
/// of its own, so that two seeds have no stream in common.
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

void write_box(std::ostream& out, const meshing::Mill& mill, RankGrid ranks) {
  // The box ends just outside the shell, so that a ball that went through a wall is soon missed and reported.
  const double margin = 0.02 * mill.geometry.diameter;
  const double half = mill.geometry.radius() + margin;
  const double z0 = is_periodic(mill) ? 0 : -margin;
  const double z1 = mill.geometry.length - z0;
  out << "units si\natom_style granular\natom_modify map array\nnewton off\ncommunicate single vel yes\n"
      << "processors " << ranks.x << ' ' << ranks.y << " 1\n"
      << "boundary f f " << (is_periodic(mill) ? 'p' : 'f') << '\n'
      << "region box block " << -half << ' ' << half << ' ' << -half << ' ' << half << ' ' << z0 << ' ' << z1
      << " units box\n"
      << "create_box 2 box\n";
}

void write_matrix(std::ostream& out, const char* id, const char* property, double balls, double wall) {
  out << "fix " << id << " all property/global " << property << " peratomtypepair 2 " << balls << ' ' << wall
      << ' ' << wall << ' ' << wall << '\n';
}

void write_physics(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan) {
  const auto& smallest = plan.charge.classes.back();
  // Of skins of 0.2, 0.4 and 0.75 smallest diameters, 0.4 was the fastest while a mill with 2, 4 and 8 mm
  // balls turns.
  out << "neighbor " << 0.4 * smallest.diameter << " bin\nneigh_modify delay 0\n"
      << "fix youngs all property/global youngsModulus peratomtype " << mill.dem.youngs_modulus << ' '
      << mill.dem.youngs_modulus << '\n'
      << "fix poisson all property/global poissonsRatio peratomtype " << mill.ball.poisson_ratio << ' '
      << mill.wall.poisson_ratio << '\n';
  write_matrix(out, "restitution", "coefficientRestitution", mill.ball_ball.restitution,
               mill.ball_wall.restitution);
  write_matrix(out, "friction", "coefficientFriction", mill.ball_ball.friction, mill.ball_wall.friction);
  write_matrix(out, "rolling", "coefficientRollingFriction", mill.ball_ball.rolling_friction,
               mill.ball_wall.rolling_friction);
  out << "pair_style " << contact_model << "\npair_coeff * *\n"
      << "timestep " << plan.step.value << '\n'
      << "fix gravity all gravity " << meshing::gravity << " vector 0 -1 0\n";
}

void write_walls(std::ostream& out, const std::vector<std::string>& parts) {
  for (const auto& part : parts)
    out << "fix " << part << " all mesh/surface file ../walls/" << part << ".stl type 2\n";
  out << "fix walls all wall/" << contact_model << " mesh n_meshes " << parts.size() << " meshes";
  for (const auto& part : parts) out << ' ' << part;
  out << '\n';
}

void write_thermo(std::ostream& out, const DemPlan& plan) {
  out << "compute overlaps all pair/gran/local delta\ncompute overlap all reduce max c_overlaps[1]\n"
      << "thermo_style custom step atoms ke c_overlap\n"
      << "thermo_modify lost ignore norm no flush yes\nthermo " << plan.thermo_steps << '\n'
      << "variable balls equal atoms\n";
}

/// One insertion: centres in the start cylinder shrunk by the ball's radius. The number asked of
/// `insert/pack` is that of all balls then in the region, so those that are there already are counted first.
void write_insertion(std::ostream& out, const meshing::Mill& mill, const Insertion& insertion, int number,
                     Primes& primes) {
  const double radius = insertion.diameter / 2;
  const double length = is_periodic(mill) ? mill.geometry.length : mill.charge.start_length;
  const double z0 = (mill.geometry.length - length) / 2 + radius;
  const std::string id = std::to_string(number);
  out << "region start" << id << " cylinder z 0 0 " << mill.charge.start_radius - radius << ' ' << z0 << ' '
      << z0 + length - 2 * radius << " units box\n"
      << "variable wanted equal count(all,start" << id << ")+" << insertion.count << '\n'
      << "fix ball" << id << " all particletemplate/sphere " << primes.next()
      << " atom_type 1 density constant " << mill.ball.density << " radius constant " << radius << '\n'
      << "fix size" << id << " all particledistribution/discrete " << primes.next() << " 1 ball" << id
      << " 1\n"
      << "fix insert" << id << " all insert/pack seed " << primes.next() << " distributiontemplate size" << id
      << " maxattempt 2000 insert_every once overlapcheck yes all_in no vel constant 0 0 0 region start" << id
      << " particles_in_region ${wanted}\n"
      << "run 1\n"
      << "print \"" << inserted_mark << ' ' << insertion.count << " of " << insertion.diameter
      << " total ${balls}\"\n"
      << "unfix insert" << id << "\nunfix size" << id << "\nunfix ball" << id << '\n';
}

void write_charge(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan) {
  Primes primes(mill.dem.seed);
  int number = 0;
  const auto& rounds = plan.charge.rounds;
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    out << "\n# round " << i + 1 << " of " << rounds.size() << '\n';
    if (i > 0) out << "unfix motion\n";
    for (const auto& insertion : rounds[i]) write_insertion(out, mill, insertion, ++number, primes);
    out << "fix motion all nve/sphere\nrun " << (i + 1 < rounds.size() ? plan.round_steps : plan.settle_steps)
        << '\n';
  }
}

void write_turning(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan,
                   const std::vector<std::string>& parts) {
  // No insertion is left, so LIGGGHTS lets the clock be set back: step 0 is the start of rotation.
  out << "\nreset_timestep 0\nprint \"" << turning_mark << "\"\n";
  if (mill.angular_velocity != 0) {
    const double period = 2 * pi / std::abs(mill.angular_velocity);
    for (const auto& part : parts)
      out << "fix turn_" << part << " all move/mesh mesh " << part << " rotate origin 0 0 0 axis 0 0 "
          << (mill.angular_velocity > 0 ? 1 : -1) << " period " << period << '\n';
  }
  out << "dump balls all custom " << plan.step.steps_per_record
      << " ../dumps/dump.*.txt id type x y z vx vy vz radius\n"
      << "dump_modify balls format \"%d %d %.10g %.10g %.10g %.10g %.10g %.10g %.10g\"\n"
      << "run " << plan.turning_steps << "\nprint \"" << finished_mark << "\"\n";
}

}  // namespace

long DemPlan::insertions() const {
  long sum = 0;
  for (const auto& round : charge.rounds) sum += static_cast<long>(round.size());
  return sum;
}

long DemPlan::total_steps() const {
  return insertions() + static_cast<long>(charge.rounds.size() - 1) * round_steps + settle_steps +
         turning_steps;
}

DemPlan plan_dem(const meshing::Mill& mill) {
  DemPlan plan;
  plan.step = choose_time_step(mill);
  plan.charge = plan_charge(mill);
  const auto whole = [](double ratio) { return std::lround(std::ceil(ratio * (1 - 1e-9))); };
  plan.round_steps = whole(plan.charge.round_settle_time / plan.step.value);
  plan.settle_steps = whole(mill.dem.settle_time / plan.step.value);
  const long records = std::max(1L, whole(mill.dem.duration / mill.dem.record_interval));
  plan.dumps = records + 1;
  plan.turning_steps = records * plan.step.steps_per_record;
  plan.thermo_steps = std::max(1L, plan.total_steps() / 200);
  return plan;
}

RankGrid split_ranks(int ranks) {
  if (ranks < 1) throw std::runtime_error("-np: " + std::to_string(ranks) + ", expected at least 1 rank");
  int y = static_cast<int>(std::sqrt(ranks));
  while (ranks % y != 0) --y;
  return {ranks / y, y};
}

void write_deck(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan,
                const std::vector<std::string>& parts, int ranks) {
  if (mill.dem.youngs_modulus < smallest_modulus) {
    std::ostringstream message;
    message << "key 'dem.youngs_modulus': " << mill.dem.youngs_modulus << ", expected at least "
            << smallest_modulus << " Pa, which is the softest that LIGGGHTS accepts";
    throw std::runtime_error(message.str());
  }
  out.precision(std::numeric_limits<double>::digits10);
  out << "# Written by millDem\n";
  write_box(out, mill, split_ranks(ranks));
  write_physics(out, mill, plan);
  write_walls(out, parts);
  write_thermo(out, plan);
  write_charge(out, mill, plan);
  write_turning(out, mill, plan, parts);
}

}  // namespace millfoam::dem_driver
