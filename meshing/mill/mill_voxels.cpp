// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_voxels.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/rules.hpp"

namespace millfoam::meshing {
namespace {

void check_number_of_voxels(const Section& in, double across, double along, double size) {
  const double voxels = across * across * along;
  if (voxels <= most_voxels) return;
  const bool counted = in.has("counts");
  const bool usual = !counted && !in.has("voxel_size");
  in.refuse(
      counted ? "counts" : "voxel_size",
      std::string(counted ? "numbers that give" : "a length that gives") + " at most " + shown(most_voxels) +
          " voxels, not " + shown(voxels) +
          (usual ? ", as its default does, " + shown(size) + " m, which follows from the balls' diameters"
                 : std::string()));
}

}  // namespace

double axial_reach(const Geometry& geometry) {
  return geometry.length + (geometry.pulp_lifters ? geometry.pulp_lifters->depth : 0);
}

Voxels read_voxels(Section& in, const Geometry& geometry, double usual_size, int usual_along) {
  in.alternatives({"voxel_size", "counts"});
  const double length = axial_reach(geometry);
  Voxels voxels;
  double half = geometry.radius();
  if (in.has("counts")) {
    if (in.has("voxel_size")) in.refuse("voxel_size", "either voxel_size or counts");
    const Section counts = in.section("counts", {"across", "along"});
    voxels.shape[0] = counts.integer("across", whole_number("voxels across the mill", 1, most_along_axis));
    const Rule along = whole_number("voxels along the axis", 1, most_along_axis);
    voxels.shape[2] =
        usual_along > 0 ? counts.integer("along", along, usual_along) : counts.integer("along", along);
    check_number_of_voxels(in, voxels.shape[0], voxels.shape[2], 0);
  } else {
    const double size =
        in.number("voxel_size",
                  {"a length of at least a thousandth of the diameter, and up to the radius, " + shown(half) +
                       " m (or the key counts)",
                   [=](double v) { return v >= half / 500 && v <= half; }},
                  usual_size);
    voxels.shape[0] = 2 * static_cast<int>(std::ceil(half / size * (1 - 1e-9)));
    half = voxels.shape[0] * size / 2;
    const double along = usual_along > 0 ? usual_along : std::max(1.0, std::round(length / size));
    check_number_of_voxels(in, voxels.shape[0], along, size);
    voxels.shape[2] = static_cast<int>(along);
  }
  voxels.shape[1] = voxels.shape[0];
  voxels.lower = {-half, -half, 0};
  voxels.upper = {half, half, length};
  return voxels;
}

}  // namespace millfoam::meshing
