// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/continued_run.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "dem_driver/output_check.hpp"
#include "dem_driver/run_file.hpp"
#include "dem_driver/wall_parts.hpp"
#include "meshing/files/file_fingerprint.hpp"
#include "meshing/files/text_numbers.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

constexpr char hence[] = ", so no run can continue from it";

[[noreturn]] void refuse(const fs::path& file, const std::string& found, const std::string& expected) {
  throw std::runtime_error(file.string() + ": " + found + ", expected " + expected + hence);
}

CompleteRun complete_run(const fs::path& file) {
  try {
    return read_run_file(file);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(error.what() + std::string(hence));
  }
}

/// The end of a complete run of this mill, a step.
long end_of(const fs::path& file, const meshing::Mill& mill, const DemPlan& plan) {
  const CompleteRun run = complete_run(file);
  if (run.charge != mill.fingerprint.charge)
    refuse(file, "the run is of another mill (charge " + run.charge + ")",
           "this mill's, " + mill.fingerprint.charge);
  if (std::abs(run.time_step - plan.step.value) > 1e-9 * plan.step.value)
    refuse(file, "the time-step is " + exact(run.time_step) + " s",
           "this run's, " + exact(plan.step.value) + " s");
  return run.end_step;
}

/// The deck of a run carries the checksums of its walls.
void require_same_walls(const CaseFolder& other, const CaseFolder& folder,
                        const std::vector<std::string>& parts) {
  std::ifstream in(other.deck());
  const std::string deck{std::istreambuf_iterator<char>(in), {}};
  if (deck.find(wall_checksums(folder, parts)) == std::string::npos)
    refuse(other.deck(), "the run has other walls", "those in " + folder.walls().string());
}

}  // namespace

LastState last_state(const CaseFolder& other, const CaseFolder& folder, const std::vector<std::string>& parts,
                     const meshing::Mill& mill, const DemPlan& plan) {
  std::error_code none;
  if (fs::equivalent(other.root, folder.root, none))
    throw std::runtime_error(
        "--continue " + other.root.string() +
        ": is the folder of this run, expected another case; a run is made longer with a larger "
        "dem.duration and --resume");
  LastState state;
  state.step = end_of(other.run_file(), mill, plan);
  require_same_walls(other, folder, parts);
  state.restart = other.dem() / ("restart." + std::to_string(state.step));
  if (!fs::exists(state.restart))
    refuse(state.restart, "no such file", "the restart file of the run's last step");
  const std::string complaint = restart_complaint(state.restart, plan.charge.balls());
  if (!complaint.empty()) throw std::runtime_error(state.restart.string() + ": " + complaint);
  state.id = file_fingerprint(state.restart);
  return state;
}

void take_restart(const LastState& state, const CaseFolder& folder) {
  const fs::path file = folder.dem() / ("restart." + std::to_string(state.step));
  const fs::path part = folder.dem() / "restart.part";
  std::error_code failure;
  fs::copy_file(state.restart, part, fs::copy_options::overwrite_existing, failure);
  if (!failure) fs::rename(part, file, failure);
  if (failure) throw std::runtime_error(file.string() + ": cannot be written: " + failure.message());
}

}  // namespace millfoam::dem_driver
