// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/fluid_ledger.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>

#include "dem_driver/segments.hpp"

namespace millfoam::dem_driver {

void FluidSums::add(const BallInFluid& ball, const FluidForce& force) {
  const Vector whole = force.sum();
  for (std::size_t k = 0; k < 3; ++k) {
    values[k] += force.pressure[k];
    values[3 + k] += force.drag[k];
    values[6] += whole[k] * ball.velocity[k];
  }
  values[7] += torque_about_z(ball, whole);
  values[8] += torque_about_z(ball, force.balance);
  if (!force.known) values[9] += 1;
}

FluidLedgerFile::FluidLedgerFile(const std::filesystem::path& file) : name_(file), out_(file) {
  out_.precision(10);
  out_ << "# step, then sums over the balls, means over the record's steps: force of the pressure x y z, of "
          "the drag x y z (N), power (W), torque about z and its part by the balance (N m), balls without "
          "field\n"
       << std::flush;
  if (!out_) throw std::runtime_error(name_.string() + ": cannot be written");
}

void FluidLedgerFile::write(long step, const FluidSums& sums, long steps) {
  out_ << step;
  for (const double value : sums.values) out_ << ' ' << value / static_cast<double>(steps);
  out_ << '\n' << std::flush;
  if (!out_) throw std::runtime_error(name_.string() + ": cannot be written, is the disk full?");
}

std::vector<FluidRow> read_fluid_ledger(const CaseFolder& folder) {
  std::map<long, FluidRow> rows;
  for (const auto& line : read_segments(folder, "fluid")) {
    const std::vector<double>& v = line.values;
    // Ledgers of millFoam 0.2.0 have no balance
    if (v.size() != 11 && v.size() != 10)
      throw std::runtime_error(line.file.string() + ":" + std::to_string(line.line) + ": " +
                               std::to_string(v.size()) + " numbers, expected 11");
    const long step = std::lround(v[0]);
    const double balance = v.size() == 11 ? v[9] : 0;
    rows[step] = {step, {v[1], v[2], v[3]}, {v[4], v[5], v[6]}, v[7], v[8], balance, v.back()};
  }
  std::vector<FluidRow> ledger;
  std::transform(rows.begin(), rows.end(), std::back_inserter(ledger),
                 [](const auto& entry) { return entry.second; });
  return ledger;
}

}  // namespace millfoam::dem_driver
