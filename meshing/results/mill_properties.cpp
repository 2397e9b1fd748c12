// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/results/mill_properties.hpp"

#include <string>

#include "meshing/files/output_file.hpp"
#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_charge.hpp"
#include "meshing/mill/resolved_mill.hpp"
#include "meshing/mill_mesh/mill_mesh.hpp"

namespace millfoam::meshing {
namespace {

/// With fewer layers a mesh is not cut along the axis for two ranks: each part would be mostly borders.
constexpr int fewest_layers_to_cut = 8;

/// Lines of an OpenFOAM dictionary.
class Entries {
 public:
  explicit Entries(std::ostream& out) : out_(out) {}

  void number(const std::string& key, double value) { word(key, exact(value)); }
  void word(const std::string& key, const std::string& value) {
    out_ << indent_ << key << ' ' << value << ";\n";
  }
  void text(const std::string& key, const std::string& value) { word(key, '"' + value + '"'); }
  void truth(const std::string& key, bool value) { word(key, value ? "yes" : "no"); }
  template <typename List>
  void list(const std::string& key, const List& values) {
    std::string words;
    for (const auto value : values) words += (words.empty() ? "" : " ") + exact(static_cast<double>(value));
    word(key, '(' + words + ')');
  }
  void open(const std::string& name) {
    out_ << name << "\n{\n";
    indent_ = "    ";
  }
  void close() {
    out_ << "}\n";
    indent_.clear();
  }

 private:
  std::ostream& out_;
  std::string indent_;
};

void write_fluids(Entries& out, const Mill& mill) {
  out.number("gravity", gravity);
  out.list("gravityVector", mill.geometry.impeller ? std::array<double, 3>{0, 0, -gravity}
                                                   : std::array<double, 3>{0, -gravity, 0});
  out.number("ballDensity", mill.ball.density);
  out.number("slurryDensity", mill.slurry.density);
  out.number("slurryViscosity", mill.slurry.plastic_viscosity);
  out.number("slurryKinematicViscosity", mill.slurry.plastic_viscosity / mill.slurry.density);
  out.number("yieldStress", mill.slurry.yield_stress);
  out.number("slurryViscosityRatio", mill.slurry.viscosity_ratio);
  out.number("surfaceTension", mill.slurry.surface_tension);
  out.number("airDensity", mill.air.density);
  out.number("airViscosity", mill.air.viscosity);
  out.number("airKinematicViscosity", mill.air.viscosity / mill.air.density);
}

void write_openings(Entries& out, const Mill& mill, const Openings& openings) {
  const Geometry& geometry = mill.geometry;
  out.truth("grates", geometry.grates.has_value());
  if (geometry.inlet) {
    out.number("inletRadius", geometry.inlet->radius);
    out.number("inletArea", openings.inlet_area);
  }
  if (geometry.grates) {
    out.number("grateInnerRadius", geometry.grates->inner_radius);
    out.number("grateOuterRadius", geometry.grates->outer_radius);
    out.number("grateArea", openings.grate_area);
    out.number("grateOpenFraction", geometry.grates->open());
  }
  out.word("emptyZones", geometry.pulp_lifters ? std::string("(") + pulp_lifters_zone + ")" : "()");
  if (geometry.pulp_lifters) {
    out.number("pulpLifterDepth", geometry.pulp_lifters->depth);
    out.number("outletRadius", geometry.pulp_lifters->discharge_radius);
    out.number("outletArea", openings.outlet_area);
  }
}

/// The walls, and those of them that are at rest while the mesh turns.
void write_walls(Entries& out, const Mill& mill) {
  const bool stirred = mill.machine() == Machine::stirred;
  out.word("wallPatches", stirred ? "(impeller shell base lid)" : "(shell lifters)");
  out.word("restingPatches", stirred ? "(shell base lid)" : "()");
}

/// The entries of slurryStartDict.
void write_start(Entries& out, const FlowStart& start) {
  out.open("slurryStart");
  if (start.level) {
    out.word("start", "pool");
    out.number("level", *start.level);
  } else if (start.volume > 0) {
    out.word("start", "pool");
    out.number("volume", start.volume);
  } else {
    out.word("start", "feed");
  }
  out.close();
}

/// The classes of balls as `((share sphericity sphericity) …)`, by volume; in random orientation the
/// crosswise sphericity is the same.
std::string shapes_of(const ChargeNumbers& charge) {
  std::string words;
  for (const ClassShape& part : class_shapes(charge)) {
    const std::string round = exact(part.sphericity);
    words += (words.empty() ? "(" : " (") + exact(part.share) + ' ' + round + ' ' + round + ')';
  }
  return words.empty() ? "((1 1 1))" : '(' + words + ')';
}

void write_flow(Entries& out, const Mill& mill) {
  const Flow& flow = mill.flow;
  out.word("flowSolver", flow.solver);
  out.number("flowDuration", flow.duration);
  out.truth("flowBalls", flow.balls);
  out.word("dragLaw", flow.law);
  out.word("dragShapes", shapes_of(count_charge(mill)));
  out.number("dragMultiplier", flow.multiplier);
  out.word("dragViscosity", flow.viscosity);
  out.truth("dragPolydispersity", flow.polydispersity);
  out.word("dragMixed", flow.mixed_drag);
  out.word("chargeOutOfRange", flow.out_of_range);
  out.number("feedRate", flow.feed);
  out.number("maxCourant", flow.max_courant);
  out.number("maxSurfaceCourant", flow.max_surface_courant);
  out.number("maxAirCourant", flow.max_air_courant);
  out.number("maxVoidageChangeOfStep", flow.max_voidage_change);
  out.number("largestCorrection", flow.largest_correction);
  out.number("maxTimeStep", flow.max_time_step);
  out.number("firstTimeStep", flow.max_time_step / 10);
  out.number("fieldsInterval", flow.write_interval);
  out.number("profileSlices", flow.slices);
  out.word("decomposeAlong", mill.resolution.layers >= fewest_layers_to_cut ? "axis" : "across");
  write_start(out, flow.start);
  out.open("slurryVoxels");
  out.list("lower", flow.averages.voxels.lower);
  out.list("upper", flow.averages.voxels.upper);
  out.list("shape", flow.averages.voxels.shape);
  out.word("periodic", mill.geometry.ends == Ends::periodic ? "(no no yes)" : "(no no no)");
  out.number("start", flow.averages.start);
  out.number("window", flow.averages.window);
  out.number("interval", flow.averages.interval);
  out.close();
  out.number("averagesInterval", flow.averages.interval);
  out.truth("tracerInFeed", flow.tracer.has_value());
  if (!flow.tracer) return;
  out.open("feedTracer");
  out.number("begin", flow.tracer->begin);
  if (flow.tracer->pulse) out.number("length", *flow.tracer->pulse);
  out.number("D", flow.tracer->dispersion);
  out.close();
}

}  // namespace

void write_mill_properties(const MillDescription& description, const Openings& openings, double time,
                           const std::filesystem::path& case_folder) {
  const Mill& mill = description.mill;
  const MillFingerprints& of = description.mill.fingerprint;
  write_file(case_folder / "constant" / "millProperties", [&](std::ostream& stream) {
    stream << "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       dictionary;\n"
              "    location    \"constant\";\n    object      millProperties;\n}\n\n";
    Entries out(stream);
    out.text("chargeFingerprint", of.charge);
    out.text("averagesFingerprint", of.averages);
    out.text("flowFingerprint", of.flow);
    out.number("radius", mill.geometry.radius());
    out.number("length", mill.geometry.length);
    out.number("lifterHeight", mill.geometry.lifters.height);
    out.word("endsType", mill.geometry.ends == Ends::plain ? "plain" : "periodic");
    out.number("omega", mill.angular_velocity);
    out.number("time0", time);
    write_fluids(out, mill);
    write_openings(out, mill, openings);
    write_walls(out, mill);
    write_flow(out, mill);
  });
}

}  // namespace millfoam::meshing
