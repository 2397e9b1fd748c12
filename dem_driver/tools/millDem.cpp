// SPDX-License-Identifier: GPL-3.0-or-later
// millDem mill.yaml --case DIR [-np N]: the dry run of a mill with LIGGGHTS. See dem_driver/README.md.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/charge_plan.hpp"
#include "dem_driver/contact_order.hpp"
#include "dem_driver/continued_run.hpp"
#include "dem_driver/deck.hpp"
#include "dem_driver/disk_room.hpp"
#include "dem_driver/fluid_check.hpp"
#include "dem_driver/folder_preparation.hpp"
#include "dem_driver/forecast.hpp"
#include "dem_driver/liggghts_run.hpp"
#include "dem_driver/plan_report.hpp"
#include "dem_driver/record_rows.hpp"
#include "dem_driver/results.hpp"
#include "dem_driver/resumption.hpp"
#include "dem_driver/run_file.hpp"
#include "dem_driver/segments.hpp"
#include "dem_driver/tools/averages_of_run.hpp"
#include "dem_driver/wall_parts.hpp"
#include "meshing/files/output_file.hpp"
#include "meshing/files/standard_output.hpp"
#include "meshing/mill/mill_document.hpp"
#include "meshing/mill/mill_error.hpp"
#include "meshing/tools/mill_options.hpp"
#include "meshing/walls/wall_files.hpp"

namespace {

using namespace millfoam;

namespace fs = std::filesystem;

struct Options {
  meshing::MillOptions mill;
  std::string case_folder;
  int ranks = 1;
  bool deck_only = false;
  bool resume = false;
  bool or_anew = false;
  std::string fluid;  ///< slurry.h5; empty: none
  std::string fluid_time = "mean";
  std::string with_flow;  ///< folder of the exchange with a flow that runs at the same time; empty: none
  std::string continued;  ///< folder of the case from whose last state the run continues; empty: none
  std::vector<std::string> averages;  ///< made while the mill turns: options of millAverage
  std::string plan_file;
};

/// Prepares the folder for LIGGGHTS: to resume at `step`, or for a new run.
void prepare(const dem_driver::CaseFolder& folder, const dem_driver::DemPlan& plan,
             std::optional<long> step) {
  if (step) {
    dem_driver::remove_results(folder);
    dem_driver::remove_dumps_after(folder, *step);
    dem_driver::remove_restarts_after(folder, *step);
    dem_driver::cut_rows_after(folder, plan, *step);
    return;
  }
  const auto removed = dem_driver::prepare_folders(folder);
  if (removed > 0) std::cout << "removed " << removed << " dumps of an earlier run\n";
}

/// The step at which the run resumes; nothing where it starts from the beginning: without `--resume`, or with
/// `--or-anew` where it cannot be resumed.
std::optional<long> first_step(const Options& options, const dem_driver::CaseFolder& folder,
                               const dem_driver::DemPlan& plan, const std::string& deck) {
  if (!options.resume) return std::nullopt;
  try {
    return dem_driver::resumable(folder, plan, deck, std::cout);
  } catch (const std::exception& reason) {
    if (!options.or_anew) throw;
    std::cout << reason.what() << ". The dry run starts from the beginning\n";
    return std::nullopt;
  }
}

/// The file for millLiggghts, or none of an earlier run.
void write_fluid(const dem_driver::CaseFolder& folder, const meshing::Mill& mill,
                 const dem_driver::DemPlan& plan, const std::vector<std::string>& parts) {
  if (plan.fluid.kind == dem_driver::FluidKind::none) {
    fs::remove(folder.fluid_order());
    return;
  }
  dem_driver::FluidOrder order{plan.fluid, plan.step.value, plan.step.steps_per_record, std::nullopt};
  if (plan.fluid.kind == dem_driver::FluidKind::flow) {
    std::vector<fs::path> walls;
    walls.reserve(parts.size());
    for (const std::string& part : parts) walls.push_back(fs::path("../walls") / (part + ".stl"));
    order.exchange = dem_driver::exchange_of(mill, walls, plan.begin, plan.end_step());
  }
  dem_driver::write_fluid_order(folder.fluid_order(), mill, order);
}

/// The same for the contacts.
void write_contact_order(const dem_driver::CaseFolder& folder, const meshing::Mill& mill,
                         const dem_driver::DemPlan& plan, const std::vector<std::string>& parts) {
  if (plan.watches_contacts)
    dem_driver::write_contact_order(folder.contact_order(), mill,
                                    contact_order_of(mill, plan, parts, folder.walls()));
  else
    fs::remove(folder.contact_order());
}

void run(const Options& options, const meshing::MillDescription& description) {
  const meshing::Mill& mill = description.mill;
  const dem_driver::CaseFolder folder{options.case_folder};
  auto plan = dem_driver::plan_dem(mill);
  meshing::require_walls_of(folder.walls(), mill);
  const auto parts = dem_driver::find_walls(folder, mill);
  meshing::require_written_walls(folder.walls());
  if (!options.fluid.empty() && mill.machine() == meshing::Machine::stirred)
    throw meshing::KeyError("machine", "stirred",
                            "a tumbling mill with --fluid: the voxels of slurry.h5 do not turn with the "
                            "impeller; take --with-flow");
  if (!options.with_flow.empty() && mill.machine() == meshing::Machine::stirred && !mill.flow.coupling.voxels)
    throw meshing::KeyError("flow.coupling", "one_way",
                            "direct with --with-flow: it gives the voxels on which balls and slurry meet");
  if (!options.fluid.empty() && mill.dem.pool_level)
    throw meshing::KeyError("dem.fluid", "buoyancy", "none with --fluid, which has the buoyancy of its flow");
  if (!options.fluid.empty())
    plan.fluid = dem_driver::require_fluid_of(
        options.fluid,
        options.fluid_time == "windows" ? dem_driver::FluidTime::windows : dem_driver::FluidTime::mean, mill,
        plan);
  if (!options.with_flow.empty() && mill.dem.pool_level)
    throw meshing::KeyError("dem.fluid", "buoyancy",
                            "none with --with-flow, which has the buoyancy of its flow");
  std::optional<dem_driver::LastState> state;
  if (!options.continued.empty()) {
    state = dem_driver::last_state({options.continued}, folder, parts, mill, plan);
    dem_driver::continue_from(state->step, plan);
  }
  dem_driver::require_windows_in_run(plan.fluid, plan);
  if (!options.with_flow.empty()) dem_driver::meet_flow(options.with_flow, mill, plan);
  const auto walls = dem_driver::wall_fingerprints(folder, parts);
  const dem_driver::AveragesOfRun averages(description, folder, walls, options.averages, plan, std::cout);
  std::ostringstream deck;
  dem_driver::write_deck(deck, mill, plan, parts, options.ranks);
  deck << dem_driver::wall_checksums(folder, parts);
  if (state) deck << "# begins with the restart file " << state->id << '\n';

  fs::create_directories(folder.dem());
  const averaging::FileLock lock = dem_driver::lock_folder(folder);
  const auto step = first_step(options, folder, plan, deck.str());
  if (step && *step == plan.end_step() && fs::exists(folder.run_file())) {
    std::cout << folder.run_file().string() << ": the run is complete, nothing to do\n";
    averages.finish(true, std::cout);
    return;
  }
  dem_driver::print_plan(std::cout, mill, plan);
  if (options.deck_only) {
    dem_driver::prepare_deck_alone(folder, deck.str(), state);
  } else {
    dem_driver::require_programs(plan, options.ranks);
    dem_driver::require_room(folder, plan, step.value_or(plan.begin));
    prepare(folder, plan, step);
    if (state && !step) dem_driver::take_restart(*state, folder);
  }
  write_fluid(folder, mill, plan, parts);
  write_contact_order(folder, mill, plan, parts);
  averages.write_order();
  replace_file(folder.deck(), [&](std::ostream& out) { out << deck.str(); });
  dem_driver::write_plan_file(folder.plan_file(), mill, plan);
  meshing::write_resolved_mill(description, "millDem", folder.root / meshing::resolved_mill_name);
  std::cout << "deck: " << folder.deck().string() << std::endl;
  if (plan.fluid.kind != dem_driver::FluidKind::none)
    std::cout << "fluid: " << dem_driver::in_words(plan.fluid) << '\n';
  if (state)
    std::cout << "continues from step " << plan.begin << ", t = " << plan.begin_time() << " s of "
              << state->restart.string() << '\n';
  std::cout << std::flush;
  if (options.deck_only) return;
  if (step) {
    replace_file(folder.resume_deck(), [&](std::ostream& out) {
      dem_driver::write_resume_deck(out, mill, plan, parts, options.ranks, *step);
    });
    std::cout << "resumed at step " << *step << ", t = " << static_cast<double>(*step) * plan.step.value
              << " s" << std::endl;
  }
  const auto result =
      dem_driver::run_liggghts(folder, plan, options.ranks, {std::cerr, isatty(STDERR_FILENO) != 0}, step);
  const auto results = dem_driver::gather_results(folder, mill, plan, result);
  dem_driver::write_results_files(folder, mill, plan, results);
  // Only now, so that the dumps of a broken run are not taken for a complete one.
  dem_driver::write_run_file(folder, mill, plan, walls);
  dem_driver::print_results(std::cout, plan, results);
  averages.finish(false, std::cout);
}

/// Before the trial, which takes half a minute.
void check_plan_file(const Options& options) {
  const fs::path file = options.plan_file;
  const fs::path place = fs::absolute(file).parent_path();
  std::error_code none;
  if (fs::equivalent(file, options.mill.file, none))
    throw std::runtime_error("--json " + file.string() +
                             ": is the description of the mill, expected another file");
  if (fs::is_directory(file))
    throw std::runtime_error("--json " + file.string() + ": is a folder, expected the name of a file");
  if (!fs::is_directory(place))
    throw std::runtime_error("--json " + file.string() + ": no such folder, expected one that exists");
}

void plan(const Options& options, const meshing::MillDescription& description) {
  if (!options.plan_file.empty()) check_plan_file(options);
  const meshing::Mill& mill = description.mill;
  const auto plan = dem_driver::plan_dem(mill);
  dem_driver::print_plan(std::cout, mill, plan);
  const auto cost = dem_driver::measure_cost(mill, options.ranks);
  const auto forecast = dem_driver::forecast(plan, cost, options.ranks);
  dem_driver::print_forecast(std::cout, forecast, cost, options.ranks);
  if (!options.plan_file.empty())
    dem_driver::write_plan_file(options.plan_file, mill, plan,
                                dem_driver::MeasuredForecast{forecast, cost, options.ranks});
}

/// CLI11 has no long options with one dash, but `-np` is what every user of MPI types.
std::vector<std::string> arguments(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  std::replace(words.begin(), words.end(), std::string("-np"), std::string("--np"));
  std::reverse(words.begin(), words.end());  // the order in which CLI11 takes a vector
  return words;
}

using Action = void (*)(const Options&, const meshing::MillDescription&);

void add_common(CLI::App& app, Options& options) {
  meshing::add_version(app, "millDem");
  meshing::add_mill_options(app, options.mill)->required();
  app.add_option_function<std::string>(
         "--np", [&](const std::string& word) { options.ranks = dem_driver::read_ranks(word); },
         "number of MPI ranks (also -np)")
      ->type_name("N");
}

/// `millDem plan …` or `millDem …`: the run has no name, because it is the usual command.
Action parse(CLI::App& app, Options& options, std::vector<std::string> words) {
  if (!words.empty() && words.back() == "plan") {
    words.pop_back();
    app.description(
        "Predicts steps, wall time, disk and memory of a dry run, from a trial of half a minute.");
    add_common(app, options);
    app.add_option("--json", options.plan_file, "write the plan to this file, too");
    app.parse(words);
    return plan;
  }
  app.footer("millDem plan mill.yaml [-np N] predicts what the run will cost.");
  add_common(app, options);
  app.add_option("--case", options.case_folder, "case folder DIR that millMesh has made");
  auto* resume = app.add_flag("--resume", options.resume, "resume an interrupted run; keep a complete one");
  app.add_flag("--or-anew", options.or_anew, "start a run that cannot be resumed from the beginning")
      ->needs(resume);
  auto* fluid = app.add_option("--fluid", options.fluid, "slurry.h5 of a flow that pushes the balls");
  app.add_option("--fluid-time", options.fluid_time,
                 "of that flow: its mean over the run, or its time windows")
      ->check(CLI::IsMember({"mean", "windows"}))
      ->needs(fluid);
  app.add_option("--with-flow", options.with_flow,
                 "folder through which slurryFoam, which runs at the same time, gives its forces")
      ->excludes(fluid);
  app.add_option(
      "--continue", options.continued,
      "begin with the last state of the complete run in this case folder, and turn for dem.duration more");
  app.add_option("--average", options.averages,
                 "make averages while the mill turns, of these options of millAverage, in quotes, as in "
                 "'--cylinder 0 0.06 0 0.024 --shape 30 40 1 -o rings.h5'; may be given again")
      ->expected(1)
      ->take_all()
      ->type_name("OPTIONS");
  app.add_flag("--deck-only", options.deck_only, "write the deck, do not run it");
  app.parse(words);
  if (options.case_folder.empty() && options.mill.resolved.empty()) throw CLI::RequiredError("--case");
  return run;
}

/// Reads the mill and acts; a key that no dry run can be made of is named with its place.
void act(const Options& options, Action action) {
  const meshing::MillDescription description = options.mill.read();
  if (!options.mill.resolved.empty()) {
    meshing::write_resolved_mill(description, "millDem", options.mill.resolved);
    return;
  }
  meshing::naming_place(description, [&] { action(options, description); });
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Dry run of a mill with LIGGGHTS: DIR/walls/*.stl to DIR/dumps/dump.*.txt", "millDem"};
  try {
    const Action action = parse(app, options, arguments(argc, argv));
    meshing::naming_case(options.case_folder, [&] { act(options, action); });
    require_printed();
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::cerr << "millDem: error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
