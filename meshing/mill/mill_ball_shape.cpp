// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_ball_shape.hpp"

#include <algorithm>

#include "meshing/mill/rules.hpp"

namespace millfoam::meshing {
namespace {

double read_blockiness(Section& in) {
  in.alternatives({"blockiness", "roundness"});
  if (in.has("roundness")) {
    if (in.has("blockiness")) in.refuse("roundness", "either this key or blockiness, which is 2/roundness");
    const double least = 2 / most_blockiness, most = 2 / least_blockiness;
    return 2 / in.number("roundness", {"a roundness from " + shown(least) + " to " + shown(most) +
                                           ", which is that of an ellipsoid",
                                       [=](double v) { return v >= least && v <= most; }});
  }
  return in.number("blockiness",
                   {"a blockiness from " + shown(least_blockiness) + ", which is that of an ellipsoid, to " +
                        shown(most_blockiness) + " (or the key roundness)",
                    [](double v) { return v >= least_blockiness && v <= most_blockiness; }});
}

}  // namespace

std::string Room::words() const {
  return (included ? "up to " : "below ") + std::string(of) + ", " + shown(length) + unit;
}

std::optional<Superquadric> read_ball_shape(Section in, double diameter, const Room& room) {
  if (!in.has("shape")) return std::nullopt;
  if (in.is("shape", "sphere")) {
    in.drop("shape");
    return std::nullopt;
  }
  if (in.is_text("shape")) in.refuse("shape", "sphere, or a map with half_axes and blockiness or roundness");
  Section map = in.section("shape", {"half_axes", "blockiness", "roundness"});
  const auto axes = map.numbers("half_axes", 3, from_to("a length", 1e-6, 1e6));
  const Superquadric shape = scaled_to({{axes[0], axes[1], axes[2]}, read_blockiness(map)}, diameter);
  const double longest_way = 2 * bounding_radius(shape);
  if (!room.holds(longest_way))
    in.refuse("shape", "a shape whose longest way through its centre, here " + shown(longest_way) +
                           " m, is " + room.words());
  const double radius = least_radius_of_curvature(shape);
  const double least = least_curvature_share * diameter;
  if (radius < least)
    in.refuse("shape", "a shape whose least mean radius of curvature, here " + shown(radius) +
                           " m, is at least " + shown(least_curvature_share) + " of the diameter, " +
                           shown(least) + " m, which Hertz' law needs");
  return shape;
}

}  // namespace millfoam::meshing
