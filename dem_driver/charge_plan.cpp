// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/charge_plan.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <ostream>
#include <string>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_charge.hpp"
#include "meshing/mill/mill_error.hpp"
#include "meshing/mill/stirred_geometry.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::dem_driver {

namespace {

constexpr double most_balls = 1e8;  // of a class: LIGGGHTS counts balls by int

double ball_volume(double diameter) {
  return pi / 6 * std::pow(diameter, 3);
}

double start_length(const meshing::Mill& mill) {
  return mill.geometry.ends == meshing::Ends::periodic ? mill.geometry.length : mill.charge.start_length;
}

std::vector<ClassCount> count_balls(const meshing::Mill& mill) {
  meshing::require_balls(mill);
  std::vector<ClassCount> classes;
  const auto counted = meshing::count_charge(mill).classes;
  for (std::size_t i = 0; i < counted.size(); ++i) {
    const auto& size = counted[i];
    if (!(static_cast<double>(size.count) <= most_balls))
      throw meshing::KeyError(meshing::key_of_class(mill, i),
                              shown(size.mass_asked) + " kg of balls of " + shown(size.diameter) +
                                  " m, which are " + shown(static_cast<double>(size.count)) + " balls",
                              "at most " + shown(most_balls) + ": raise the diameter or lower the mass");
    classes.push_back({size.diameter, size.mass_asked, size.mass, size.count, size.shape});
  }
  std::stable_sort(classes.begin(), classes.end(),
                   [](const auto& a, const auto& b) { return a.diameter > b.diameter; });
  return classes;
}

void check_fits(const meshing::Mill& mill, const std::vector<ClassCount>& classes) {
  for (const auto& size : classes) {
    const double length = 2 * Insertion{size.diameter, size.count, size.shape}.reach();
    if (length < std::min(2 * mill.charge.start_radius, start_length(mill))) continue;
    throw meshing::KeyError("charge.start_radius", shown(mill.charge.start_radius),
                            "a start cylinder (its length is " + shown(start_length(mill)) +
                                " m) in which a ball of diameter " + shown(length) + " m has room");
  }
}

/// Space of a stirred mill below the start cylinder, into which the balls fall, m^3; none of a tumbling mill,
/// whose heap lies in the cylinder.
double room_below(const meshing::Mill& mill) {
  if (!mill.geometry.impeller) return 0;
  const double bottom = mill.charge.start_bottom;
  return pi * mill.geometry.radius() * mill.geometry.radius() * bottom -
         meshing::impeller_volume(mill.geometry, bottom);
}

/// The start cylinder is too small for the balls that are left.
[[noreturn]] void refuse_start(const meshing::Mill& mill, double cylinder, long left, double diameter) {
  const std::string balls =
      std::to_string(left) + " of " + shown(diameter) + " m and all smaller ones are left over";
  if (mill.geometry.impeller)
    throw meshing::KeyError("charge", shown(cylinder) + " m^3 above the impeller, where balls are released",
                            "more room there, or fewer balls: " + balls + "; raise geometry.height");
  const double room = mill.geometry.radius() - mill.geometry.lifters.height;
  std::string remedies = "; take fewer balls (charge.fill or charge.classes)";
  if (mill.geometry.ends == meshing::Ends::plain &&
      mill.charge.start_length < mill.geometry.length * (1 - 1e-9))
    remedies += ", or a longer charge.start_length, up to " + shown(mill.geometry.length) + " m";
  // The default leaves the radius of the largest ball
  if (mill.charge.start_radius < room - mill.charge.longest_way() / 2 * (1 + 1e-9))
    remedies += ", or a larger charge.start_radius, up to " + shown(room) + " m";
  throw meshing::KeyError("charge.start_radius", shown(mill.charge.start_radius),
                          "a start cylinder (its volume is " + shown(cylinder) +
                              " m^3) in which all balls have room: " + balls + remedies);
}

/// Cuts the classes, largest first, into rounds whose volume the free part of the start cylinder can take.
std::vector<Round> cut_into_rounds(const meshing::Mill& mill, const std::vector<ClassCount>& classes) {
  const double radius = mill.charge.start_radius, core = mill.charge.start_core;
  const double cylinder = pi * (radius * radius - core * core) * start_length(mill);
  std::vector<Round> rounds;
  double inside = 0;
  double room = round_solidity * cylinder;
  rounds.emplace_back();
  for (const auto& size : classes) {
    // A superquadric is inserted as the sphere around it
    const double taken = ball_volume(2 * Insertion{size.diameter, size.count, size.shape}.reach());
    long left = size.count;
    while (left > 0) {
      const long now = std::min(left, static_cast<long>(room / taken));
      if (now > 0) rounds.back().push_back({size.diameter, now, size.shape});
      left -= now;
      inside += static_cast<double>(now) * ball_volume(size.diameter);
      room -= static_cast<double>(now) * taken;
      if (left == 0) break;
      room = round_solidity * (cylinder - std::max(inside / heap_solidity - room_below(mill), 0.0));
      // Below this, a round would insert almost nothing, and the number of rounds would have no limit.
      if (room < taken || room < 0.005 * cylinder) refuse_start(mill, cylinder, left, size.diameter);
      rounds.emplace_back();
    }
  }
  return rounds;
}

}  // namespace

double ClassCount::surface() const {
  return static_cast<double>(count) * (shape ? meshing::surface(*shape) : pi * diameter * diameter);
}

double Insertion::reach() const {
  return shape ? meshing::bounding_radius(*shape) : diameter / 2;
}

bool ChargePlan::has_shapes() const {
  return std::any_of(classes.begin(), classes.end(),
                     [](const ClassCount& size) { return size.shape.has_value(); });
}

long ChargePlan::balls() const {
  long sum = 0;
  for (const auto& size : classes) sum += size.count;
  return sum;
}

double ChargePlan::mass() const {
  double sum = 0;
  for (const auto& size : classes) sum += size.mass_realised;
  return sum;
}

double ChargePlan::fines_mass() const {
  double sum = 0;
  for (const auto& size : fines) sum += size.mass_asked;
  return sum;
}

double ChargePlan::asked_mass() const {
  double sum = fines_mass();
  for (const auto& size : classes) sum += size.mass_asked;
  return sum;
}

ChargePlan plan_charge(const meshing::Mill& mill) {
  ChargePlan plan;
  for (const auto& size : count_balls(mill))
    (size.diameter < mill.charge.fines_below ? plan.fines : plan.classes).push_back(size);
  assert(!plan.classes.empty());
  check_fits(mill, plan.classes);
  const double radius = mill.charge.start_radius;
  plan.rounds = cut_into_rounds(mill, plan.classes);
  // Half as long again as a free fall through the start cylinder, or from a stirred mill's lid.
  const double fall = mill.geometry.impeller ? mill.geometry.length : 2 * radius;
  plan.round_settle_time = 1.5 * std::sqrt(2 * fall / meshing::gravity);
  return plan;
}

namespace {

/// One line for each class of superquadrics.
void print_shapes(std::ostream& out, const ChargePlan& plan) {
  for (const auto& size : plan.classes) {
    if (!size.shape) continue;
    const auto& [a, b, c] = size.shape->half_axes;
    out << std::setprecision(4) << "  superquadrics, " << size.count << " balls: half axes " << a * 1e3 << ' '
        << b * 1e3 << ' ' << c * 1e3 << " mm, blockiness " << size.shape->blockiness << ", sphericity "
        << meshing::sphericity(*size.shape) << ", least radius of curvature "
        << 1e3 * meshing::least_radius_of_curvature(*size.shape) << " mm\n";
  }
}

}  // namespace

void print_charge(std::ostream& out, const ChargePlan& plan) {
  out << "charge: " << plan.balls() << " balls, inserted largest first in " << plan.rounds.size()
      << " round(s)\n"
      << "  diameter mm     balls   requested kg   realised kg   difference %\n";
  double asked = 0;
  for (const auto& size : plan.classes) {
    asked += size.mass_asked;
    out << std::setw(13) << std::setprecision(4) << size.diameter * 1e3 << std::setw(10) << size.count
        << std::setw(15) << size.mass_asked << std::setw(14) << size.mass_realised << std::setw(15)
        << std::setprecision(2) << 100 * (size.mass_realised / size.mass_asked - 1) << '\n';
  }
  out << "        total" << std::setw(10) << plan.balls() << std::setw(15) << std::setprecision(4) << asked
      << std::setw(14) << plan.mass() << std::setw(15) << std::setprecision(2)
      << 100 * (plan.mass() / asked - 1) << '\n';
  print_shapes(out, plan);
  for (const auto& size : plan.fines)
    out << "  fines, not simulated: " << std::setprecision(4) << size.diameter * 1e3 << " mm, " << size.count
        << " balls, " << size.mass_realised << " kg, " << size.surface() << " m^2\n";
}

void write_charge_books(std::ostream& out, const ChargePlan& plan) {
  out << "diameter_m,balls,mass_kg,surface_m2,simulated\n" << std::setprecision(10);
  const auto write = [&](const ClassCount& size, int simulated) {
    out << size.diameter << ',' << size.count << ',' << size.mass_realised << ',' << size.surface() << ','
        << simulated << '\n';
  };
  for (const auto& size : plan.classes) write(size, 1);
  for (const auto& size : plan.fines) write(size, 0);
}

}  // namespace millfoam::dem_driver
