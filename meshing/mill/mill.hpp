// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "meshing/mill/superquadric.hpp"
#include "meshing/surface/pi.hpp"
#include "openfoam_module/drag/viscosity_ratio.hpp"

/// The description of a mill and what is made from it: its walls, the mesh of its flow, and meshes out of
/// faces. Units are SI.
namespace millfoam::meshing {

/// The ends of the mill along its axis: two plain walls, or none (a periodic slice of a long mill).
enum class Ends { plain, periodic };

/// Equally spaced lifters on the shell, whose section is a rectangle or a symmetric trapezoid. Lifter 1 is
/// centred on +x at DEM time 0.
struct Lifters {
  int count = 0;         ///< number of lifters, 0 for a smooth drum
  double height = 0;     ///< radial protrusion from the shell, m
  double width = 0;      ///< across the radius, between the feet on the shell, m
  double top_width = 0;  ///< across the radius, of the flat top, m; not above `width`
};

/// A circular opening of the feed end, centred on the axis.
struct Inlet {
  double radius = 0;  ///< m
};

/// Grates in the discharge end: a ring cut into equal sectors, the first of which begins at +x at DEM time 0,
/// each with a grate in its middle.
struct Grates {
  double inner_radius = 0;   ///< m
  double outer_radius = 0;   ///< m
  int sectors = 0;           ///< number of them around the axis
  double sector_share = 1;   ///< share of each sector's angle that is grate
  double open_fraction = 1;  ///< share of holes in the grate's area
  double pegged = 0;         ///< share of the holes that are plugged
  double open() const { return open_fraction * (1 - pegged); }  ///< share of open holes in the grate's area
};

/// Compartments behind the grates, one for each of their sectors.
struct PulpLifters {
  double depth = 0;             ///< along the axis, m
  int layers = 0;               ///< of cells along the depth
  double discharge_radius = 0;  ///< m, inside of which there are no radial walls, and the end is open
};

/// Arms of a stirred mill's impeller at one height: round pins with flat ends, equally spaced around the
/// shaft.
struct PinLevel {
  double height = 0;     ///< z of their axes, m
  double length = 0;     ///< from the tip of an arm to that of the opposite one, m: twice an arm's reach
  double thickness = 0;  ///< diameter of a pin, m
  double angle = 0;      ///< of the first arm from +x, right-handed about +z, degrees
  int arms = 2;          ///< number of them
};

/// A flat round plate of a stirred mill's impeller, which the shaft goes through.
struct Disc {
  double height = 0;     ///< z of its middle plane, m
  double diameter = 0;   ///< m
  double thickness = 0;  ///< along the axis, m
};

/// The impeller of a stirred mill: a round shaft on the axis that comes through the lid, with pins, discs or
/// both.
struct Impeller {
  double shaft_diameter = 0;     ///< m
  double shaft_end = 0;          ///< z of its lower end, m
  std::vector<PinLevel> pins;    ///< in the order of the file
  std::vector<Disc> discs = {};  ///< in the order of the file
};

/// The inside of the mill. The axis is x = y = 0; z runs from 0 at the feed end to `length`; y is up. Of a
/// stirred mill, z runs from 0 at the base to the lid and is up; the shell is at rest and the impeller turns.
struct Geometry {
  double diameter = 0;      ///< inside the shell, m
  double length = 0;        ///< along the axis, without the pulp lifters, m
  Ends ends = Ends::plain;  ///< what closes the mill at z = 0 and z = length
  Lifters lifters;          ///< those on the shell
  /// The feed end's opening; a periodic slice has none.
  std::optional<Inlet> inlet = std::nullopt;
  /// The discharge end's grates; a periodic slice has none.
  std::optional<Grates> grates = std::nullopt;
  /// Compartments behind the grates.
  std::optional<PulpLifters> pulp_lifters = std::nullopt;
  /// Of a periodic slice: the openings' circles of the whole mill, m, ascending; the slice has no openings,
  /// but the whole mill's cross-section.
  std::vector<double> circles_of_whole = {};
  /// Of a stirred mill; a tumbling mill has none.
  std::optional<Impeller> impeller = std::nullopt;
  /// Inside the shell, m.
  double radius() const { return diameter / 2; }
};

/// Balls of one diameter and shape.
struct SizeClass {
  double diameter = 0;  ///< m; of a superquadric, that of the sphere of equal volume
  double mass = 0;      ///< kg of this class in this mill (a slice: in the slice)
  /// The balls' shape; spheres have none.
  std::optional<Superquadric> shape = std::nullopt;
};

/// Twice the radius of the smallest sphere about a ball's centre that holds it, m; a sphere's diameter.
double longest_way(const SizeClass& size);

/// The dry charge: size classes in the order of the file, and the cylinder on the axis in which they are
/// released.
struct Charge {
  /// In the order of the file, fines too.
  std::vector<SizeClass> classes;
  double packing = 0.6;     ///< solidity at rest, of which the volumes of the bulk and of its pores follow
  double fines_below = 0;   ///< m: smaller balls are kept in the books, not simulated; 0 for none
  double start_radius = 0;  ///< m
  double start_length = 0;  ///< m; ignored for a periodic slice
  double start_bottom = 0;  ///< z of the cylinder's lower end, m; ignored for a periodic slice
  double start_core = 0;    ///< m, radius of the cylinder's core that is left out: the shaft; 0 for none
  bool has_shapes() const;  ///< whether not all balls are spheres
  /// Largest longest_way of its classes, m; 0 without a class.
  double longest_way() const;
};

/// Elastic solid. The modulus used by the simulation may be softer than the real one; see
/// `Dem::youngs_modulus`.
struct Material {
  double density = 0;         ///< kg/m^3
  double youngs_modulus = 0;  ///< Pa, real
  double poisson_ratio = 0;   ///< in (0, 0.5)
};

/// Contact of a pair of materials.
struct Contact {
  double restitution = 0;       ///< coefficient of restitution, in (0, 1]
  double friction = 0;          ///< sliding friction coefficient
  double rolling_friction = 0;  ///< rolling friction coefficient
};

/// How the dry run is done.
struct Dem {
  double youngs_modulus = 0;     ///< Pa, softened modulus of balls and walls; 0: it follows from the overlap
  double largest_overlap = 0;    ///< largest overlap expected over the smaller diameter; 0 with a modulus
  double soften_below = 0;       ///< m: balls smaller than this are softer still; 0 for none
  double rayleigh_fraction = 0;  ///< largest time-step over the Rayleigh time of the smallest ball
  double settle_time = 0;        ///< s the balls fall in the mill at rest, before DEM time 0
  double duration = 0;           ///< s of turning mill, from DEM time 0
  double record_interval = 0;    ///< s between records of the balls
  bool dumps = true;             ///< whether the balls of every record are dumped
  double contact_interval = 0;   ///< s between dumps of all contacts; 0: they are not dumped
  bool contact_statistics = false;  ///< whether every contact is followed in every step
  /// Of superquadrics: largest radius of curvature over the radius of the sphere of equal volume; 0 of
  /// spheres.
  double curvature_limit = 0;
  int seed = 0;  ///< of the random insertion
  /// m, height y of the surface of a pool at rest in which the balls float up; nothing: no pool.
  std::optional<double> pool_level;
};

/// A Bingham slurry. Below the shear rate tau0/((viscosity_ratio - 1) mu) it is a Newtonian liquid of its
/// largest viscosity.
struct Slurry {
  static constexpr double largest_viscosity_ratio = 1e9;  ///< that a mill may give

  double density = 0;            ///< kg/m^3
  double plastic_viscosity = 0;  ///< Pa s
  double yield_stress = 0;       ///< Pa
  double surface_tension = 0;    ///< N/m
  /// Its largest viscosity over the plastic one.
  double viscosity_ratio = drag::usual_viscosity_ratio;

  /// Shear rate below which it has no yield stress, 1/s.
  double liquid_below() const { return yield_stress / ((viscosity_ratio - 1) * plastic_viscosity); }
};

/// Air above the slurry.
struct Air {
  double density = 0;    ///< kg/m^3
  double viscosity = 0;  ///< Pa s
};

/// Numbers of cells along the sides of the cross-section's blocks (mill_mesh/cross_section.hpp).
struct BlockCounts {
  int gap = 0;          ///< along the shell between two lifters, or around a smooth drum
  int lifter = 0;       ///< along a lifter's top; 0 for a smooth drum
  int height = 0;       ///< along a lifter's side; 0 for a smooth drum
  int ring = 0;         ///< between the core and the lifters' tops, without the row that halves the columns
  bool halved = false;  ///< the core's side is an eighth of the perimeter, not a quarter
};

/// Size or numbers of the flow's cells.
struct Resolution {
  double cell_size = 0;                              ///< m, in the mill's cross-section; 0 with `counts`
  int layers = 0;                                    ///< of cells along the axis; 0 of a stirred mill
  std::optional<BlockCounts> counts = std::nullopt;  ///< instead of the size
  double last_layer = 0;                             ///< m, thickness at the discharge end; 0: all are equal
};

/// Voxels of a box whose cross-section is a square about the axis.
struct Voxels {
  std::array<double, 3> lower = {};  ///< x, y, z, m
  std::array<double, 3> upper = {};  ///< m
  std::array<int, 3> shape = {};     ///< numbers along x, y, z
};

/// Voxels of a cylinder about the axis, from the base to the lid and from the axis to the shell.
struct Rings {
  bool turning = false;  ///< with the impeller
  int radial = 0;        ///< number along r
  int azimuthal = 0;     ///< number around the axis
  int axial = 0;         ///< number along z
};

/// How the charge is averaged for the flow.
struct Averages {
  Voxels voxels;                ///< the grid of the averages
  std::optional<Rings> rings;   ///< of a stirred mill, instead of the voxels
  bool whole_run = false;       ///< one window from the start to the end of the dry run
  double window = 0;            ///< s; of the whole run: of what is known of it
  std::optional<double> start;  ///< DEM time, s; nothing: when the dry run has become steady
  std::string method;           ///< exact or sample
  int template_points = 0;      ///< along a diameter, of `sample`
  bool live = false;            ///< made by millDem while the mill turns
  /// Numbers of cells along x, y, z, or of rings along r, around the axis and along z.
  std::array<int, 3> shape() const {
    return rings ? std::array<int, 3>{rings->radial, rings->azimuthal, rings->axial} : voxels.shape;
  }
};

/// The slurry at the start of the flow: a level, or a volume.
struct FlowStart {
  std::optional<double> level;  ///< m, height y of a pool's surface
  double volume = 0;            ///< m^3, without a level; 0: the mill is empty
  double fill = 0;              ///< the volume over that of the resting charge's pores
};

/// What the flow writes on voxels of the lab frame.
struct FlowAverages {
  Voxels voxels;        ///< the grid of the averages
  double start = 0;     ///< flow time from which the mean over the run is taken, s
  double window = 0;    ///< s
  double interval = 0;  ///< between samples, s
};

/// Whether the balls feel the slurry, and how.
enum class CouplingKind {
  one_way,   ///< they do not
  iterated,  ///< balls and slurry are computed in turn until neither changes
  direct     ///< balls and slurry are computed at the same time
};

/// Whether the balls feel the slurry.
struct Coupling {
  CouplingKind kind = CouplingKind::one_way;  ///< and how
  int passes = 0;         ///< `iterated`: of balls and slurry, at most, the dry one included
  double relaxation = 0;  ///< `iterated`: share of the latest flow's forces in those that the balls feel next
  /// `direct`, of a stirred mill: of the lab frame, on which balls and slurry meet; a tumbling mill's are
  /// those of its averages.
  std::optional<Voxels> voxels;
  bool both_ways() const { return kind != CouplingKind::one_way; }  ///< whether the balls feel the slurry
};

/// "one_way", "iterated" or "direct".
std::string name_of(CouplingKind kind);

/// When a flow ends before its duration.
struct SteadyEnd {
  int turns = 0;                ///< of the mill, over which its slurry must be steady
  std::optional<double> hours;  ///< of wall time, after which it ends anyway
};

/// A tracer in the feed, for the time that slurry stays in the mill.
struct FeedTracer {
  double begin = 0;             ///< s of flow time
  std::optional<double> pulse;  ///< s for which it is fed; else to the end, a step
  double dispersion = 0;        ///< m^2/s
};

/// How the slurry's flow is done.
struct Flow {
  std::string solver;                ///< slurryFoam, or interFoam with the balls as a source of momentum
  double duration = 0;               ///< s; with a steady end, at most
  std::optional<SteadyEnd> steady;   ///< the flow ends by itself
  bool balls = true;                 ///< false: the mill without its charge
  std::string law;                   ///< drag law, a name of the table in openfoam_module/drag
  double multiplier = 1;             ///< on the drag
  std::string viscosity;             ///< of the slurry that the drag feels: plastic or pore
  std::string mixed_drag;            ///< of cells with slurry and air: weights or permeability
  bool polydispersity = false;       ///< factor on the drag for a mixture of sizes
  std::string out_of_range;          ///< beyond the recorded charge: error, hold or repeat
  FlowStart start;                   ///< slurry at time 0
  double feed = 0;                   ///< m^3/s, through the inlet
  std::optional<FeedTracer> tracer;  ///< in the feed
  double max_courant = 0;            ///< limit of the time-step: largest Courant number
  /// The same of cells at the slurry's surface.
  double max_surface_courant = 0;
  /// The same of cells with air alone.
  double max_air_courant = 0;
  /// Largest relative change of a cell's voidage in a step.
  double max_voidage_change = 0;
  double largest_correction = 0;  ///< of the balls' volume on the mesh, a share of it
  Coupling coupling;              ///< with the balls
  double max_time_step = 0;       ///< s
  double write_interval = 0;      ///< between written fields, s
  int slices = 0;                 ///< along the axis, of profiles
  /// Of the slurry.
  FlowAverages averages;
};

/// Fingerprints of the inputs of stages: hashes of those keys of the resolved mill on which a stage's result
/// depends, 16 hexadecimal digits each.
struct MillFingerprints {
  std::string walls;     ///< geometry, and what divides shell and lifters into facets
  std::string charge;    ///< walls, speed, charge, materials, and dem but for its duration
  std::string averages;  ///< charge, duration of the dry run, averages
  std::string flow;      ///< everything but the title and how often balls and flow are computed in turn
};

/// What turns: the mill about its horizontal axis, or an impeller in a vertical shell at rest.
enum class Machine { tumbling, stirred };

/// One mill, its charge, its slurry and how finely they are computed: what `mill.yaml` says, in SI units.
struct Mill {
  std::string title;        ///< for people and pictures
  Geometry geometry;        ///< walls and openings
  double whole_length = 0;  ///< m; of a slice: of the mill that it is cut from, else the length
  double whole_volume = 0;  ///< flow_volume of the same, m^3
  bool is_cut = false;      ///< whether it is a slice of a longer mill, or of all of its length
  /// rad/s, right-handed about +z: negative turns clockwise with x right and y up.
  double angular_velocity = 0;
  Charge charge;                                        ///< the balls
  Material ball;                                        ///< of all balls
  Material wall;                                        ///< of shell, lifters and ends
  Contact ball_ball;                                    ///< of two balls
  Contact ball_wall;                                    ///< of a ball and a wall
  Dem dem;                                              ///< the dry run
  Averages averages;                                    ///< of the dry run
  Slurry slurry;                                        ///< the liquid
  Air air;                                              ///< the gas
  Resolution resolution;                                ///< of the flow's mesh
  Flow flow;                                            ///< of slurry and air
  MillFingerprints fingerprint;                         ///< of the keys that this mill was read from
  bool has_flow() const { return slurry.density > 0; }  ///< a stirred mill may have a dry run alone
  Machine machine() const { return geometry.impeller ? Machine::stirred : Machine::tumbling; }  ///< its kind
  double turn() const;        ///< time of one turn, s
  const char* sense() const;  ///< clockwise or anticlockwise, seen with x to the right and y up
};

/// Gravity's magnitude used by every stage, m/s^2; it points to -y, in a stirred mill to -z.
inline constexpr double gravity = 9.81;

/// Angular speed of one turn in a minute, rad/s.
inline constexpr double turn_per_minute = 2 * pi / 60;

/// Angular speed at which a ball on the shell would centrifuge, sqrt(g/R), rad/s.
double critical_speed(const Geometry& geometry);

}  // namespace millfoam::meshing
