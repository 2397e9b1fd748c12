// SPDX-License-Identifier: GPL-3.0-or-later
// millLiggghts -in DECK …: LIGGGHTS as millDem starts it, with the fluid that pushes the balls, the averages
// of the balls and the statistics of their contacts. It takes the options of the program liggghts, prints
// what that prints, and needs dem/fluid.json, dem/averages.json and dem/contacts.json only where the deck has
// these. See dem_driver/README.md.
#include <liggghts/atom.h>
#include <liggghts/fix_external.h>
#include <liggghts/input.h>
#include <liggghts/lammps.h>
#include <liggghts/modify.h>
#include <liggghts/update.h>
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "dem_driver/deck.hpp"
#include "dem_driver/deck_outputs.hpp"
#include "dem_driver/flow_exchange.hpp"
#include "dem_driver/fluid_ledger.hpp"
#include "dem_driver/fluid_settings.hpp"
#include "dem_driver/tools/averages_fix.hpp"
#include "dem_driver/tools/ball_shape.hpp"
#include "dem_driver/tools/contact_watch.hpp"
#include "dem_driver/tools/stop.hpp"
#include "dem_driver/tools/wall_velocities.hpp"
#include "dem_driver/tools/watched_model.hpp"

namespace {

using namespace millfoam::dem_driver;
using LAMMPS_NS::LAMMPS;

bool begins(const std::string& text, const std::string& start) {
  return text.rfind(start, 0) == 0;
}

/// The ranks of LIGGGHTS.
class MpiRanks final : public RankGroup {
 public:
  explicit MpiRanks(MPI_Comm ranks) : ranks_(ranks) {}
  int rank() const override {
    int number = 0;
    MPI_Comm_rank(ranks_, &number);
    return number;
  }
  void sum(std::vector<double>& numbers) override {
    std::vector<double> sums(numbers.size());
    MPI_Reduce(numbers.data(), sums.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, MPI_SUM, 0, ranks_);
    numbers = std::move(sums);
  }
  void broadcast(std::vector<double>& numbers) override {
    auto length = static_cast<unsigned long>(numbers.size());
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibcast(&length, 1, MPI_UNSIGNED_LONG, 0, ranks_, &request);
    // The first rank waits for a flow; the others leave their cores to it
    for (int done = 0; done == 0;) {
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      if (done == 0) std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    // Returns at once: static analysis expects a wait for each request
    MPI_Wait(&request, MPI_STATUS_IGNORE);
    numbers.resize(length);
    MPI_Bcast(numbers.data(), static_cast<int>(length), MPI_DOUBLE, 0, ranks_);
  }

 private:
  MPI_Comm ranks_;
};

/// The fluid's forces as a `fix external` of the deck gets them in every step, on every rank of its own
/// balls.
class FluidFix {
 public:
  /// Of the fix `name`, which the deck has just made.
  /// @param ledger  begin of the ledger's name; empty: none is kept
  FluidFix(LAMMPS& liggghts, const std::string& name, const FluidOrder& order, const std::string& ledger)
      : liggghts_(liggghts),
        ranks_(liggghts.world),
        timestep_(order.timestep),
        record_(order.record_steps),
        last_(liggghts.update->ntimestep) {
    if (order.exchange) {
      auto exchange = std::make_unique<FlowExchange>(order, last_, ranks_);
      exchange_ = exchange.get();
      forces_ = std::move(exchange);
    } else {
      forces_ = make_fluid_forces(order.fluid);
    }
    if (!ledger.empty() && ranks_.rank() == 0) ledger_.emplace(ledger + '.' + std::to_string(last_) + ".txt");
    keeps_ledger_ = !ledger.empty();
    auto* fix =
        static_cast<LAMMPS_NS::FixExternal*>(liggghts.modify->fix[liggghts.modify->find_fix(name.c_str())]);
    fix->set_callback(
        [](void* self, LAMMPS_NS::bigint step, int balls, int*, double** position, double** force) {
          // An exception must not pass through LIGGGHTS
          try {
            static_cast<FluidFix*>(self)->act(static_cast<long>(step), balls, position, force);
          } catch (const std::exception& error) {
            stop(error);
          }
        },
        this);
  }
  FluidFix(const FluidFix&) = delete;
  FluidFix& operator=(const FluidFix&) = delete;

 private:
  void act(long step, int balls, double** position, double** force) {
    if (exchange_ != nullptr && exchange_->due(step)) exchange_->meet(step, all(balls, position));
    forces_->set_time(static_cast<double>(step) * timestep_);
    // LIGGGHTS computes the forces of a step once more where a run is divided
    const bool counts = keeps_ledger_ && step > last_;
    for (int i = 0; i < balls; ++i) {
      const BallInFluid ball = ball_at(i, position);
      const FluidForce felt = forces_->on(ball);
      const Vector whole = felt.sum();
      std::copy(whole.begin(), whole.end(), force[i]);
      if (counts) sums_.add(ball, felt);
    }
    if (counts) end_step(step);
  }

  BallInFluid ball_at(int i, double** position) {
    const LAMMPS_NS::Atom& atom = *liggghts_.atom;
    const double* x = position[i];
    const double* v = atom.v[i];
    return {{x[0], x[1], x[2]},
            {v[0], v[1], v[2]},
            2 * ball_radius(atom, i),
            sphericities_.of(atom, i),
            atom.tag[i]};
  }

  /// The balls of this rank.
  std::vector<BallInFluid> all(int balls, double** position) {
    std::vector<BallInFluid> result;
    result.reserve(static_cast<std::size_t>(balls));
    for (int i = 0; i < balls; ++i) result.push_back(ball_at(i, position));
    return result;
  }

  void end_step(long step) {
    last_ = step;
    ++steps_;
    if (step % record_ != 0) return;
    FluidSums all;
    MPI_Reduce(sums_.values.data(), all.values.data(), static_cast<int>(all.values.size()), MPI_DOUBLE,
               MPI_SUM, 0, liggghts_.world);
    if (ledger_) ledger_->write(step, all, steps_);
    sums_ = {};
    steps_ = 0;
  }

  LAMMPS& liggghts_;
  MpiRanks ranks_;
  std::unique_ptr<FluidForces> forces_;
  FlowExchange* exchange_ = nullptr;  ///< the forces, if a flow that runs at the same time gives them
  double timestep_;
  long record_;
  long last_;  ///< step that the ledger has, or at which it begins
  bool keeps_ledger_ = false;
  std::optional<FluidLedgerFile> ledger_;  ///< of the first rank
  FluidSums sums_;
  Sphericities sphericities_;
  long steps_ = 0;  ///< in the sums
};

/// The text of the deck, on every rank.
std::string read_deck(const std::string& file, int rank) {
  std::string text;
  if (rank == 0) {
    std::ifstream in(file);
    if (!in) throw std::runtime_error(file + ": cannot be read, expected a deck of LIGGGHTS");
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  auto length = static_cast<unsigned long>(text.size());
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG, 0, MPI_COMM_WORLD);
  text.resize(length);
  MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, 0, MPI_COMM_WORLD);
  return text;
}

std::string deck_name(int argc, char** argv) {
  for (int i = 1; i + 1 < argc; ++i)
    if (std::string(argv[i]) == "-in") return argv[i + 1];
  throw std::runtime_error("expected -in DECK");
}

/// Feeds the deck to LIGGGHTS line by line, gives the fixes of fluid and averages their work as soon as they
/// are there, follows the contacts from the deck's `watch_command` on, and lets the walls of a deck that
/// reads a restart file turn from its first forces on.
void run(int argc, char** argv, int rank) {
  std::istringstream deck(read_deck(deck_name(argc, argv), rank));
  add_watched_model();
  LAMMPS liggghts(argc, argv, MPI_COMM_WORLD);
  std::unique_ptr<FluidFix> fluid;
  bool resumes = false;
  for (std::string line; std::getline(deck, line);) {
    if (begins(line, watch_command)) {
      watch_contacts(liggghts, "contacts.json");
      continue;
    }
    if (begins(line, "run ") && std::exchange(resumes, false)) set_wall_velocities(liggghts);
    liggghts.input->one(line.c_str());
    if (begins(line, "read_restart ")) resumes = true;
    for (const char* name : {fluid_at_rest_fix, fluid_fix})
      if (begins(line, std::string("fix ") + name + ' '))
        fluid = std::make_unique<FluidFix>(liggghts, name, read_fluid_order("fluid.json"),
                                           name == fluid_fix ? "fluid" : "");
    if (begins(line, std::string("fix ") + averages_fix + ' '))
      make_averages(liggghts, averages_fix, "averages.json", stop);
  }
}

}  // namespace

void millfoam::dem_driver::stop(const std::exception& error) {
  std::printf("ERROR: %s\n", error.what());
  std::fflush(stdout);
  MPI_Abort(MPI_COMM_WORLD, 1);
  std::abort();
}

#ifdef __SANITIZE_ADDRESS__
/// LIGGGHTS leaves memory to the end of the process.
extern "C" const char* __asan_default_options() {  // NOLINT: the sanitizer's name
  return "detect_leaks=0";
}
#endif

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  try {
    run(argc, argv, rank);
  } catch (const std::exception& error) {
    stop(error);
  }
  MPI_Finalize();
}
