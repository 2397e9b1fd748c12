// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/opening_circles.hpp"
#include "meshing/mill/rules.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::meshing {
namespace {

/// Cells along a side of a block or of the mill: more make too many together.
constexpr int most_along_side = 100000;
/// Lifters or sectors: more are no wider than the balls between them.
constexpr int most_around = 1000;
/// Share of holes with which nearly nothing passes a grate.
constexpr double least_open = 0.001;

/// Where sources do not give them: height of lifters over the mill's radius; radii of the grates over the
/// radius inside the lifters and over each other; depth of pulp lifters over the mill's diameter; radius
/// inside which these release the slurry over the grates' inner radius. As chosen for the 30 cm mill of
/// cases/mills.
constexpr double usual_lifter_height = 1.0 / 15;
constexpr double usual_grate_radius = 0.93;
constexpr double usual_grate_ratio = 0.69;
constexpr double usual_pulp_depth = 0.11;
constexpr double usual_discharge_ratio = 0.52;

/// Where mill.yaml leaves the mesh open, it is one that gives a first answer in minutes: cells over the
/// mill's radius, and layers along the axis over the cells.
constexpr double usual_cell = 1.0 / 13;
constexpr double usual_layer = 2.5;

/// Growth from a layer of cells to the next: more makes profiles along the axis inaccurate.
constexpr double largest_growth = 1.5;
/// Least thickness of the last layer over that of equal ones: with less, cells are leaves.
constexpr double least_last_layer = 0.02;

/// The width of the lifters' feet, which may be that of rectangular lifters; without one, their height or
/// what their pitch leaves.
double read_width(const Section& in, const Lifters& lifters, double radius) {
  const double tip_radius = radius - lifters.height;
  const double chord = 2 * std::sqrt(radius * radius - tip_radius * tip_radius);
  const bool trapezoid = in.has("top_width");
  double pitch = 2 * radius;
  if (trapezoid && lifters.count > 1) pitch = 2 * radius * std::sin(pi / lifters.count);
  if (!trapezoid && lifters.count > 2) pitch = 2 * tip_radius * std::tan(pi / lifters.count);
  const double fallback = std::min(lifters.height, std::min(chord, pitch) / 2);
  if (chord <= pitch) {
    return in.number(
        "width",
        positive_below("a length", chord, " m", "the shell's chord at the height of the lifters' tops"),
        fallback);
  }
  return in.number("width",
                   positive_below("a length", pitch, " m",
                                  trapezoid ? "the pitch of the lifters' feet on the shell"
                                            : "the pitch of the lifters at their tops"),
                   fallback);
}

double read_top_width(const Section& in, const Lifters& lifters, double radius) {
  const double pitch =
      lifters.count > 2 ? 2 * (radius - lifters.height) * std::tan(pi / lifters.count) : 2 * radius;
  return in.number("top_width",
                   {"a length above 0, not above the width, " + shown(lifters.width) +
                        " m, and below the pitch of the lifters at their tops, " + shown(pitch) + " m",
                    [&](double v) { return v > 0 && v <= lifters.width && v < pitch; }},
                   lifters.width);
}

Lifters read_lifters(const Section& in, double radius) {
  Lifters lifters;
  lifters.count = in.integer("count", whole_number("lifters", 0, most_around));
  if (lifters.count == 0) {
    for (const char* ignored : {"height", "width", "top_width"}) {
      in.number(ignored, zero_up_to("a length in m", longest), 0);
    }
    return lifters;
  }
  lifters.height = in.number("height", positive_below("a length", radius, " m", "the radius"),
                             usual_lifter_height * radius);
  lifters.width = read_width(in, lifters, radius);
  lifters.top_width = read_top_width(in, lifters, radius);
  return lifters;
}

Inlet read_inlet(Section in, double room) {
  in.alternatives({"area", "radius"});
  const std::string inside = "the radius inside the lifters";
  if (!in.has("area")) {
    return {in.number("radius", positive_below("a length (or the key area)", room, " m", inside))};
  }
  if (in.has("radius")) in.refuse("radius", "either area or radius");
  return {std::sqrt(in.number("area", positive_below("an area", pi * room * room, " m^2",
                                                     "that of the circle inside the lifters")) /
                    pi)};
}

/// A length from the smallest circle that the mesh holds.
Rule circle(double room, double bound, const std::string& of) {
  const double smallest = smallest_circle * room;
  return {"a length of " + shown(smallest) + " m (a quarter of the radius inside the lifters) or more and " +
              of + ", " + shown(bound) + " m",
          [=](double v) { return v >= smallest && v <= bound; }};
}

Rule share(const std::string& what) {
  return {what + " above 0 and up to 1", [](double v) { return v > 0 && v <= 1; }};
}

Grates read_grates(const Section& in, double room) {
  Grates grates;
  grates.outer_radius = in.number(
      "outer_radius",
      {"a length above " + shown(smallest_circle * room) +
           " m (a quarter of the radius inside the lifters) and below that radius, " + shown(room) + " m",
       [=](double v) { return v > smallest_circle * room && v < room; }},
      usual_grate_radius * room);
  grates.inner_radius =
      in.number("inner_radius", circle(room, grates.outer_radius, "not above the outer radius"),
                std::max(usual_grate_ratio * grates.outer_radius, smallest_circle * room));
  if (grates.outer_radius - grates.inner_radius < same_circle * grates.outer_radius) {
    in.refuse("inner_radius", "a length at least 0.5 % below outer_radius");
  }
  grates.sectors = in.integer("sectors", whole_number("sectors", 1, most_around));
  grates.sector_share = in.number("sector_share", share("a share of each sector's angle"), 1);
  grates.open_fraction = in.number("open_fraction",
                                   {"a share of holes from " + shown(least_open) + " to 1",
                                    [](double v) { return v >= least_open && v <= 1; }},
                                   1);
  const double most = 1 - least_open / grates.open_fraction;
  grates.pegged = in.number("pegged",
                            {"a share of the holes of 0 or more and up to " + shown(most) +
                                 ", which leaves " + shown(least_open) + " of the grates' area open",
                             [=](double v) { return v >= 0 && v <= most; }},
                            0);
  return grates;
}

PulpLifters read_pulp_lifters(const Section& in, const Geometry& geometry, double room) {
  const double grates = geometry.grates->inner_radius;
  PulpLifters pulp;
  pulp.depth = in.number("depth", length_of_mill(), usual_pulp_depth * geometry.diameter);
  Rule layers = whole_number("layers", 2, most_along_side);
  layers.expected += " (with one, cells in corners have two neighbours only)";
  pulp.layers = in.integer("layers", layers);
  pulp.discharge_radius =
      in.number("discharge_radius", circle(room, grates, "not above the grates' inner radius"),
                std::max(usual_discharge_ratio * grates, smallest_circle * room));
  return pulp;
}

/// The openings of the ends, which only plain ends have.
void read_openings(const Section& in, Geometry& geometry) {
  for (const char* key : {"inlet", "grates", "pulp_lifters"}) {
    if (in.has(key) && geometry.ends != Ends::plain) in.refuse(key, "this key with 'ends: plain' only");
  }
  const double room = geometry.radius() - geometry.lifters.height;
  if (in.has("inlet")) geometry.inlet = read_inlet(in.section("inlet", {"area", "radius"}), room);
  if (in.has("grates")) {
    geometry.grates = read_grates(in.section("grates", {"inner_radius", "outer_radius", "sectors",
                                                        "sector_share", "open_fraction", "pegged"}),
                                  room);
  }
  if (in.has("pulp_lifters")) {
    if (!geometry.grates) in.refuse("pulp_lifters", "this key with the key grates only");
    geometry.pulp_lifters = read_pulp_lifters(
        in.section("pulp_lifters", {"depth", "layers", "discharge_radius"}), geometry, room);
  }
}

/// With fewer cells around the mill, those of a core with half of the columns are too skewed.
constexpr int fewest_to_halve = 40;

/// Whether the core's side is an eighth of the `around` cells of the perimeter, and not a quarter.
bool read_core(const Section& in, const Geometry& geometry, int around) {
  const int whole = around / 4;
  Rule core{std::to_string(whole) +
                ", a quarter of the cells around the mill (half of it with openings, and a " +
                "multiple of 8 from 40 on around)",
            [=](double cells) { return cells == whole; }};
  if (around % 8 == 0 && around >= fewest_to_halve && !opening_circles(geometry).empty()) {
    core = {std::to_string(whole) + " or " + std::to_string(whole / 2) +
                ", a quarter or an eighth of the cells around the mill",
            [=](double cells) { return cells == whole || 2 * cells == whole; }};
  }
  return in.integer("core", core) != whole;
}

/// A smooth drum has no cells at lifters. Those of a file whose lifters a change takes away are left out.
void leave_out_lifters(Section& counts, bool lifters_changed) {
  for (const char* key : {"lifter", "height"}) {
    if (!counts.has(key)) continue;
    if (!lifters_changed || counts.is_given(key))
      counts.refuse(key, "this key with geometry.lifters.count above 0 only");
    counts.integer(key, whole_number("cells", 1, most_along_side));
    counts.drop(key);
  }
}

BlockCounts read_counts(const Section& in, const Geometry& geometry) {
  const Rule cells = whole_number("cells", 1, most_along_side);
  BlockCounts counts;
  counts.gap = in.integer("gap", cells);
  if (geometry.lifters.count > 0) {
    counts.lifter = in.integer("lifter", cells);
    counts.height = in.integer("height", cells);
  }
  const double around = std::max(1, geometry.lifters.count) * (1.0 * counts.gap + counts.lifter);
  if (std::fmod(around, 4) != 0 || around < 8) {
    in.refuse("gap", "a number that makes the cells around the mill, " + shown(around) +
                         ", a multiple of four above 4");
  }
  const auto bands = opening_circles(geometry).size() + 1;
  Rule ring = whole_number("cells", static_cast<int>(bands), most_along_side);
  ring.expected += " (at least one between each two circles of the openings)";
  counts.ring = in.integer("ring", ring);
  if (in.has("core")) counts.halved = read_core(in, geometry, static_cast<int>(around));
  return counts;
}

/// Quadrilaterals of the cross-section; at most so many where the core has half of the columns.
double section_cells(const BlockCounts& counts, const Geometry& geometry) {
  const double around = std::max(1, geometry.lifters.count) * (1.0 * counts.gap + counts.lifter);
  const double inside = counts.halved ? around * around / 64 + 1.5 * around : around * around / 16;
  return inside + around * counts.ring + 1.0 * geometry.lifters.count * counts.gap * counts.height;
}

/// Layers of about 2.5 cells; between two walls at least two.
int usual_layers(const Geometry& geometry, double cell_size) {
  const int fewest = geometry.ends == Ends::plain ? 2 : 1;
  return std::max(fewest, static_cast<int>(std::lround(geometry.length / (usual_layer * cell_size))));
}

/// Thickness of the layer at the discharge end, m, if layers become thinner towards it; otherwise 0.
double read_last_layer(const Section& in, const Geometry& geometry, int layers) {
  if (!in.has("last_layer")) return 0;
  if (geometry.ends == Ends::periodic) in.refuse("last_layer", "this key with plain ends only");
  const double equal = geometry.length / layers;
  const double growing = geometry.length * (largest_growth - 1) / (std::pow(largest_growth, layers) - 1);
  const double least = std::max(growing, least_last_layer * equal);
  const std::string why =
      growing < least ? "" : " (each layer " + shown(largest_growth) + " times as thick as the next)";
  const double shown_digits = 1e-5;  // a bound is accepted as it is shown
  return in.number(
      "last_layer",
      {"a thickness in m from " + shown(least) + " m" + why + " to " + shown(equal) + " m (all equal)",
       [=](double v) { return v >= least * (1 - shown_digits) && v <= equal * (1 + shown_digits); }});
}

}  // namespace

Geometry read_geometry(const Section& in) {
  Geometry geometry;
  geometry.diameter = in.number("diameter", length_of_mill());
  geometry.length = in.number("length", length_of_mill());
  geometry.ends = in.choice("ends", {"plain", "periodic"}) == "plain" ? Ends::plain : Ends::periodic;
  geometry.lifters =
      read_lifters(in.section("lifters", {"count", "height", "width", "top_width"}), geometry.radius());
  read_openings(in, geometry);
  return geometry;
}

Resolution read_resolution(const Section& in, const Geometry& geometry, bool lifters_changed) {
  Resolution resolution;
  double section = 0;  // cells in the cross-section
  if (in.has("counts")) {
    if (in.has("cell_size")) in.refuse("cell_size", "either cell_size or counts");
    Section counts = in.section("counts", {"gap", "lifter", "height", "ring", "core"});
    if (geometry.lifters.count == 0) leave_out_lifters(counts, lifters_changed);
    resolution.counts = read_counts(counts, geometry);
    section = section_cells(*resolution.counts, geometry);
  } else {
    resolution.cell_size = in.number(
        "cell_size", positive_below("a length (or the key counts)", geometry.radius(), " m", "the radius"),
        usual_cell * geometry.radius());
    section = analytic_section(geometry) / (resolution.cell_size * resolution.cell_size);
  }
  resolution.layers = in.integer("layers", whole_number("layers", 1, most_along_side),
                                 usual_layers(geometry, shell_cell_size(resolution, geometry)));
  resolution.last_layer = read_last_layer(in, geometry, resolution.layers);
  const double cells =
      section * (resolution.layers + (geometry.pulp_lifters ? geometry.pulp_lifters->layers : 0));
  if (cells > most_cells) {
    in.refuse(resolution.counts ? "counts" : "cell_size",
              (resolution.counts ? "numbers that give" : "a length that gives") +
                  std::string(" at most 1e8 cells, not ") + shown(cells));
  }
  return resolution;
}

double shell_cell_size(const Resolution& resolution, const Geometry& geometry) {
  if (!resolution.counts) return resolution.cell_size;
  const int around =
      std::max(1, geometry.lifters.count) * (resolution.counts->gap + resolution.counts->lifter);
  return 2 * pi * geometry.radius() / around;
}

}  // namespace millfoam::meshing
