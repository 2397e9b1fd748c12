// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/resumption.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "dem_driver/output_check.hpp"
#include "dem_driver/record_rows.hpp"
#include "dem_driver/run_file.hpp"
#include "dem_driver/segments.hpp"
#include "meshing/files/text_numbers.hpp"
#include "meshing/mill/mill_error.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

constexpr char otherwise[] =
    ", so it cannot be resumed; without --resume, or when its dem/ and dumps/ are removed, it starts from "
    "the beginning";
constexpr char deck_kept[] = ", so its deck is kept; a run without --deck-only and --resume replaces it";

/// What identifies a run of any ranks and length: its deck without the lines that depend on these, and
/// without those that make folders, in which versions differ.
std::string identity(const std::string& deck) {
  std::istringstream in(deck);
  std::string kept;
  for (std::string line; std::getline(in, line);) {
    const auto begins = [&](const std::string& start) { return line.rfind(start, 0) == 0; };
    const bool of_length = begins("run ") && line.find(" upto ") != std::string::npos;
    const bool of_restarts = line.find(" ave/histo ") != std::string::npos;
    const bool of_folder = begins("shell mkdir ");
    if (!begins("processors ") && !begins("thermo ") && !of_length && !of_restarts && !of_folder)
      kept += line + '\n';
  }
  return kept;
}

std::string read_text(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Whether the deck in the folder begins with this restart file, which then is another run's.
bool begins_deck(const CaseFolder& folder, const NumberedFile& restart) {
  const std::string command = "read_restart restart." + std::to_string(restart.step) + '\n';
  return read_text(folder.deck()).find(command) != std::string::npos;
}

/// Throws std::runtime_error, which ends with `hence`, when the run in the folder has another deck, or none.
void require_same_run(const CaseFolder& folder, const std::string& deck, const char* hence) {
  if (!fs::exists(folder.deck()))
    throw std::runtime_error(folder.deck().string() + ": no such file, expected the deck of the run in " +
                             folder.root.string() + hence);
  if (identity(read_text(folder.deck())) != identity(deck))
    throw std::runtime_error(
        folder.deck().string() +
        ": the existing run has another mill.yaml, other walls, another fluid, other averages or another "
        "begin" +
        hence);
}

/// Throws when the run in the folder cannot be resumed at that step.
void require_resumable(const CaseFolder& folder, const DemPlan& plan, long step) {
  if (step > plan.end_step()) {
    const auto seconds = [&](long steps) { return shown(static_cast<double>(steps) * plan.step.value); };
    throw meshing::KeyError("dem.duration", seconds(plan.turning_steps),
                            "at least the " + seconds(step - plan.begin) + " s that the run in " +
                                folder.root.string() + " has reached" + otherwise);
  }
  const long expected = plan.dumps > 0 ? (step - plan.begin) / plan.step.steps_per_record + 1 : 0;
  const long found = count_dumps_until(folder, step);
  if (found != expected)
    throw std::runtime_error(folder.dumps().string() + ": " + std::to_string(found) + " dumps up to step " +
                             std::to_string(step) + ", expected " + std::to_string(expected) +
                             ": the run has lost some" + otherwise);
  const std::string complaint = contacts_complaint(folder, plan, step);
  if (!complaint.empty()) throw std::runtime_error(complaint + otherwise);
}

/// The last step of the complete run in the folder.
long end_of_complete_run(const CaseFolder& folder) {
  try {
    return read_run_file(folder.run_file()).end_step;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(error.what() + std::string(otherwise));
  }
}

/// The last restart file of this run from which it resumes, if any.
std::optional<long> last_usable_restart(const CaseFolder& folder, const DemPlan& plan, std::ostream& out) {
  const auto restarts = find_restarts(folder);
  // That of the run's begin is another run's
  if (restarts.empty() || restarts.back().step <= plan.begin) return std::nullopt;
  const auto step = last_good_restart(folder, plan);
  if (!step || *step != restarts.back().step) {
    const NumberedFile& last = restarts.back();
    const bool whole = restart_complaint(last.file, plan.charge.balls()).empty();
    const std::string lost = whole ? rows_complaint(folder, plan, last.step) : "";
    out << (lost.empty()
                ? last.file.string() + ": this file, or a dump before it, is not complete and is not used\n"
                : lost + "; so " + last.file.string() + " is not used\n");
  }
  if (!step || *step <= plan.begin) return std::nullopt;
  return step;
}

}  // namespace

std::optional<long> resumable(const CaseFolder& folder, const DemPlan& plan, const std::string& deck,
                              std::ostream& out) {
  const bool complete = fs::exists(folder.run_file());
  const auto restarts = find_restarts(folder);
  const bool interrupted =
      fs::exists(folder.deck()) && !restarts.empty() && restarts.back().step > plan.begin;
  if (!complete && !interrupted) return std::nullopt;
  require_same_run(folder, deck, otherwise);
  if (complete) {
    const long end = end_of_complete_run(folder);
    if (end >= plan.end_step()) {
      require_resumable(folder, plan, end);
      return end;
    }
  }
  const auto step = last_usable_restart(folder, plan, out);
  if (!step)
    throw std::runtime_error(
        folder.dem().string() +
        ": no complete restart file with the averages of its step, and with all dumps and "
        "rows of torque and energy before it, expected one from which the " +
        (complete ? "complete run is made longer" : "interrupted run is resumed") + otherwise);
  require_resumable(folder, plan, *step);
  return step;
}

bool require_deck_of_run(const CaseFolder& folder, const std::string& deck) {
  const bool complete = fs::exists(folder.run_file());
  const auto restarts = find_restarts(folder);
  const bool has_own = std::any_of(restarts.begin(), restarts.end(), [&](const NumberedFile& restart) {
    return !begins_deck(folder, restart);
  });
  const bool begun = fs::exists(folder.deck()) && (has_own || !find_dumps(folder).empty());
  if (complete || begun) require_same_run(folder, deck, deck_kept);
  return complete || begun;
}

void prepare_deck_alone(const CaseFolder& folder, const std::string& deck,
                        const std::optional<LastState>& state) {
  // That of an earlier deck of which nothing was run would be taken for one of a run
  if (!require_deck_of_run(folder, deck))
    for (const NumberedFile& restart : find_restarts(folder))
      if (begins_deck(folder, restart)) fs::remove(restart.file);
  if (state) take_restart(*state, folder);
}

}  // namespace millfoam::dem_driver
