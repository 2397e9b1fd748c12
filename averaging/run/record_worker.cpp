// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/record_worker.hpp"

#include "averaging/dumps/dump_reader.hpp"
#include "averaging/run/named_record.hpp"

namespace millfoam::averaging {

RecordWorker::RecordWorker(const CellSetup& setup, const std::vector<DumpFile>& dumps, double timestep)
    : setup_(setup),
      dumps_(dumps),
      timestep_(timestep),
      deposition_(setup.deposition->clone()),
      result_{WindowMoments(cell_count(setup.grid)), {}} {}

const BlockResult& RecordWorker::process(const RecordBlock& block) {
  result_.moments.clear();
  result_.volumes.clear();
  for (std::size_t r = block.first; r < block.last; ++r) {
    const ParticleRecord record = read_dump(dumps_[r].path);
    const double time = static_cast<double>(record.step) * timestep_;
    naming_record(dumps_[r].path.string(), [&] { sum_record(*deposition_, record, time, sums_); });
    if (setup_.walls) sums_.cell_volumes = setup_.walls->inside_volumes(time);
    if (setup_.diffusion) setup_.diffusion->apply(sums_.values, RecordSums::columns);
    result_.moments.add(sums_);
    result_.volumes.push_back(sums_.ledger.volume_in);
  }
  return result_;
}

}  // namespace millfoam::averaging
