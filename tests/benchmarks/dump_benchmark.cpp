// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reading dumps, in bytes of text per second, compared with reading the same files by zlib alone.
#include <benchmark/benchmark.h>
#include <stdlib.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "averaging/dumps/dump_reader.hpp"

namespace {

using millfoam::averaging::parse_dump;
using millfoam::averaging::read_dump;

/// A dump as LIGGGHTS writes it: numbers of six digits, unless another number is requested.
std::string dump_of(std::size_t balls, int digits) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-0.06, 0.06);
  std::normal_distribution<double> speed(0, 0.3);
  std::ostringstream text;
  text.precision(digits);
  text << "ITEM: TIMESTEP\n9831\nITEM: NUMBER OF ATOMS\n"
       << balls
       << "\nITEM: BOX BOUNDS ff ff pp\n-0.06 0.06\n-0.06 0.06\n0 0.024\nITEM: ATOMS id type x y z vx vy vz "
          "radius \n";
  for (std::size_t id = 1; id <= balls; ++id) {
    text << id << ' ' << 1 + random() % 6 << ' ' << place(random) << ' ' << place(random) << ' '
         << 0.2 * place(random) << ' ' << speed(random) << ' ' << speed(random) << ' ' << speed(random) << ' '
         << 0.0005 * static_cast<double>(2 + random() % 7) << " \n";
  }
  return text.str();
}

/// The same dump as text, as a file and as a compressed file, for the time of the program.
class Dump {
 public:
  Dump(std::size_t balls, int digits) : text_(dump_of(balls, digits)) {
    std::string name = (std::filesystem::temp_directory_path() / "dump_benchmark_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
    folder_ = name;
    std::ofstream(plain(), std::ios::binary) << text_;
    gzFile file = gzopen(compressed().c_str(), "wb");
    gzwrite(file, text_.data(), static_cast<unsigned>(text_.size()));
    gzclose(file);
  }
  ~Dump() { std::filesystem::remove_all(folder_); }
  Dump(const Dump&) = delete;
  Dump& operator=(const Dump&) = delete;

  const std::string& text() const { return text_; }
  std::filesystem::path plain() const { return folder_ / "dump.txt"; }
  std::filesystem::path compressed() const { return folder_ / "dump.txt.gz"; }

 private:
  std::string text_;
  std::filesystem::path folder_;
};

/// Each dump is made once: that takes longer than to read it many times.
const Dump& dump_for(const benchmark::State& state) {
  static std::map<std::pair<std::int64_t, std::int64_t>, Dump> made;
  const auto [balls, digits] = std::make_pair(state.range(0), state.range(1));
  return made.try_emplace({balls, digits}, static_cast<std::size_t>(balls), static_cast<int>(digits))
      .first->second;
}

template <typename Action>
void time_dump(benchmark::State& state, Action&& action) {
  const Dump& dump = dump_for(state);
  for (auto _ : state) action(dump);
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(dump.text().size()));
}

void read_by_zlib(const std::filesystem::path& path) {
  std::vector<char> block(1U << 18U);
  gzFile file = gzopen(path.c_str(), "rb");
  gzbuffer(file, 1U << 17U);
  while (gzread(file, block.data(), static_cast<unsigned>(block.size())) > 0)
    benchmark::DoNotOptimize(block.data());
  gzclose(file);
}

void parse_text(benchmark::State& state) {
  time_dump(state, [](const Dump& dump) { benchmark::DoNotOptimize(parse_dump(dump.text(), "dump")); });
}

void read_plain_file(benchmark::State& state) {
  time_dump(state, [](const Dump& dump) { benchmark::DoNotOptimize(read_dump(dump.plain())); });
}

void read_gzip_file(benchmark::State& state) {
  time_dump(state, [](const Dump& dump) { benchmark::DoNotOptimize(read_dump(dump.compressed())); });
}

void baseline_gzread_of_plain_file(benchmark::State& state) {
  time_dump(state, [](const Dump& dump) { read_by_zlib(dump.plain()); });
}

void baseline_gzread_of_gzip_file(benchmark::State& state) {
  time_dump(state, [](const Dump& dump) { read_by_zlib(dump.compressed()); });
}

/// Balls in the dump, and digits of its numbers.
void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"balls", "digits"})->Unit(benchmark::kMillisecond);
  for (const std::int64_t balls : {3500, 100000, 1000000}) benchmark->Args({balls, 6});
  benchmark->Args({100000, 10})->Args({100000, 17});
}

BENCHMARK(parse_text)->Apply(sizes);
BENCHMARK(baseline_gzread_of_plain_file)->Apply(sizes);
BENCHMARK(read_plain_file)->Apply(sizes);
BENCHMARK(baseline_gzread_of_gzip_file)->Apply(sizes);
BENCHMARK(read_gzip_file)->Apply(sizes);

}  // namespace
