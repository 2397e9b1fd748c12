// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/dem_plan.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_error.hpp"

namespace millfoam::dem_driver {

namespace {

constexpr double longest_time_step = 1;  // s, above that of any ball
constexpr long restarts = 50;            // of a run, unless it is short
constexpr long fewest_records_per_restart = 10;
constexpr long usual_records_per_overlaps = 10;
constexpr long fewest_records_per_overlaps = 5;

/// About a fiftieth of all records, so that the run, and what was before its begin, are whole numbers of such
/// parts wherever they can be: the histograms of the overlaps are written one for each part.
long records_per_restart(long before, long records) {
  const long wished = std::min(records, std::max(fewest_records_per_restart, records / restarts));
  for (long part = wished; part <= std::min(records, 4 * wished); ++part)
    if (records % part == 0 && before % part == 0) return part;
  return wished;
}

/// What follows from begin and number of steps.
void plan_output(DemPlan& plan) {
  const long record = plan.step.steps_per_record;
  plan.thermo_steps = std::max(1L, plan.total_steps() / 200);
  plan.restart_steps = records_per_restart(plan.begin / record, plan.turning_steps / record) * record;
  plan.contact_dumps = contact_dumps_until(plan, plan.end_step());
}

/// Before any such number is made a whole one: it may be larger than a `long` holds.
void refuse_more(const char* key, double value, double count, double most, const std::string& what) {
  if (count <= most) return;
  throw meshing::KeyError(key, shown(value),
                          "at most " + shown(most) + ' ' + what + ", these are " + shown(count));
}

void check_times(const meshing::Dem& dem) {
  const std::string steps = "steps of less than " + shown(longest_time_step) + " s";
  refuse_more("dem.duration", dem.duration, dem.duration / longest_time_step, most_steps, steps);
  refuse_more("dem.record_interval", dem.record_interval, dem.duration / dem.record_interval, most_dumps,
              "dumps in " + shown(dem.duration) + " s");
}

void check_steps(const meshing::Dem& dem, double time_step) {
  const std::string steps = "steps of " + shown(time_step) + " s";
  refuse_more("dem.settle_time", dem.settle_time, dem.settle_time / time_step, most_steps, steps);
  refuse_more("dem.duration", dem.duration, dem.duration / time_step, most_steps, steps);
}

/// Time-steps between two dumps of the contacts, 0 where there are none.
long steps_between_contacts(const meshing::Mill& mill, double time_step) {
  const double interval = mill.dem.contact_interval;
  if (interval == 0) return 0;
  if (interval < time_step * (1 - 1e-9))
    throw meshing::KeyError("dem.contact_interval", shown(interval),
                            "0 or at least the time-step, " + shown(time_step) + " s");
  refuse_more("dem.contact_interval", interval, mill.dem.duration / interval, most_dumps,
              "dumps of the contacts");
  return std::lround(interval / time_step);
}

/// Of the windows that `averages.live` keeps until the run is complete: 13 numbers of each voxel and window.
double bytes_of_averages(const meshing::Mill& mill) {
  if (!mill.averages.live) return 0;
  const std::array<int, 3> shape = mill.averages.shape();
  return 13 * sizeof(double) * mill.dem.duration / mill.averages.window * shape[0] * shape[1] * shape[2];
}

}  // namespace

long DemPlan::insertions() const {
  long sum = 0;
  for (const auto& round : charge.rounds) sum += static_cast<long>(round.size());
  return sum;
}

long DemPlan::resting_steps() const {
  if (continues()) return 0;
  return insertions() + static_cast<long>(charge.rounds.size() - 1) * round_steps + settle_steps;
}

long DemPlan::total_steps() const {
  return resting_steps() + turning_steps;
}

long DemPlan::overlap_steps() const {
  const long restart = restart_steps / step.steps_per_record;
  long part = std::min(restart, usual_records_per_overlaps);
  while (restart % part != 0) --part;
  // Every record, as of 13, would cost too much
  if (part < fewest_records_per_overlaps)
    for (part = std::min(restart, usual_records_per_overlaps); restart % part != 0;) ++part;
  return part * step.steps_per_record;
}

double DemPlan::begin_time() const {
  return static_cast<double>(begin) * step.value;
}

double DemPlan::duration() const {
  return static_cast<double>(turning_steps) * step.value;
}

DemPlan plan_dem(const meshing::Mill& mill) {
  DemPlan plan;
  check_times(mill.dem);
  plan.step = choose_time_step(mill);
  check_steps(mill.dem, plan.step.value);
  plan.charge = plan_charge(mill);
  const auto whole = [](double ratio) { return std::lround(std::ceil(ratio * (1 - 1e-9))); };
  plan.round_steps = whole(plan.charge.round_settle_time / plan.step.value);
  plan.settle_steps = whole(mill.dem.settle_time / plan.step.value);
  const long records = std::max(1L, whole(mill.dem.duration / mill.dem.record_interval));
  plan.records = records + 1;
  plan.dumps = mill.dem.dumps ? plan.records : 0;
  plan.turning_steps = records * plan.step.steps_per_record;
  plan.contact_steps = steps_between_contacts(mill, plan.step.value);
  plan.fluid = fluid_of(mill);
  plan.watches_contacts = mill.dem.contact_statistics;
  plan.averages_bytes = bytes_of_averages(mill);
  plan_output(plan);
  return plan;
}

void meet_flow(const std::filesystem::path& folder, const meshing::Mill& mill, DemPlan& plan) {
  plan.fluid.kind = FluidKind::flow;
  plan.fluid.file = std::filesystem::absolute(folder);
  plan.fluid.averages = averages_in_words(mill);
  plan.fluid.shapes = shape_drag_of(mill);
  const double records = mill.flow.write_interval / mill.dem.record_interval;
  const double whole = std::round(records);
  if (!(whole >= 1) || std::abs(records - whole) > 1e-9 * whole)
    throw meshing::KeyError("flow.write_interval", shown(mill.flow.write_interval),
                            "a whole number of times dem.record_interval, " +
                                shown(mill.dem.record_interval) +
                                " s, with --with-flow: balls and flow resume at the same times");
  plan.restart_steps = std::lround(whole) * plan.step.steps_per_record;
}

void continue_from(long step, DemPlan& plan) {
  plan.begin = step;
  plan_output(plan);
}

long contact_dumps_until(const DemPlan& plan, long step) {
  if (plan.contact_steps == 0) return 0;
  return step / plan.contact_steps - (plan.begin + plan.contact_steps - 1) / plan.contact_steps + 1;
}

}  // namespace millfoam::dem_driver
