// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/tools/averages_fix.hpp"

#include <liggghts/atom.h>
#include <liggghts/fix.h>
#include <liggghts/modify.h>
#include <liggghts/update.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "averaging/run/live_averages.hpp"
#include "dem_driver/averages_order.hpp"
#include "dem_driver/tools/ball_shape.hpp"

namespace millfoam::dem_driver {

namespace {

/// The ranks of LIGGGHTS.
class Ranks : public averaging::Communicator {
 public:
  explicit Ranks(MPI_Comm world) : world_(world) {
    MPI_Comm_rank(world, &rank_);
    MPI_Comm_size(world, &size_);
  }
  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void sum(std::vector<double>& numbers) override {
    constexpr std::size_t piece = 1U << 26;  // MPI counts with int
    for (std::size_t done = 0; done < numbers.size(); done += piece) {
      double* const first = numbers.data() + done;
      const void* const send = rank_ == 0 ? MPI_IN_PLACE : first;
      MPI_Reduce(send, first, static_cast<int>(std::min(piece, numbers.size() - done)), MPI_DOUBLE, MPI_SUM,
                 0, world_);
    }
  }

 private:
  MPI_Comm world_;
  int rank_ = 0;
  int size_ = 1;
};

class AveragesFix : public LAMMPS_NS::Fix {
 public:
  AveragesFix(LAMMPS_NS::LAMMPS& liggghts, std::array<char*, 3> words, const AveragesOrder& order, Stop stop)
      : Fix(&liggghts, static_cast<int>(words.size()), words.data()), ranks_(liggghts.world), stop_(stop) {
    nevery = static_cast<int>(order.run.interval);
    const auto now = static_cast<long long>(liggghts.update->ntimestep);
    const bool begins = now == order.run.begin;
    last_ = begins ? now - 1 : now;
    const auto resumed = begins ? std::nullopt : std::optional<long long>(now);
    for (std::size_t n = 0; n < order.averages.size(); ++n) {
      const OrderedAverages& averages = order.averages[n];
      averages_.push_back(std::make_unique<averaging::LiveAverages>(
          averages.request, order.run, averages_files(".", n), averages.id, resumed, ranks_));
    }
  }

  int setmask() override { return LAMMPS_NS::FixConst::END_OF_STEP; }
  /// Before the first step of each part into which the run is divided.
  void setup(int) override { guarded(); }
  void end_of_step() override { guarded(); }

 private:
  void guarded() {
    try {
      add_record();
    } catch (const std::exception& thrown) {
      stop_(thrown);
    }
  }

  void add_record() {
    const auto step = static_cast<long long>(update->ntimestep);
    if (step <= last_) return;
    last_ = step;
    own_.step = step;
    own_.particles.resize(static_cast<std::size_t>(atom->nlocal));
    for (int i = 0; i < atom->nlocal; ++i) {
      const double *x = atom->x[i], *v = atom->v[i];
      own_.particles[static_cast<std::size_t>(i)] = {
          atom->tag[i], {x[0], x[1], x[2]}, {v[0], v[1], v[2]}, ball_radius(*atom, i)};
    }
    for (const auto& averages : averages_) averages->add(own_);
    // The deck writes a restart file after each part of the run
    if (step != static_cast<long long>(update->laststep)) return;
    for (const auto& averages : averages_) averages->checkpoint();
  }

  Ranks ranks_;
  Stop stop_;
  long long last_ = 0;  ///< step of the last record
  averaging::ParticleRecord own_;
  std::vector<std::unique_ptr<averaging::LiveAverages>> averages_;
};

}  // namespace

void make_averages(LAMMPS_NS::LAMMPS& liggghts, const std::string& name, const std::string& order,
                   Stop stop) {
  std::string id = name, group = "all", style = "millFoam/averages";
  auto fix =
      std::make_unique<AveragesFix>(liggghts, std::array<char*, 3>{id.data(), group.data(), style.data()},
                                    read_averages_order(order), stop);
  const int place = liggghts.modify->find_fix(name.c_str());
  liggghts.modify->fmask[place] = fix->setmask();
  delete liggghts.modify->fix[place];
  liggghts.modify->fix[place] = fix.release();
}

}  // namespace millfoam::dem_driver
