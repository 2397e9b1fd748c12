// SPDX-License-Identifier: GPL-3.0-or-later
// Cells out of the faces of a 12 cm mill's mesh, taken apart, shuffled and turned at random, as a hand-made
// file might have them: reading the OBJ file, and finding the cells. One item is a face. The argument is the
// number of layers of cells; 4, 16 and 64 give about 2.6e4, 1e5 and 4e5 faces.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "meshing/mill_mesh/mill_mesh.hpp"
#include "meshing/mill_mesh/section_blocks.hpp"
#include "meshing/polygons/assembly.hpp"
#include "meshing/polygons/obj_file.hpp"
#include "tests/meshing/polygon_support.hpp"
#include "tests/meshing/test_geometry.hpp"

namespace millfoam::meshing {
namespace {

VolumeMesh mesh_of(const benchmark::State& state) {
  const TestMill mill = test_mill(0.12, 12, 0.008, 0.006, 0.003);
  return make_mill_mesh(make_cross_section(mill.geometry, mill.cell_size), mill.geometry,
                        static_cast<int>(state.range(0)));
}

void count(benchmark::State& state, const VolumeMesh& mesh) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.faces.size()));
  state.counters["faces"] = static_cast<double>(mesh.faces.size());
}

void assemble_mill(benchmark::State& state) {
  const VolumeMesh mesh = mesh_of(state);
  const PolygonSet set = taken_apart(mesh, 1);
  for (auto _ : state) benchmark::DoNotOptimize(assemble(set).mesh.cells);
  count(state, mesh);
}
BENCHMARK(assemble_mill)->Arg(4)->Arg(16)->Arg(64)->Unit(benchmark::kMillisecond);

void read_mill_from_obj(benchmark::State& state) {
  const VolumeMesh mesh = mesh_of(state);
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "assembly_benchmark.obj";
  write_obj(mesh, file);
  for (auto _ : state) benchmark::DoNotOptimize(read_obj(file).polygons.size());
  std::filesystem::remove(file);
  count(state, mesh);
}
BENCHMARK(read_mill_from_obj)->Arg(16)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace millfoam::meshing
