// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/contact_results.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <ostream>
#include <stdexcept>
#include <string>

#include "dem_driver/contact_record.hpp"
#include "dem_driver/json_file.hpp"
#include "dem_driver/segments.hpp"
#include "dem_driver/wall_forces_file.hpp"
#include "meshing/files/output_file.hpp"
#include "meshing/files/text_numbers.hpp"

namespace millfoam::dem_driver {

namespace {

[[noreturn]] void refuse(const SegmentLine& line, const std::string& expected) {
  throw std::runtime_error(line.file.string() + ":" + std::to_string(line.line) + ": expected " + expected);
}

/// A whole number of a line from 0 up to below `end`.
std::size_t index_in(const SegmentLine& line, std::size_t word, std::size_t end, const char* what) {
  const double value = line.values[word];
  if (!(value >= 0 && value < static_cast<double>(end)))
    refuse(line, std::string(what) + " below " + std::to_string(end));
  return static_cast<std::size_t>(value);
}

void expect_numbers(const SegmentLine& line, std::size_t numbers) {
  if (line.values.size() != numbers) refuse(line, std::to_string(numbers) + " numbers");
}

long step_of(const SegmentLine& line) {
  return std::lround(line.values.front());
}

/// The bodies of a kind: diameters, m, 0 of a wall; number of the wall, -1 of two balls.
std::string bodies_of(int kind, const ContactOrder& order) {
  const auto [first, second] = order.kinds().bodies(kind);
  const auto diameter = [&](int of) { return shown(order.diameters[static_cast<std::size_t>(of)]); };
  if (second < 0) return diameter(first) + ",0," + std::to_string(-1 - second);
  return diameter(first) + ',' + diameter(second) + ",-1";
}

void write_work(std::ostream& out, const ContactWork& work, double time) {
  out << ',' << work.normal / time << ',' << work.tangential / time << ',' << work.rolling / time;
}

bool is_nothing(const ContactWork& work) {
  return work.normal == 0 && work.tangential == 0 && work.rolling == 0;
}

void write_power(std::ostream& out, const std::vector<ContactBlock>& blocks, const ContactOrder& order) {
  out << "begin_s,end_s,first_m,second_m,wall,normal_W,tangential_W,rolling_W\n" << std::setprecision(8);
  for (const ContactBlock& block : blocks)
    for (int kind = 0; kind < order.kinds().size(); ++kind) {
      const ContactWork work = block.sums.of(kind).work;
      if (is_nothing(work)) continue;
      out << static_cast<double>(block.step - block.steps) * order.timestep << ','
          << static_cast<double>(block.step) * order.timestep << ',' << bodies_of(kind, order);
      write_work(out, work, static_cast<double>(block.steps) * order.timestep);
      out << '\n';
    }
}

void write_spectra(std::ostream& out, const ContactSpan& span, const ContactOrder& order) {
  const double time = static_cast<double>(span.end - span.begin) * order.timestep;
  out << "first_m,second_m,wall,energy_from_J,energy_to_J,touches_per_s,collisions_per_s,normal_W,tangential_"
         "W,rolling_"
         "W\n"
      << std::setprecision(8);
  for (int kind = 0; kind < order.kinds().size(); ++kind) {
    const KindSums sums = span.sums.of(kind);
    for (int bin = 0; bin < energy_bins; ++bin) {
      const BinSums& in = sums.bins[static_cast<std::size_t>(bin)];
      if (in.touches == 0 && in.collisions == 0) continue;
      out << bodies_of(kind, order) << ',' << (bin == 0 ? "-inf" : shown(energy_edge(bin - 1))) << ','
          << (bin == energy_edges ? "inf" : shown(energy_edge(bin))) << ',' << in.touches / time << ','
          << in.collisions / time;
      write_work(out, in.work, time);
      out << '\n';
    }
  }
}

ContactWork work_of_all(const ContactSums& sums, const ContactKinds& kinds) {
  ContactWork all;
  for (int kind = 0; kind < kinds.size(); ++kind) all += sums.of(kind).work;
  return all;
}

/// Power of contacts between balls (entry `balls`) and at each part of the walls.
Json powers_of(const ContactSpan& span, const ContactOrder& order) {
  const double time = static_cast<double>(span.end - span.begin) * order.timestep;
  std::map<std::string, ContactWork> works;
  for (int kind = 0; kind < order.kinds().size(); ++kind) {
    const int second = order.kinds().bodies(kind).second;
    works[second < 0 ? order.parts[static_cast<std::size_t>(-1 - second)] : "balls"] +=
        span.sums.of(kind).work;
  }
  Json powers;
  for (const auto& [name, work] : works)
    powers[name] = {{"normal_W", work.normal / time},
                    {"tangential_W", work.tangential / time},
                    {"rolling_W", work.rolling / time}};
  return powers;
}

double energy_at(const std::vector<DriveRow>& rows, long step) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const DriveRow& r) { return r.step == step; });
  if (row == rows.end())
    throw std::runtime_error("contacts: no record of energies at step " + std::to_string(step));
  return row->energy;
}

}  // namespace

std::vector<ContactBlock> read_contact_blocks(const CaseFolder& folder, const ContactOrder& order) {
  const ContactKinds kinds = order.kinds();
  const auto count = static_cast<std::size_t>(kinds.size());
  std::map<long, ContactBlock> blocks;
  for (const auto& line : read_segments(folder, contact_work_kind)) {
    expect_numbers(line, 7);
    const auto& v = line.values;
    const long step = step_of(line);
    auto& block = blocks.try_emplace(step, ContactBlock{step, std::lround(v[1]), v[2], ContactSums(kinds)})
                      .first->second;
    block.sums.add_work(static_cast<int>(index_in(line, 3, count, "a kind")), {v[4], v[5], v[6]});
  }
  for (const auto& line : read_segments(folder, contact_bins_kind)) {
    expect_numbers(line, 8);
    const auto block = blocks.find(step_of(line));
    if (block == blocks.end()) refuse(line, "a step that the contacts' work has");
    const std::size_t kind = index_in(line, 1, count, "a kind");
    const std::size_t bin = index_in(line, 2, energy_bins, "a bin");
    double* at = block->second.sums.numbers.data() + kind * ContactSums::numbers_per_kind + 3 +
                 bin * ContactSums::numbers_per_bin;
    for (std::size_t k = 0; k < ContactSums::numbers_per_bin; ++k) at[k] += line.values[3 + k];
  }
  std::vector<ContactBlock> ordered;
  ordered.reserve(blocks.size());
  for (auto& [step, block] : blocks) ordered.push_back(std::move(block));
  return ordered;
}

ContactSpan sum_blocks(const std::vector<ContactBlock>& blocks, const ContactOrder& order, long from) {
  if (blocks.empty()) throw std::runtime_error("contacts: millLiggghts has written no block of them");
  std::size_t first = blocks.size() > 1 ? 1 : 0;
  while (first + 1 < blocks.size() && blocks[first].step - blocks[first].steps < from) ++first;
  ContactSpan span{blocks[first].step - blocks[first].steps, blocks.back().step, 0,
                   ContactSums(order.kinds())};
  if (first > 0) span.spin_gain = blocks.back().spin - blocks[first - 1].spin;
  for (std::size_t i = first; i < blocks.size(); ++i)
    for (std::size_t k = 0; k < span.sums.numbers.size(); ++k)
      span.sums.numbers[k] += blocks[i].sums.numbers[k];
  return span;
}

ContactBalance balance_of(const ContactSpan& span, const ContactOrder& order,
                          const std::vector<DriveRow>& rows) {
  ContactBalance balance;
  const double time = static_cast<double>(span.end - span.begin) * order.timestep;
  const ContactWork work = work_of_all(span.sums, order.kinds());
  balance.power = {work.normal / time, work.tangential / time, work.rolling / time};
  double counted = 0;
  for (const DriveRow& row : rows) {
    if (row.step <= span.begin || row.step > span.end) continue;
    balance.drive += row.power;
    balance.torque += row.torque;
    ++counted;
  }
  if (counted == 0)
    throw std::runtime_error("contacts: no record of power after step " + std::to_string(span.begin));
  balance.drive /= counted;
  balance.torque /= counted;
  // The energy before the first row is not known
  const long begin = std::max(span.begin, rows.front().step);
  const double known = static_cast<double>(span.end - begin) * order.timestep;
  balance.gain = span.spin_gain / time;
  if (known > 0) balance.gain += (energy_at(rows, span.end) - energy_at(rows, begin)) / known;
  return balance;
}

WallSpan read_wall_span(const CaseFolder& folder, const WallCells& cells, long from) {
  WallSpan span{0, 0, WallSums(cells.size())};
  const auto lines = read_segments(folder, wall_cells_kind);
  if (lines.empty()) throw std::runtime_error("contacts: millLiggghts has written no record of the walls");
  const long last = step_of(lines.back());
  span.begin = span.end = last;
  for (const auto& line : lines) {
    expect_numbers(line, 3 + numbers_per_wall_cell);
    const long step = step_of(line), begin = step - std::lround(line.values[1]);
    if (begin < from && step != last) continue;
    span.begin = std::min(span.begin, begin);
    span.sums.add(index_in(line, 2, cells.size(), "a cell"), line.values.data() + 3);
  }
  return span;
}

double ContactResults::time() const {
  return static_cast<double>(span.end - span.begin) * order.timestep;
}

double ContactResults::collisions_per_second() const {
  double touches = 0;
  for (int kind = 0; kind < order.kinds().size(); ++kind)
    for (const BinSums& bin : span.sums.of(kind).bins) touches += bin.touches;
  return touches / time();
}

double ContactResults::wall_torque() const {
  const std::vector<int> parts = order.cells().part_of_cells();
  double moment = 0;
  for (std::size_t cell = 0; cell < parts.size(); ++cell)
    if (order.turns(static_cast<std::size_t>(parts[cell]))) moment += walls.sums.of(cell).moment;
  return moment / static_cast<double>(walls.end - walls.begin);
}

ContactResults gather_contacts(const CaseFolder& folder, const ContactOrder& order,
                               const std::vector<DriveRow>& rows, long from) {
  auto blocks = read_contact_blocks(folder, order);
  auto span = sum_blocks(blocks, order, from);
  const ContactBalance balance = balance_of(span, order, rows);
  return {order, std::move(blocks), std::move(span), balance, read_wall_span(folder, order.cells(), from)};
}

void write_contact_files(const CaseFolder& folder, const ContactResults& contacts) {
  const ContactOrder& order = contacts.order;
  replace_file(folder.contact_power(), [&](std::ostream& out) { write_power(out, contacts.blocks, order); });
  replace_file(folder.contact_spectra(),
               [&](std::ostream& out) { write_spectra(out, contacts.span, order); });
  replace_file(folder.wall_forces(), [&](std::ostream& out) {
    write_wall_forces(out, order.cells(), contacts.walls.sums, contacts.walls.begin, contacts.walls.end,
                      order.timestep);
  });
}

std::string contact_entry(const ContactResults& contacts) {
  const double timestep = contacts.order.timestep;
  const Json json = {{"begin_s", static_cast<double>(contacts.span.begin) * timestep},
                     {"end_s", static_cast<double>(contacts.span.end) * timestep},
                     {"collisions_per_s", contacts.collisions_per_second()},
                     {"dissipated_W", contacts.balance.power.total()},
                     {"drive_W", contacts.balance.drive},
                     {"gain_W", contacts.balance.gain},
                     {"dissipated_over_drive", contacts.balance.ratio()},
                     {"torque_Nm", contacts.balance.torque},
                     {"power", powers_of(contacts.span, contacts.order)},
                     {"walls",
                      {{"begin_s", static_cast<double>(contacts.walls.begin) * timestep},
                       {"end_s", static_cast<double>(contacts.walls.end) * timestep},
                       {"torque_Nm", contacts.wall_torque()}}}};
  return json.dump();
}

void print_contacts(std::ostream& out, const ContactResults& contacts) {
  out << std::setprecision(4) << "contacts: " << contacts.collisions_per_second()
      << " collisions per second; they dissipate " << contacts.balance.power.total() << " W, "
      << contacts.balance.ratio() << " of the drive's power less the charge's gain\n";
}

}  // namespace millfoam::dem_driver
