// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/mill/mill_reader.hpp"

#include <algorithm>
#include <cmath>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/materials.hpp"
#include "meshing/mill/mill_averages.hpp"
#include "meshing/mill/mill_charge.hpp"
#include "meshing/mill/mill_document.hpp"
#include "meshing/mill/mill_fingerprints.hpp"
#include "meshing/mill/mill_flow.hpp"
#include "meshing/mill/mill_geometry.hpp"
#include "meshing/mill/mill_shape.hpp"
#include "meshing/mill/opening_circles.hpp"
#include "meshing/mill/rules.hpp"
#include "meshing/mill/stirred_geometry.hpp"
#include "meshing/mill/turning_speed.hpp"
#include "meshing/mill/yaml_section.hpp"

namespace millfoam::meshing {
namespace {

/// Where mill.yaml leaves them open: the largest time-step over the Rayleigh time; the time to settle over
/// that of a fall through the mill's diameter; the turns of the dry run, of which the first brings the charge
/// into motion; records in a turn, so that a ball at the shell passes three voxels of a tenth of the radius
/// in ten of them. As in the laboratory mills of cases/mills.
constexpr double usual_rayleigh_fraction = 0.2;
constexpr double usual_settling = 1.6;
constexpr double usual_dem_turns = 3;
constexpr double records_per_turn = 500;

/// The same of a stirred mill, whose impeller turns several times a second: turns of the dry run, about 4 s
/// of a laboratory mill; records in a turn.
constexpr double usual_stirred_turns = 15;
constexpr double stirred_records_per_turn = 50;
/// Cells of a stirred mill's flow between axis and shell.
constexpr double usual_stirred_cells = 17;

/// Largest radius of curvature of a superquadric's flat sides over the radius of the sphere of equal volume.
constexpr double usual_curvature_limit = 10;

/// LIGGGHTS takes coefficients of restitution above this.
constexpr double least_restitution = 0.05;

/// A mill that turns slower takes hours for a turn; a faster one throws its charge to the shell.
constexpr double slowest_fraction = 0.001;
constexpr double fastest_fraction = 3;

double read_fraction(const Section& speed) {
  return speed.number("fraction_of_critical",
                      {"a fraction of the critical speed from " + shown(slowest_fraction) + " to " +
                           shown(fastest_fraction) + ", 0.75 for 75 % (or the key angular_velocity or rpm)",
                       [](double v) { return v >= slowest_fraction && v <= fastest_fraction; }});
}

double read_angular_velocity(Section& in, const Geometry& geometry) {
  const double critical = critical_speed(geometry);
  const double slowest = slowest_fraction * critical;
  const double fastest = fastest_fraction * critical;
  const Rule turning = {"an angular velocity in rad/s from " + shown(slowest) + " to " + shown(fastest) +
                            " (" + shown(slowest_fraction) + " to " + shown(fastest_fraction) +
                            " of the critical speed), negative for clockwise (or the key rpm)",
                        [=](double v) { return std::abs(v) >= slowest && std::abs(v) <= fastest; }};
  return read_turning_speed(in, {slowest, fastest, turning, "fraction_of_critical",
                                 [&] { return critical * read_fraction(in); }, std::nullopt});
}

Material read_material(const Section& materials, const std::string& key) {
  const Section::Keys keys = {"density", "youngs_modulus", "poisson_ratio"};
  if (!materials.has(key) || materials.is_text(key))
    return named_material(materials.name(key, material_names(), keys));
  const Section in = materials.section(key, keys);
  return {in.number("density", density()), in.number("youngs_modulus", youngs_modulus()),
          in.number("poisson_ratio", positive_below("Poisson's ratio", 0.5, "", "one half"))};
}

/// A contact by name, by its numbers, or, where the key is missing, by the names of its two materials.
Contact read_contact(const Section& materials, const std::string& key, const std::string& partner) {
  const Section::Keys keys = {"restitution", "friction", "rolling_friction"};
  const Section::Keys names = contact_names();
  if (materials.is_text(key)) return named_contact(materials.name(key, names, keys));
  if (!materials.has(key)) {
    const bool named = materials.is_text("ball") && materials.is_text(partner);
    const std::string name =
        named ? materials.text("ball", "") + "-" + materials.text(partner, "") : std::string();
    if (std::find(names.begin(), names.end(), name) != names.end()) return named_contact(name);
    materials.refuse(key, name_or_map(names, keys) + ", because no contact " +
                              (named ? "'" + name + "'" : "of these materials") + " is known");
  }
  const Section in = materials.section(key, keys);
  return {in.number("restitution",
                    {"a coefficient of restitution above " + shown(least_restitution) + " and up to 1",
                     [](double v) { return v > least_restitution && v <= 1; }}),
          in.number("friction", friction_coefficient("a friction coefficient")),
          in.number("rolling_friction", friction_coefficient("a rolling friction coefficient"))};
}

/// The modulus, or the overlap that it follows from.
void read_softness(Section& in, const Geometry& geometry, Dem& dem) {
  in.alternatives({"youngs_modulus", "largest_overlap"});
  if (in.has("youngs_modulus")) {
    if (in.has("largest_overlap")) in.refuse("largest_overlap", "either this key or youngs_modulus");
    dem.youngs_modulus = in.number("youngs_modulus", youngs_modulus());
  } else {
    dem.largest_overlap = in.number(
        "largest_overlap",
        {"a share of the diameter above 0 and up to 0.15", [](double v) { return v > 0 && v <= 0.15; }},
        default_largest_overlap);
  }
  dem.soften_below = in.number("soften_below", zero_up_to("a diameter in m", geometry.diameter), 0);
}

/// Time to fall through the mill's diameter, or through a stirred mill's height, s.
double fall_time(const Geometry& geometry) {
  return std::sqrt(2 * (geometry.impeller ? geometry.length : geometry.diameter) / gravity);
}

/// What differs for superquadrics.
void read_shapes_dem(const Section& in, Dem& dem) {
  dem.curvature_limit =
      in.number("curvature_limit", positive_up_to("a number of radii of the sphere of equal volume", 100),
                usual_curvature_limit);
  if (dem.contact_interval > 0)
    in.refuse("contact_interval", "0 for superquadrics: the readings of contacts are those of spheres");
}

/// @param charge_changed  whether --set changes the charge: then it need not fit to the keys that are here
Dem read_dem(Section& in, const Geometry& geometry, const Charge& charge, bool charge_changed, double turn) {
  Dem dem;
  read_softness(in, geometry, dem);
  dem.rayleigh_fraction = in.number(
      "rayleigh_fraction",
      {"a fraction of the Rayleigh time above 0 and up to 1", [](double v) { return v > 0 && v <= 1; }},
      usual_rayleigh_fraction);
  dem.settle_time = in.number("settle_time", time_from_zero(), usual_settling * fall_time(geometry));
  const bool stirred = geometry.impeller.has_value();
  dem.duration =
      in.number("duration", time_above_zero(), (stirred ? usual_stirred_turns : usual_dem_turns) * turn);
  const double records = stirred ? stirred_records_per_turn : records_per_turn;
  dem.record_interval =
      in.number("record_interval", part_of("duration", dem.duration), std::min(turn / records, dem.duration));
  dem.dumps = in.boolean("dumps", true);
  const Rule interval = part_of("duration", dem.duration);
  dem.contact_interval = in.number(
      "contact_interval",
      {"0 for no contacts, or " + interval.expected, [&](double v) { return v == 0 || interval.holds(v); }},
      0);
  dem.contact_statistics = in.boolean("contact_statistics", false);
  if (charge.has_shapes()) {
    read_shapes_dem(in, dem);
  } else if (in.has("curvature_limit")) {
    if (in.is_set("curvature_limit") || !charge_changed)
      in.refuse("curvature_limit", "this key with a shape in the charge only");
    in.drop("curvature_limit");
  }
  dem.seed = in.integer(
      "seed", {"a whole number from 1 to 100000", [](double v) { return v >= 1 && v <= 100000; }}, 1);
  return dem;
}

/// The level of `fluid: buoyancy`: unless given, that at which the flow begins.
std::optional<double> read_pool_level(Section& in, const Mill& mill) {
  if (in.choice("fluid", {"none", "buoyancy"}, "none") == "none") {
    if (in.has("fluid_level") && (in.is_set("fluid_level") || !in.is_set("fluid")))
      in.refuse("fluid_level", "this key with dem.fluid buoyancy only");
    in.drop("fluid_level");
    return std::nullopt;
  }
  if (mill.flow.coupling.both_ways())
    in.refuse("fluid", "none where flow.coupling is " + name_of(mill.flow.coupling.kind) +
                           ", which begins with a dry run");
  const double radius = mill.geometry.radius();
  const Rule level = {"a height in m within the radius, " + shown(radius) + " m, of the axis",
                      [=](double v) { return std::abs(v) <= radius; }};
  if (mill.flow.start.level) return in.number("fluid_level", level, *mill.flow.start.level);
  return in.number("fluid_level", level);
}

/// Honey has 10 Pa s, fresh concrete a yield stress of 1e3 Pa, liquid iron a surface tension of 1.9 N/m.
Slurry read_slurry(const Section& in) {
  return {
      in.number("density", density()),
      in.number("plastic_viscosity", positive_up_to("a viscosity in Pa s", 1e4)),
      in.number("yield_stress", zero_up_to("a stress in Pa", 1e6)),
      in.number("surface_tension", zero_up_to("a surface tension in N/m", 5), 0.07),
      in.number("viscosity_ratio",
                from_to("the largest viscosity over the plastic one,", 10, Slurry::largest_viscosity_ratio),
                drag::usual_viscosity_ratio)};
}

/// Gases reach a liquid's density and viscosity at the critical point at most.
Air read_air(const Section& in) {
  return {in.number("density", positive_up_to("a density in kg/m^3", 1000), 1.2),
          in.number("viscosity", positive_up_to("a viscosity in Pa s", 0.01), 1.8e-5)};
}

/// Makes a periodic slice of the mill: less length, no openings (but their circles in the mesh, without which
/// the whole mill's layers of the ring would not fit), and as much less charge and layers, which are equal.
void take_slice(const Section& in, Mill& mill) {
  const double longest = mill.charge.longest_way();
  const std::string words = mill.charge.has_shapes() ? "a ball's longest way through its centre, "
                                                     : "the largest ball's diameter, ";
  const double shortest = fewest_diameters_of_period * longest;
  const double whole = mill.geometry.length;
  const double slice = in.number("slice", {"a length in m of at least twice " + words + shown(shortest) +
                                               " m, and up to the mill's, " + shown(whole) + " m",
                                           [&](double v) { return v >= shortest && v <= whole; }});
  mill.is_cut = true;
  mill.geometry.length = slice;
  mill.geometry.ends = Ends::periodic;
  mill.geometry.circles_of_whole = opening_circles(mill.geometry);
  mill.geometry.inlet.reset();
  mill.geometry.grates.reset();
  mill.geometry.pulp_lifters.reset();
  for (SizeClass& size : mill.charge.classes) size.mass *= slice / whole;
  const auto layers = std::lround(mill.resolution.layers * slice / whole);
  mill.resolution.layers = std::max(1, static_cast<int>(layers));
  mill.resolution.last_layer = 0;
}

void read_materials(const Section& root, Mill& mill) {
  const Section in = root.section("materials", {"ball", "wall", "ball_ball", "ball_wall"});
  mill.ball = read_material(in, "ball");
  mill.wall = read_material(in, "wall");
  mill.ball_ball = read_contact(in, "ball_ball", "ball");
  mill.ball_wall = read_contact(in, "ball_wall", "wall");
}

void read_layers(const Section& geometry, Section& resolution, Mill& mill) {
  resolution.alternatives({"cell_size", "counts"});
  mill.resolution = read_resolution(resolution, mill.geometry, geometry.is_touched("lifters"));
  mill.whole_length = mill.geometry.length;
  mill.whole_volume = flow_volume(mill.geometry);
  if (geometry.has("slice")) take_slice(geometry, mill);
  if (mill.geometry.ends == Ends::plain && mill.resolution.layers < 2)
    resolution.refuse(
        "layers",
        "2 or more layers between two walls, or 'ends: periodic' (otherwise cells have no neighbour "
        "along the axis)");
}

/// Keys of `dem` that both machines have.
const Section::Keys dem_keys = {
    "youngs_modulus", "largest_overlap", "soften_below", "rayleigh_fraction", "settle_time",
    "duration",       "record_interval", "dumps",        "contact_interval",  "contact_statistics",
    "seed",           "curvature_limit"};

Section::Keys and_more(Section::Keys keys, const Section::Keys& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

void read_tumbling(const Section& in, Mill& mill) {
  const Section geometry = in.section(
      "geometry", {"diameter", "length", "slice", "ends", "lifters", "inlet", "grates", "pulp_lifters"});
  mill.geometry = read_geometry(geometry);
  Section speed = in.section("speed", {"fraction_of_critical", "rpm", "sense", "angular_velocity"});
  mill.angular_velocity = read_angular_velocity(speed, mill.geometry);
  read_materials(in, mill);
  mill.charge = read_charge(in.section("charge", {"classes", "reference_length", "fill", "diameter", "shape",
                                                  "packing", "fines_below", "start_radius", "start_length"}),
                            mill.geometry, mill.ball.density);
  Section dem = in.optional_section("dem", and_more(dem_keys, {"fluid", "fluid_level"}));
  mill.dem = read_dem(dem, mill.geometry, mill.charge, in.is_set("charge"), mill.turn());
  Section slurry = in.section("slurry", {"density", "plastic_viscosity", "yield_stress", "surface_tension",
                                         "viscosity_ratio", "level"});
  mill.slurry = read_slurry(slurry);
  mill.air = read_air(in.optional_section("air", {"density", "viscosity"}));
  Section resolution = in.optional_section("resolution", {"cell_size", "counts", "layers", "last_layer"});
  read_layers(geometry, resolution, mill);
  mill.averages = read_averages(in, mill);
  mill.flow = read_flow(in, slurry, mill);
  mill.dem.pool_level = read_pool_level(dem, mill);
}

/// The flow of a stirred mill; without `slurry` it has a dry run alone.
void read_stirred_flow(const Section& in, Mill& mill) {
  if (!in.has("slurry")) {
    for (const char* key : {"air", "resolution", "flow"})
      if (in.has(key)) in.refuse(key, "this key with slurry only: without it the mill has a dry run alone");
    return;
  }
  Section slurry = in.section("slurry", {"density", "plastic_viscosity", "yield_stress", "surface_tension",
                                         "viscosity_ratio", "level"});
  mill.slurry = read_slurry(slurry);
  mill.air = read_air(in.optional_section("air", {"density", "viscosity"}));
  const double radius = mill.geometry.radius();
  Section resolution = in.optional_section("resolution", {"cell_size"});
  mill.resolution.cell_size =
      resolution.number("cell_size",
                        {"a length in m from a sixtieth of the radius to a sixth of it, " +
                             shown(radius / 60) + " to " + shown(radius / 6) + " m",
                         [=](double v) { return v >= radius / 60 && v <= radius / 6; }},
                        radius / usual_stirred_cells);
  mill.flow = read_flow(in, slurry, mill);
}

void read_stirred(const Section& in, Mill& mill) {
  mill.geometry = read_stirred_geometry(in.section("geometry", {"diameter", "height", "impeller"}));
  mill.whole_length = mill.geometry.length;
  mill.whole_volume = flow_volume(mill.geometry);
  Section speed = in.section("speed", {"angular_velocity", "tip_speed", "rpm", "sense"});
  mill.angular_velocity = read_stirred_speed(speed, mill.geometry);
  read_materials(in, mill);
  mill.charge = read_stirred_charge(in.section("charge", {"classes", "level", "share", "diameter", "shape",
                                                          "packing", "fines_below", "larger_than_gap"}),
                                    mill.geometry, mill.ball.density);
  Section dem = in.optional_section("dem", dem_keys);
  mill.dem = read_dem(dem, mill.geometry, mill.charge, in.is_set("charge"), mill.turn());
  mill.averages = read_averages(in, mill);
  read_stirred_flow(in, mill);
}

Mill read_root(const Section& in, const std::string& usual_title) {
  Mill mill;
  mill.title = in.text("title", usual_title);
  if (in.choice("machine", {"tumbling", "stirred"}, "tumbling") == "stirred")
    read_stirred(in, mill);
  else
    read_tumbling(in, mill);
  return mill;
}

MillDescription describe_without_variants(const std::filesystem::path& file,
                                          const std::vector<std::string>& set) {
  const auto document = std::make_shared<MillDocument>(file, set);
  // The document has taken the variants out of its root
  const Section root(document, {"title", "geometry", "speed", "charge", "materials", "dem", "averages",
                                "slurry", "air", "resolution", "flow", "machine", "variants"});
  MillDescription description{read_root(root, file.stem().string()), document};
  try {
    if (description.mill.flow.balls) require_balls(description.mill);
  } catch (const KeyError& error) {
    throw MillError(document->place(error.key()) + ": " + error.what());
  }
  description.mill.fingerprint = fingerprints(document->keys(), description.mill);
  return description;
}

/// Throws UnknownKey for variants with paths that are no keys. Values are only checked where a variant is
/// used: some go with other changes only.
/// @param set  the changes with which the file was read; those of its variant are left out
void check_variants(const std::filesystem::path& file, const MillDocument& document,
                    std::vector<std::string> set) {
  if (!std::filesystem::is_regular_file(file)) return;  // a pipe has no second reading
  const auto is_variant = [](const std::string& change) { return change.rfind("variant=", 0) == 0; };
  set.erase(std::remove_if(set.begin(), set.end(), is_variant), set.end());
  for (const std::string& name : document.variants()) {
    std::vector<std::string> changes{"variant=" + name};
    changes.insert(changes.end(), set.begin(), set.end());
    try {
      describe_without_variants(file, changes);
    } catch (const UnknownKey&) {
      throw;
    } catch (const MillError&) {
      continue;
    }
  }
}

}  // namespace

MillDescription describe_mill(const std::filesystem::path& file, const std::vector<std::string>& set) {
  MillDescription description = describe_without_variants(file, set);
  check_variants(file, *description.document, set);
  return description;
}

Mill read_mill(const std::filesystem::path& file, const std::vector<std::string>& set) {
  return describe_mill(file, set).mill;
}

}  // namespace millfoam::meshing
