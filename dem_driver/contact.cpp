// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/contact.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/surface/pi.hpp"

namespace millfoam::dem_driver {

namespace {

double ball_mass(double diameter, double density) {
  return density * pi / 6 * std::pow(diameter, 3);
}

double compliance(const Elastic& body) {
  return (1 - body.poisson_ratio * body.poisson_ratio) / body.youngs_modulus;
}

double elastic_overlap(const ContactPair& pair, double speed) {
  return std::pow(5 * pair.mass * speed * speed / (4 * pair.stiffness()), 0.4);
}

}  // namespace

double ContactPair::stiffness() const {
  return 4.0 / 3.0 * modulus * std::sqrt(radius);
}

ContactPair ball_on_ball(double diameter1, double diameter2, double density, const Elastic& ball1,
                         const Elastic& ball2) {
  const double mass1 = ball_mass(diameter1, density);
  const double mass2 = ball_mass(diameter2, density);
  return {1 / (compliance(ball1) + compliance(ball2)), diameter1 * diameter2 / (2 * (diameter1 + diameter2)),
          mass1 * mass2 / (mass1 + mass2)};
}

ContactPair ball_on_wall(double diameter, double density, const Elastic& ball, const Elastic& wall) {
  return {1 / (compliance(ball) + compliance(wall)), diameter / 2, ball_mass(diameter, density)};
}

double rayleigh_time(double radius, double density, const Elastic& ball) {
  return pi * radius * std::sqrt(density / ball.shear_modulus()) / (0.1631 * ball.poisson_ratio + 0.8766);
}

double hertz_contact_time(const ContactPair& pair, double speed) {
  // 2 * integral of dx/sqrt(1 - x^2.5) over [0, 1] = 4/5 sqrt(pi) Gamma(2/5)/Gamma(9/10)
  const double shape = 0.8 * std::sqrt(pi) * std::tgamma(0.4) / std::tgamma(0.9);
  return shape * elastic_overlap(pair, speed) / speed;
}

double largest_overlap(const ContactPair& pair, double speed, double restitution) {
  const double ln_e = std::log(restitution);
  const double damping = std::sqrt(ln_e * ln_e / (pi * pi + ln_e * ln_e));
  return (0.73 + 0.27 * (restitution - damping)) * elastic_overlap(pair, speed);
}

double Stiffness::of_ball(double diameter) const {
  if (soften_below <= 0) return modulus;
  return modulus * std::min(std::pow(diameter / soften_below, 2.5), 1.0);
}

}  // namespace millfoam::dem_driver
