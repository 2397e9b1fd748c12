// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/stirred_averages.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_voxels.hpp"
#include "meshing/mill/rules.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {

namespace {

/// Numbers that memory and files can hold; by default there are at most so many along the radius.
constexpr int most_rings = 1000;
constexpr int most_usual_rings = 60;

/// Half of a shell's section lies within about so much of its radius.
constexpr double middle = 2.0 / 3;

/// So that pins at right angles are cut alike.
constexpr int quarters = 4;

int number_of(double length, double size) {
  return std::clamp(static_cast<int>(std::lround(length / size)), 1, most_rings);
}

/// The usual numbers are few, so that one of the keys that is given makes them many.
void require_few_voxels(const Section& in, const Rings& rings) {
  const double voxels = 1.0 * rings.radial * rings.azimuthal * rings.axial;
  if (voxels <= most_voxels) return;
  for (const char* key : {"radial", "azimuthal", "axial"})
    if (in.has(key))
      in.refuse(key,
                "with the other two numbers at most " + shown(most_voxels) + " voxels, not " + shown(voxels));
}

}  // namespace

Rings read_rings(const Section& in, const Geometry& geometry, double diameter) {
  const double radius = geometry.radius(), size = std::max(diameter, radius / most_usual_rings);
  Rings rings;
  rings.turning = in.choice("frame", {"lab", "impeller"}, "impeller") == "impeller";
  rings.radial =
      in.integer("radial", whole_number("rings along the radius", 1, most_rings), number_of(radius, size));
  rings.azimuthal = in.integer("azimuthal", whole_number("sectors around the axis", 1, most_rings),
                               quarters * number_of(2 * pi * middle * radius / quarters, size));
  rings.axial = in.integer("axial", whole_number("layers along the axis", 1, most_rings),
                           number_of(geometry.length, size));
  require_few_voxels(in, rings);
  return rings;
}

}  // namespace millfoam::meshing
