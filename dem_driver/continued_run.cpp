// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/continued_run.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "dem_driver/json_file.hpp"
#include "dem_driver/output_check.hpp"
#include "meshing/files/text_numbers.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& file, const std::string& found, const std::string& expected) {
  throw std::runtime_error(file.string() + ": " + found + ", expected " + expected +
                           ", so no run can continue from it");
}

Json read_run_file(const fs::path& file) {
  std::ifstream in(file);
  if (!in) refuse(file, "no such file", "that of a complete run");
  Json run = Json::parse(in, nullptr, false);
  if (!run.is_object()) refuse(file, "is not a JSON object", "the file that millDem writes");
  return run;
}

double number(const Json& run, const char* key, const fs::path& file) {
  if (!run.contains(key) || !run[key].is_number())
    refuse(file, std::string("no number '") + key + "'", "one");
  return run[key].get<double>();
}

/// The end of a complete run of this mill, a step.
long end_of(const fs::path& file, const meshing::Mill& mill, const DemPlan& plan) {
  const Json run = read_run_file(file);
  const std::string charge = run.value(Json::json_pointer("/mill/charge"), std::string());
  if (charge != mill.fingerprint.charge)
    refuse(file, "the run is of another mill (charge " + charge + ")",
           "this mill's, " + mill.fingerprint.charge);
  const double time_step = number(run, "timestep_s", file);
  if (std::abs(time_step - plan.step.value) > 1e-9 * plan.step.value)
    refuse(file, "the time-step is " + exact(time_step) + " s",
           "this run's, " + exact(plan.step.value) + " s");
  const double begin = run.contains("begin_s") ? number(run, "begin_s", file) : 0;
  return std::lround((begin + number(run, "duration_s", file)) / time_step);
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
  state.id = file_hash(state.restart);
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
