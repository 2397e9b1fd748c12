// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/files/window_journal.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include "averaging/files/read_pieces.hpp"
#include "averaging/files/solids_layout.hpp"

namespace millfoam::averaging {

namespace {

/// Calls `each` for every single number of a window, as a reference, and then `all` for every field.
template <typename Window, typename Each, typename All>
void visit(Window& window, bool inside_fractions, Each each, All all) {
  each(window.time.begin);
  each(window.time.end);
  each(window.balls_per_cell);
  for (const layout::LedgerColumn& column : layout::ledger) each(window.ledger.*column.value);
  auto& mean = window.mean;
  for (auto* field : {&mean.solidity, &mean.diameter, &mean.diameter43, &window.number,
                      &window.solidity_deviation, &window.granular_temperature}) {
    all(*field, 1);
  }
  for (auto* field : {&mean.velocity, &window.velocity_deviation}) all(*field, 3);
  if (inside_fractions) all(mean.inside_fraction, 1);
}

constexpr std::size_t single_numbers = 6 + layout::ledger.size();

std::vector<double> pack(const WindowAverage& window, bool inside_fractions) {
  std::vector<double> numbers{static_cast<double>(window.time.records), window.time.starts_late ? 1.0 : 0.0,
                              window.time.ends_short ? 1.0 : 0.0};
  visit(
      window, inside_fractions, [&](double value) { numbers.push_back(value); },
      [&](const std::vector<double>& field, int) {
        numbers.insert(numbers.end(), field.begin(), field.end());
      });
  return numbers;
}

/// Bytes of a row with its checksum.
std::size_t row_size(std::size_t cells, bool inside_fractions) {
  constexpr std::size_t numbers_per_cell = 12;
  return sizeof(double) * (single_numbers + cells * (numbers_per_cell + (inside_fractions ? 1 : 0)) + 1);
}

/// Where a row begins: behind the run's id and the rows before.
std::size_t place(std::size_t row, std::size_t row_bytes) {
  return sizeof(std::size_t) + row * row_bytes;
}

WindowAverage unpack(const std::vector<double>& numbers, bool inside_fractions) {
  const std::size_t per_cell = inside_fractions ? 13 : 12;
  const std::size_t cells = (numbers.size() - single_numbers) / per_cell;
  WindowAverage window;
  window.time.records = static_cast<long long>(numbers[0]);
  window.time.starts_late = numbers[1] != 0;
  window.time.ends_short = numbers[2] != 0;
  auto next = numbers.begin() + 3;
  visit(
      window, inside_fractions, [&](double& value) { value = *next++; },
      [&](std::vector<double>& field, int components) {
        const auto end = next + static_cast<std::ptrdiff_t>(cells) * components;
        field.assign(next, end);
        next = end;
      });
  return window;
}

double checksum(const std::vector<double>& numbers) {
  const auto* bytes = reinterpret_cast<const Bytef*>(numbers.data());
  return static_cast<double>(crc32_z(0, bytes, numbers.size() * sizeof(double)));
}

SolidsFileError failure(const std::filesystem::path& path, const char* action) {
  return SolidsFileError(path.string() + ": cannot " + action + ": " +
                         std::generic_category().message(errno));
}

}  // namespace

bool WindowJournal::holds(const std::filesystem::path& path, std::size_t id, std::size_t cells,
                          bool inside_fractions, std::size_t rows) {
  std::ifstream input(path, std::ios::binary);
  std::size_t found = 0;
  if (!input.read(reinterpret_cast<char*>(&found), sizeof found) || found != id) return false;
  input.seekg(0, std::ios::end);
  return static_cast<std::size_t>(input.tellg()) >= place(rows, row_size(cells, inside_fractions));
}

WindowJournal::WindowJournal(const std::filesystem::path& path, std::size_t id, std::size_t cells,
                             bool inside_fractions, std::size_t rows)
    : path_(path), inside_fractions_(inside_fractions), row_bytes_(row_size(cells, inside_fractions)) {
  const int begin_anew = rows == 0 ? O_TRUNC : 0;
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | begin_anew, 0666);
  if (file_ < 0) throw failure(path_, "create the file (is the folder there and writable?)");
  if (rows == 0) write_all(&id, sizeof id);
  if (ftruncate(file_, static_cast<off_t>(place(rows, row_bytes_))) != 0 || lseek(file_, 0, SEEK_END) < 0) {
    throw failure(path_, "shorten the file");
  }
  rows_ = rows;
}

WindowJournal::~WindowJournal() {
  if (file_ >= 0) close(file_);
}

WindowJournal::WindowJournal(WindowJournal&& other) noexcept
    : path_(std::move(other.path_)),
      inside_fractions_(other.inside_fractions_),
      row_bytes_(other.row_bytes_),
      file_(std::exchange(other.file_, -1)),
      rows_(other.rows_) {}

void WindowJournal::write_all(const void* data, std::size_t size) {
  const char* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = write(file_, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw failure(path_, "write (is the disk full?)");
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

void WindowJournal::append(const WindowAverage& window) {
  std::vector<double> numbers = pack(window, inside_fractions_);
  numbers.push_back(checksum(numbers));
  if (numbers.size() * sizeof(double) != row_bytes_) {
    throw SolidsFileError(path_.string() + ": a window of another number of cells");
  }
  write_all(numbers.data(), row_bytes_);
  ++rows_;
}

void WindowJournal::sync() {
  if (fdatasync(file_) != 0) throw failure(path_, "write to disk (is it full?)");
}

WindowAverage WindowJournal::read(std::size_t row) const {
  std::vector<double> numbers(row_bytes_ / sizeof(double));
  const ssize_t got =
      read_pieces(numbers.data(), row_bytes_, static_cast<off_t>(place(row, row_bytes_)),
                  [&](void* data, std::size_t size, off_t begin) { return pread(file_, data, size, begin); });
  if (got < 0) throw failure(path_, "read");
  const double expected = numbers.back();
  numbers.pop_back();
  if (got != static_cast<ssize_t>(row_bytes_) || checksum(numbers) != expected) {
    throw SolidsFileError(path_.string() + ": window " + std::to_string(row) +
                          " is damaged; remove the file and average again");
  }
  return unpack(numbers, inside_fractions_);
}

}  // namespace millfoam::averaging
