// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace millfoam::dem_driver {

/// Elastic properties of one of the two bodies of a contact.
struct Elastic {
  double youngs_modulus = 0;  ///< Pa
  double poisson_ratio = 0;   ///< in (0, 0.5)
  /// G = E/(2 (1 + nu)) of an isotropic solid, Pa.
  double shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }
};

/// What Hertz' law needs to know of two bodies that touch.
struct ContactPair {
  double modulus = 0;  ///< E*, Pa: 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2
  double radius = 0;   ///< R*, m: 1/R* = 1/R1 + 1/R2
  double mass = 0;     ///< m*, kg: 1/m* = 1/m1 + 1/m2
  /// Hertz stiffness k = 4/3 E* sqrt(R*), N/m^1.5: force = k overlap^1.5.
  double stiffness() const;
};

/// Two balls of the given diameters (m) and the same density (kg/m^3).
ContactPair ball_on_ball(double diameter1, double diameter2, double density, const Elastic& ball1,
                         const Elastic& ball2);

/// A ball on a plane wall of infinite mass.
ContactPair ball_on_wall(double diameter, double density, const Elastic& ball, const Elastic& wall);

/// Time a Rayleigh surface wave takes around half a ball: pi R sqrt(rho/G)/(0.1631 nu + 0.8766), s.
/// Y. Li, Y. Xu & C. Thornton, Powder Technol. 160 (2005) 219.
double rayleigh_time(double radius, double density, const Elastic& ball);

/// Duration of an elastic Hertz impact at `speed` (m/s): 2.9432 delta/V with delta = (5 m V^2/(4 k))^(2/5),
/// s. K. L. Johnson, Contact Mechanics (1985), eq. 11.24.
double hertz_contact_time(const ContactPair& pair, double speed);

/// Largest overlap of a damped Hertz impact at `speed` (m/s), m:
///   (0.73 + 0.27 (e - g)) (5 m V^2/(4 k))^(2/5),  g = sqrt(ln^2 e/(pi^2 + ln^2 e)),  e the restitution.
/// T. Brosh, H. Kalman & A. Levy, Particuology (2013/14).
double largest_overlap(const ContactPair& pair, double speed, double restitution);

/// How soft the balls and walls of a simulation are.
struct Stiffness {
  double modulus = 0;       ///< Pa, of the walls and of all balls that are not softened further
  double soften_below = 0;  ///< m: smaller balls have modulus (d/soften_below)^2.5; 0 for none
  /// Young's modulus of a ball of that diameter (m), Pa: Brosh's k min((d/d_threshold)^2.5, 1), with which
  /// the smallest balls allow as long a time-step as those of the threshold. T. Brosh, H. Kalman & A. Levy,
  /// Particuology (2013/14).
  double of_ball(double diameter) const;
};

}  // namespace millfoam::dem_driver
