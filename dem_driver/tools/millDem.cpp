// SPDX-License-Identifier: GPL-3.0-or-later
// millDem mill.yaml --case DIR [-np N]: the dry run of a mill with LIGGGHTS. See dem_driver/README.md.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/charge_plan.hpp"
#include "dem_driver/deck.hpp"
#include "dem_driver/liggghts_run.hpp"
#include "dem_driver/time_step.hpp"
#include "meshing/mill.hpp"

namespace {

using namespace millfoam;

struct Options {
  std::string mill_file;
  std::string case_folder;
  int ranks = 1;
  bool deck_only = false;
};

void write_deck_file(const dem_driver::CaseFolder& folder, const meshing::Mill& mill,
                     const dem_driver::DemPlan& plan, int ranks) {
  std::ofstream deck(folder.deck());
  dem_driver::write_deck(deck, mill, plan, dem_driver::find_walls(folder, mill), ranks);
  deck.close();
  if (!deck) throw std::runtime_error(folder.deck().string() + ": cannot be written");
}

void run(const Options& options) {
  const auto mill = meshing::read_mill(options.mill_file);
  const dem_driver::CaseFolder folder{options.case_folder};
  const auto plan = dem_driver::plan_dem(mill);
  dem_driver::print_time_step(std::cout, plan.step);
  dem_driver::print_charge(std::cout, plan.charge);
  dem_driver::find_walls(folder, mill);

  const auto removed = dem_driver::prepare_folders(folder);
  if (removed > 0) std::cout << "removed " << removed << " dumps of an earlier run\n";
  write_deck_file(folder, mill, plan, options.ranks);
  std::cout << "deck: " << folder.deck().string() << std::endl;
  if (options.deck_only) return;
  const auto result =
      dem_driver::run_liggghts(folder, plan, options.ranks, {std::cerr, isatty(STDERR_FILENO) != 0});
  // Only now, so that the dumps of a broken run are not taken for a whole one.
  dem_driver::write_run_file(folder, mill, plan);
  dem_driver::print_result(std::cout, plan, result);
}

/// CLI11 knows no long option with one dash, but `-np` is what every user of MPI types.
std::vector<std::string> arguments(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  std::replace(words.begin(), words.end(), std::string("-np"), std::string("--np"));
  std::reverse(words.begin(), words.end());  // the order in which CLI11 takes a vector
  return words;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Dry run of a tumbling mill with LIGGGHTS: DIR/walls/*.stl to DIR/dumps/dump.*.txt",
               "millDem"};
  app.add_option("mill", options.mill_file, "description of the mill, mill.yaml")->required();
  app.add_option("--case", options.case_folder, "case folder DIR that millMesh has made")->required();
  app.add_option("--np", options.ranks, "number of MPI ranks (also -np)")->check(CLI::PositiveNumber);
  app.add_flag("--deck-only", options.deck_only, "write the deck, do not run it");
  try {
    app.parse(arguments(argc, argv));
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  try {
    run(options);
  } catch (const std::exception& error) {
    std::cerr << "millDem: error: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
