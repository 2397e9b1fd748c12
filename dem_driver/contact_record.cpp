// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/contact_record.hpp"

#include <limits>
#include <sstream>
#include <stdexcept>

#include "meshing/files/output_file.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

constexpr int digits = 10;

fs::path numbered(const fs::path& folder, const std::string& kind, long step) {
  return folder / (kind + '.' + std::to_string(step) + ".txt");
}

bool is_empty(const double* numbers, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k)
    if (numbers[k] != 0) return false;
  return true;
}

}  // namespace

ContactRecord::File::File(const fs::path& file, const std::string& head) : name(file), out(file) {
  out.precision(digits);
  out << "# " << head << '\n';
  flush();
}

void ContactRecord::File::flush() {
  if (!(out << std::flush))
    throw std::runtime_error(name.string() + ": cannot be written, is the disk full?");
}

ContactRecord::ContactRecord(const fs::path& folder, const ContactKinds& kinds, long start)
    : kinds_(kinds),
      work_(
          numbered(folder, contact_work_kind, start),
          "step, steps up to it, energy of spin (J), kind of contact, work (J): normal, tangential, rolling"),
      bins_(numbered(folder, contact_bins_kind, start),
            "step, kind of contact, bin of energy, touches, collisions, their work (J): normal, tangential, "
            "rolling"),
      walls_(
          numbered(folder, wall_cells_kind, start),
          "step, steps up to it, cell, sums over the steps: contacts, normal and tangential force (N), force "
          "x y z (N), moment (N m), normal and tangential work (J)") {}

void ContactRecord::write(long step, long steps, double spin, const ContactSums& sums) {
  for (int kind = 0; kind < kinds_.size(); ++kind) {
    const KindSums of = sums.of(kind);
    work_.out << step << ' ' << steps << ' ' << spin << ' ' << kind << ' ' << of.work.normal << ' '
              << of.work.tangential << ' ' << of.work.rolling << '\n';
    for (int bin = 0; bin < energy_bins; ++bin) {
      const BinSums& in = of.bins[static_cast<std::size_t>(bin)];
      if (in.touches != 0 || in.collisions != 0)
        bins_.out << step << ' ' << kind << ' ' << bin << ' ' << in.touches << ' ' << in.collisions << ' '
                  << in.work.normal << ' ' << in.work.tangential << ' ' << in.work.rolling << '\n';
    }
  }
  work_.flush();
  bins_.flush();
}

void ContactRecord::write(long step, long steps, const WallSums& sums) {
  for (std::size_t cell = 0; cell < sums.numbers.size() / numbers_per_wall_cell; ++cell) {
    const double* numbers = sums.numbers.data() + cell * numbers_per_wall_cell;
    if (cell > 0 && is_empty(numbers, numbers_per_wall_cell)) continue;
    walls_.out << step << ' ' << steps << ' ' << cell;
    for (std::size_t k = 0; k < numbers_per_wall_cell; ++k) walls_.out << ' ' << numbers[k];
    walls_.out << '\n';
  }
  walls_.flush();
}

void write_contact_state(const fs::path& folder, long step, const ContactState& state) {
  replace_file(numbered(folder, contact_state_kind, step), [&](std::ostream& out) {
    out.precision(std::numeric_limits<double>::max_digits10);
    out << state.open.size() << '\n';
    for (const OpenContact& contact : state.open)
      out << contact.ball << ' ' << contact.other << ' ' << contact.kind << ' ' << contact.work.normal << ' '
          << contact.work.tangential << ' ' << contact.work.rolling << '\n';
    out << state.wall_steps << ' ' << state.wall_numbers.size() << '\n';
    for (std::size_t i = 0; i < state.wall_numbers.size(); ++i)
      if (state.wall_numbers[i] != 0) out << i << ' ' << state.wall_numbers[i] << '\n';
    out << "end\n";
  });
}

bool has_contact_state(const fs::path& folder, long step) {
  return fs::exists(numbered(folder, contact_state_kind, step));
}

std::optional<ContactState> read_contact_state(const fs::path& folder, long step) {
  const fs::path file = numbered(folder, contact_state_kind, step);
  if (!fs::exists(file)) return std::nullopt;
  std::ifstream in(file);
  ContactState state;
  std::string text;
  long number = 0;
  const auto line = [&] {
    ++number;
    std::getline(in, text);
    return std::istringstream(text);
  };
  const auto expect = [&](bool good, const char* what) {
    if (!good)
      throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": '" + text + "', expected " +
                               what);
  };
  std::size_t contacts = 0, numbers = 0;
  expect(static_cast<bool>(line() >> contacts), "a number of contacts");
  for (std::size_t i = 0; i < contacts; ++i) {
    OpenContact open;
    expect(static_cast<bool>(line() >> open.ball >> open.other >> open.kind >> open.work.normal >>
                             open.work.tangential >> open.work.rolling),
           "a contact");
    state.open.push_back(open);
  }
  expect(static_cast<bool>(line() >> state.wall_steps >> numbers), "steps and a number of numbers");
  state.wall_numbers.resize(numbers);
  for (auto words = line(); text != "end"; words = line()) {
    std::size_t at = 0;
    double value = 0;
    expect(static_cast<bool>(words >> at >> value) && at < numbers, "a number of the walls, or 'end'");
    state.wall_numbers[at] = value;
  }
  return state;
}

}  // namespace millfoam::dem_driver
