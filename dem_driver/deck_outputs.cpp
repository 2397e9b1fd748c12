// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/deck_outputs.hpp"

#include <ostream>

#include "dem_driver/wall_parts.hpp"

namespace millfoam::dem_driver {
namespace {

/// What LIGGGHTS computes of every contact. It allows one such compute for pairs of balls and one for walls,
/// so that the histograms of the overlaps and the dumps of the contacts share them.
struct ContactTable {
  const char* compute;     ///< its name in the deck
  const char* style;       ///< of the compute
  const char* properties;  ///< in the order of the columns, which does not depend on that of the request
  int columns;             ///< the last of which is the overlap
};

ContactTable ball_table(const DemPlan& plan) {
  if (plan.contact_steps == 0) return {"ballOverlaps", "pair/gran/local", "delta", 1};
  return {"ballOverlaps", "pair/gran/local", "id force torque delta", 10};
}

ContactTable wall_table(const DemPlan& plan) {
  if (plan.contact_steps == 0) return {"wallOverlaps", "wall/gran/local", "delta", 1};
  return {"wallOverlaps", "wall/gran/local", "pos vel id force torque delta", 22};
}

/// The column of a table, as LIGGGHTS calls it.
std::string column(const ContactTable& table, int number) {
  return std::string("c_") + table.compute + '[' + std::to_string(number) + ']';
}

std::string overlap_column(const ContactTable& table) {
  return column(table, table.columns);
}

/// One dump of a table of contacts, with as many digits as directions and powers need.
void write_contact_dump(std::ostream& out, const DemPlan& plan, const ContactTable& table, const char* kind) {
  out << "dump " << kind << " all local " << plan.contact_steps << " ../contacts/" << kind << ".*.txt";
  for (int number = 1; number <= table.columns; ++number) out << ' ' << column(table, number);
  out << "\ndump_modify " << kind << " format \"%.9g";
  for (int number = 2; number <= table.columns; ++number) out << " %.9g";
  out << "\"\n";
}

}  // namespace

void write_thermo(std::ostream& out, const DemPlan& plan) {
  for (const ContactTable& table : {ball_table(plan), wall_table(plan)})
    out << "compute " << table.compute << " all " << table.style << ' ' << table.properties << '\n';
  out << "compute overlap all reduce max " << overlap_column(ball_table(plan)) << "\n"
      << "thermo_style custom step atoms ke c_overlap\n"
      << "thermo_modify lost ignore norm no flush yes\nthermo " << plan.thermo_steps << '\n';
}

void write_results(std::ostream& out, const meshing::Mill& mill, const DemPlan& plan,
                   const std::vector<std::string>& parts, long start) {
  const bool stirred = mill.machine() == meshing::Machine::stirred;
  const long record = plan.step.steps_per_record;
  const long sample = plan.overlap_steps();
  const double range = overlap_range * plan.charge.classes.front().diameter;
  out << "variable torque equal 0";
  for (const auto& part : turning_parts(mill, parts)) out << "+f_" << part << "[6]";
  out << "\nfix torque all ave/time 1 " << record << ' ' << record << " v_torque file torque." << start
      << ".txt\n";
  if (stirred) {
    out << "fix " << part_torques_kind << " all ave/time 1 " << record << ' ' << record;
    for (const auto& part : parts) out << " f_" << part << "[6]";
    out << " file " << part_torques_kind << '.' << start << ".txt\n";
  }
  out << "compute kinetic all ke\nvariable height atom mass*" << meshing::gravity << '*'
      << (stirred ? 'z' : 'y') << "\ncompute potential all reduce sum v_height\n"
      << "fix energy all ave/time " << record << " 1 " << record << " c_kinetic c_potential file energy."
      << start << ".txt\n";
  for (const ContactTable& table : {ball_table(plan), wall_table(plan)})
    out << "fix " << table.compute << "Histogram all ave/histo " << sample << ' '
        << plan.restart_steps / sample << ' ' << plan.restart_steps << " 0 " << range << ' ' << overlap_bins
        << " " << overlap_column(table) << " mode vector file " << table.compute << '.' << start << ".txt\n";
}

void write_contacts(std::ostream& out, const DemPlan& plan) {
  if (plan.contact_steps == 0) return;
  out << "shell mkdir ../contacts\n";
  write_contact_dump(out, plan, ball_table(plan), "pairs");
  write_contact_dump(out, plan, wall_table(plan), "walls");
  out << "dump contactBalls all custom " << plan.contact_steps
      << " ../contacts/balls.*.txt id type x y z vx vy vz omegax omegay omegaz radius\n"
      << "dump_modify contactBalls format \"%d %d %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g\"\n";
}

void write_averages(std::ostream& out, const DemPlan& plan) {
  if (plan.averages.empty()) return;
  out << "# averages";
  for (const std::string& id : plan.averages) out << ' ' << id;
  out << ": need millLiggghts and averages.json\nfix " << averages_fix << " all external pf/callback 1 1\n";
}

void write_dumps(std::ostream& out, const DemPlan& plan) {
  if (plan.dumps == 0) return;
  out << "shell mkdir ../dumps\ndump balls all custom " << plan.step.steps_per_record
      << " ../dumps/dump.*.txt id type x y z vx vy vz radius";
  if (plan.charge.has_shapes())
    out << " shapex shapey shapez blockiness1 blockiness2 quat1 quat2 quat3 quat4";
  out << "\ndump_modify balls format \"%d %d";
  for (int number = 0; number < (plan.charge.has_shapes() ? 16 : 7); ++number) out << " %.10g";
  out << "\"\n";
}

}  // namespace millfoam::dem_driver
