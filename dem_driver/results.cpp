// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/results.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <map>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "dem_driver/deck_outputs.hpp"
#include "dem_driver/json_file.hpp"
#include "dem_driver/record_rows.hpp"
#include "dem_driver/segments.hpp"
#include "dem_driver/time_step.hpp"
#include "dem_driver/wall_parts.hpp"
#include "meshing/files/output_file.hpp"

namespace millfoam::dem_driver {

namespace {

void expect_columns(const SegmentLine& line, std::size_t columns) {
  if (line.values.size() == columns) return;
  throw std::runtime_error(line.file.string() + ":" + std::to_string(line.line) + ": " +
                           std::to_string(line.values.size()) + " numbers, expected " +
                           std::to_string(columns));
}

long step_of(const SegmentLine& line) {
  return std::lround(line.values.front());
}

/// The rows of all segments of a kind.
std::map<long, SegmentLine> rows_by_step(const CaseFolder& folder, const std::string& kind,
                                         std::size_t columns) {
  std::map<long, SegmentLine> rows;
  for (const auto& line : read_segments(folder, kind)) {
    expect_columns(line, columns);
    rows[step_of(line)] = line;
  }
  return rows;
}

/// Throws std::runtime_error for a row whose step has no row of another kind.
[[noreturn]] void refuse_single(const SegmentLine& line, const std::string& other) {
  throw std::runtime_error(line.file.string() + ":" + std::to_string(line.line) + ": no row of step " +
                           std::to_string(step_of(line)) + " in " + other + ".*.txt, expected one");
}

template <typename Value>
std::vector<double> column(const std::vector<HistoryRow>& history, Value value) {
  std::vector<double> values;
  std::transform(history.begin(), history.end(), std::back_inserter(values), value);
  return values;
}

double resting_speed(const CaseFolder& folder, const DemPlan& plan) {
  const double mass = plan.charge.mass();
  for (const auto& line : read_segments(folder, "energy"))
    if (step_of(line) == plan.begin) return std::sqrt(2 * line.values.at(1) / mass);
  return 0;
}

/// Means of what the fluid did, over the steady part of the run.
Json fluid_of(const DemPlan& plan, const Results& results) {
  if (plan.fluid.kind == FluidKind::none) return nullptr;
  FluidRow mean;
  double rows = 0;
  for (std::size_t i = 0; i < results.fluid.size(); ++i) {
    const FluidRow& row = results.fluid[i];
    if (results.time[i] < results.steady_from()) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      mean.pressure[k] += row.pressure[k];
      mean.drag[k] += row.drag[k];
    }
    mean.power += row.power;
    mean.torque += row.torque;
    mean.balance += row.balance;
    mean.without_field += row.without_field;
    ++rows;
  }
  Json fluid = {{"kind", name_of(plan.fluid.kind)}};
  Vector force{};
  for (std::size_t k = 0; k < 3; ++k) {
    mean.pressure[k] /= rows;
    mean.drag[k] /= rows;
    force[k] = mean.pressure[k] + mean.drag[k];
  }
  fluid["force_N"] = force;
  fluid["pressure_force_N"] = mean.pressure;
  fluid["drag_force_N"] = mean.drag;
  fluid["power_W"] = mean.power / rows;
  fluid["torque_Nm"] = mean.torque / rows;
  fluid["balance_torque_Nm"] = mean.balance / rows;
  fluid["balls_without_field"] = mean.without_field / rows;
  return fluid;
}

/// Entries `part_torques_Nm` and `part_torques_error_Nm`: means of the steady part of the run.
void add_part_torques(Json& json, const Results& results) {
  Json means, errors;
  if (results.part_torques) {
    const PartTorques& found = *results.part_torques;
    const auto first = static_cast<std::size_t>(
        std::lower_bound(results.time.begin(), results.time.end(), results.steady_from()) -
        results.time.begin());
    for (std::size_t part = 0; part < found.parts.size(); ++part) {
      const SteadyMean mean = mean_since(found.torques[part], first, results.turn);
      means[found.parts[part]] = mean.mean;
      errors[found.parts[part]] = mean.standard_error;
    }
  }
  json["part_torques_Nm"] = means;
  json["part_torques_error_Nm"] = errors;
}

void write_part_torques(std::ostream& out, const Results& results) {
  const PartTorques& found = *results.part_torques;
  out << "time_s" << std::setprecision(8);
  for (const std::string& part : found.parts) out << ',' << part << "_Nm";
  out << '\n';
  for (std::size_t i = 0; i < results.time.size(); ++i) {
    out << results.time[i];
    for (const auto& torques : found.torques) out << ',' << torques[i];
    out << '\n';
  }
}

Json result_of(const meshing::Mill& mill, const DemPlan& plan, const Results& results) {
  Json json = begin_result("charge", mill);
  json["liggghts"] = results.run.liggghts;
  add_rotation(json, mill);
  add_charge(json, mill, plan.charge);
  json.update({{"lost_balls", results.balls - results.run.balls},
               {"steps", plan.total_steps()},
               {"timestep_s", plan.step.value},
               {"begin_s", plan.begin_time()},
               {"duration_s", plan.duration()},
               {"dumps", plan.dumps},
               {"modulus_Pa", plan.step.stiffness.modulus},
               {"ranks", results.run.ranks},
               {"wall_time_s", results.run.wall_time},
               {"memory_bytes", results.run.memory},
               {"steady", results.steady()},
               {"steady_from_s", results.steady_from()},
               {"power_from_s", results.time.empty() ? 0 : results.time[results.power_steadiness.begin]},
               {"power_W", results.power_steadiness.mean},
               {"power_error_W", results.power_steadiness.standard_error}});
  add_part_torques(json, results);
  json.update({{"kinetic_energy_J", results.kinetic_steadiness.mean},
               {"potential_energy_J", results.potential_steadiness.mean},
               {"ball_overlap_largest_m", results.ball_overlaps.largest},
               {"ball_overlap_99_m", results.ball_overlaps.percentile(0.99)},
               {"allowed_overlap", allowed_overlap_ratio},
               {"wall_overlap_largest_m", results.wall_overlaps.largest},
               {"wall_overlap_99_m", results.wall_overlaps.percentile(0.99)},
               {"resting_speed_m_s", results.resting_speed},
               {"fluid", fluid_of(plan, results)},
               {"contacts", results.contacts ? Json::parse(contact_entry(*results.contacts)) : Json()}});
  return json;
}

ContactResults contacts_of(const CaseFolder& folder, const Results& results) {
  const ContactOrder order = read_contact_order(folder.contact_order());
  std::vector<DriveRow> rows;
  for (std::size_t i = 0; i < results.history.size(); ++i) {
    const HistoryRow& row = results.history[i];
    const double fluid = results.fluid.empty() ? 0 : results.fluid[i].power;
    rows.push_back({row.step, results.power[i] + fluid, row.torque, row.kinetic + row.potential});
  }
  return gather_contacts(folder, order, rows, std::lround(results.steady_from() / order.timestep));
}

void write_fluid(std::ostream& out, const Results& results) {
  out << "time_s,force_x_N,force_y_N,force_z_N,pressure_x_N,pressure_y_N,pressure_z_N,drag_x_N,drag_y_N,drag_"
         "z_N,power_W,torque_Nm,balance_torque_Nm,balls_without_field\n"
      << std::setprecision(8);
  for (std::size_t i = 0; i < results.fluid.size(); ++i) {
    const FluidRow& row = results.fluid[i];
    out << results.time[i];
    for (std::size_t k = 0; k < 3; ++k) out << ',' << row.pressure[k] + row.drag[k];
    for (const Vector& part : {row.pressure, row.drag})
      for (const double component : part) out << ',' << component;
    out << ',' << row.power << ',' << row.torque << ',' << row.balance << ',' << row.without_field << '\n';
  }
}

}  // namespace

std::vector<HistoryRow> read_history(const CaseFolder& folder) {
  const auto torques = rows_by_step(folder, "torque", 2);
  auto energies = rows_by_step(folder, "energy", 3);
  // Before the run's first step there is no torque
  const auto segments = find_segments(folder, "energy");
  if (!segments.empty()) energies.erase(segments.front().step);
  std::vector<HistoryRow> history;
  for (const auto& [step, torque] : torques) {
    const auto energy = energies.find(step);
    if (energy == energies.end()) refuse_single(torque, "energy");
    history.push_back({step, torque.values[1], energy->second.values[1], energy->second.values[2]});
  }
  for (const auto& [step, energy] : energies)
    if (torques.count(step) == 0) refuse_single(energy, "torque");
  return history;
}

PartTorques read_part_torques(const CaseFolder& folder, const std::vector<std::string>& parts) {
  PartTorques found{parts, std::vector<std::vector<double>>(parts.size())};
  for (const auto& line : read_segments(folder, part_torques_kind)) {
    expect_columns(line, parts.size() + 1);
    for (std::size_t part = 0; part < parts.size(); ++part)
      found.torques[part].push_back(line.values[part + 1]);
  }
  return found;
}

OverlapStatistics read_overlaps(const CaseFolder& folder, const std::string& kind, double largest_diameter) {
  OverlapStatistics statistics;
  statistics.counts.assign(overlap_bins, 0);
  statistics.bin_width = overlap_range * largest_diameter / overlap_bins;
  const auto lines = read_segments(folder, kind, overlap_bins);
  long counted = -1;  // the last step
  for (std::size_t first = 0; first < lines.size(); first += overlap_bins + 1) {
    // step, bins, contacts within the range, contacts beyond it, least, largest
    expect_columns(lines[first], 6);
    const auto& head = lines[first].values;
    const long step = step_of(lines[first]);
    // A run that resumes may count once more the contacts of the step from which it resumes
    if (std::exchange(counted, step) == step) continue;
    if (head[2] + head[3] == 0) continue;
    statistics.samples += head[2] + head[3];
    statistics.largest = std::max(statistics.largest, head[5]);
    for (std::size_t bin = 0; bin < overlap_bins; ++bin) {
      expect_columns(lines[first + 1 + bin], 4);
      statistics.counts[bin] += lines[first + 1 + bin].values[2];
    }
  }
  return statistics;
}

double OverlapStatistics::percentile(double share) const {
  double below = 0;
  for (std::size_t bin = 0; bin < counts.size(); ++bin) {
    below += counts[bin];
    if (samples > 0 && below >= share * samples)
      return std::min(largest, static_cast<double>(bin + 1) * bin_width);
  }
  return largest;
}

bool Results::steady() const {
  return power_steadiness.steady && kinetic_steadiness.steady && potential_steadiness.steady;
}

double Results::steady_from() const {
  const std::size_t latest =
      std::max({power_steadiness.begin, kinetic_steadiness.begin, potential_steadiness.begin});
  return time.empty() ? 0 : time[latest];
}

Results gather_results(const CaseFolder& folder, const meshing::Mill& mill, const DemPlan& plan,
                       const RunResult& run) {
  Results results;
  results.run = run;
  results.balls = plan.charge.balls();
  results.resting_speed = resting_speed(folder, plan);
  results.history = read_history(folder);
  if (static_cast<long>(results.history.size()) + 1 != plan.records)
    throw RunError(folder.dem().string() + ": " + std::to_string(results.history.size()) +
                   " records of torque and energy, expected " + std::to_string(plan.records - 1));
  const std::string lost = rows_complaint(folder, plan, plan.end_step());
  if (!lost.empty()) throw RunError(lost);
  if (mill.machine() == meshing::Machine::stirred) {
    results.turn = mill.turn() / (plan.step.value * static_cast<double>(plan.step.steps_per_record));
    results.part_torques = read_part_torques(folder, find_walls(folder, mill));
    if (results.part_torques->torques.front().size() != results.history.size())
      throw RunError(folder.dem().string() + ": " +
                     std::to_string(results.part_torques->torques.front().size()) +
                     " records of the parts' torques, expected " + std::to_string(results.history.size()));
  }
  results.fluid = read_fluid_ledger(folder);
  if (plan.fluid.kind != FluidKind::none && results.fluid.size() != results.history.size())
    throw RunError(folder.dem().string() + ": " + std::to_string(results.fluid.size()) +
                   " records of the fluid, expected " + std::to_string(results.history.size()));
  results.time = column(results.history, [&](const HistoryRow& row) {
    return static_cast<double>(row.step) * plan.step.value;
  });
  results.power =
      column(results.history, [&](const HistoryRow& row) { return -row.torque * mill.angular_velocity; });
  results.power_steadiness = judge_steadiness(results.power, results.turn);
  results.kinetic_steadiness = judge_steadiness(
      column(results.history, [](const HistoryRow& row) { return row.kinetic; }), results.turn);
  results.potential_steadiness = judge_steadiness(
      column(results.history, [](const HistoryRow& row) { return row.potential; }), results.turn);
  if (plan.watches_contacts) results.contacts = contacts_of(folder, results);
  const double largest = plan.charge.classes.front().diameter;
  results.ball_overlaps = read_overlaps(folder, "ballOverlaps", largest);
  results.wall_overlaps = read_overlaps(folder, "wallOverlaps", largest);
  return results;
}

void write_results_files(const CaseFolder& folder, const meshing::Mill& mill, const DemPlan& plan,
                         const Results& results) {
  replace_file(folder.energy(), [&](std::ostream& out) {
    out << "time_s,torque_Nm,power_W,kinetic_J,potential_J\n" << std::setprecision(8);
    for (std::size_t i = 0; i < results.history.size(); ++i) {
      const HistoryRow& row = results.history[i];
      out << results.time[i] << ',' << row.torque << ',' << results.power[i] << ',' << row.kinetic << ','
          << row.potential << '\n';
    }
  });
  if (results.part_torques)
    replace_file(folder.torques(), [&](std::ostream& out) { write_part_torques(out, results); });
  if (plan.fluid.kind != FluidKind::none)
    replace_file(folder.fluid(), [&](std::ostream& out) { write_fluid(out, results); });
  if (results.contacts) write_contact_files(folder, *results.contacts);
  replace_file(folder.overlaps(), [&](std::ostream& out) {
    out << "overlap_m,ball_contacts,wall_contacts\n" << std::setprecision(8);
    for (std::size_t bin = 0; bin < overlap_bins; ++bin)
      out << (static_cast<double>(bin) + 0.5) * results.ball_overlaps.bin_width << ','
          << results.ball_overlaps.counts[bin] << ',' << results.wall_overlaps.counts[bin] << '\n';
  });
  replace_file(folder.charge(), [&](std::ostream& out) { write_charge_books(out, plan.charge); });
  write_json(folder.results(), result_of(mill, plan, results));
}

void print_results(std::ostream& out, const DemPlan& plan, const Results& results) {
  const double particle_steps = static_cast<double>(results.balls) * static_cast<double>(plan.total_steps());
  const double smallest = plan.charge.classes.back().diameter;
  const auto print_overlaps = [&](const char* what, const OverlapStatistics& overlaps) {
    if (overlaps.samples == 0) {
      out << "overlap of " << what << ": no contact was counted\n";
      return;
    }
    out << "overlap of " << what << ": 99 % below " << overlaps.percentile(0.99) * 1e6 << " um, largest "
        << overlaps.largest * 1e6 << " um, " << 100 * overlaps.largest / smallest
        << " % of the smallest diameter\n";
  };
  std::ostringstream error;
  if (std::isfinite(results.power_steadiness.standard_error))
    error << std::setprecision(3) << " +- " << results.power_steadiness.standard_error;
  out << std::setprecision(4) << "done: " << results.balls << " balls, " << results.balls - results.run.balls
      << " lost, " << plan.total_steps() << " steps of " << plan.step.value * 1e6 << " us in "
      << results.run.wall_time << " s (" << particle_steps / results.run.wall_time / 1e6
      << " million particle-steps per second)\n"
      << std::setprecision(3) << "charge at DEM time " << plan.begin_time() << ": rms speed "
      << results.resting_speed << " m/s\n"
      << "power " << results.power_steadiness.mean << error.str() << " W, kinetic energy "
      << results.kinetic_steadiness.mean << " J, potential energy " << results.potential_steadiness.mean
      << " J\n";
  if (results.steady())
    out << "steady from " << results.steady_from() << " s of DEM time on\n";
  else
    out << "NOT STEADY: power, kinetic or potential energy still change; raise dem.duration\n";
  if (results.contacts) print_contacts(out, *results.contacts);
  print_overlaps("two balls", results.ball_overlaps);
  print_overlaps("balls and walls", results.wall_overlaps);
  if (plan.dumps > 0)
    out << results.run.dumps << " dumps";
  else
    out << "no dumps (dem.dumps: no), " << plan.records << " records";
  out << ", one every " << plan.step.steps_per_record << " steps\n";
}

}  // namespace millfoam::dem_driver
