// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/checkpoint.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include "averaging/files/solids_file.hpp"

namespace millfoam::averaging {

namespace {

void put(std::string& bytes, std::size_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

std::size_t checksum(const std::string& bytes, std::size_t size) {
  return crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), size);
}

std::string as_bytes(const Checkpoint& checkpoint) {
  std::string bytes;
  put(bytes, checkpoint.signature.size());
  bytes += checkpoint.signature;
  put(bytes, checkpoint.reached);
  put(bytes, checkpoint.rows.size());
  for (std::size_t s = 0; s < checkpoint.rows.size(); ++s) {
    put(bytes, checkpoint.rows[s]);
    put(bytes, checkpoint.open[s].size());
    bytes.append(reinterpret_cast<const char*>(checkpoint.open[s].data()),
                 checkpoint.open[s].size() * sizeof(double));
  }
  put(bytes, checksum(bytes, bytes.size()));
  return bytes;
}

/// Takes the parts of a checkpoint off its bytes, whose checksum was right.
class Parts {
 public:
  explicit Parts(const std::string& bytes) : bytes_(bytes) {}

  std::size_t number() {
    std::size_t value = 0;
    copy(&value, sizeof value);
    return value;
  }
  std::string text() {
    std::string value(number(), '\0');
    copy(value.data(), value.size());
    return value;
  }
  std::vector<double> numbers() {
    std::vector<double> values(number());
    copy(values.data(), values.size() * sizeof(double));
    return values;
  }

 private:
  void copy(void* to, std::size_t size) {
    std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
};

/// Writes a whole file and waits until it is on the disk.
bool write_file(const std::filesystem::path& path, const std::string& bytes) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return false;
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written = write(file, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) break;
    done += static_cast<std::size_t>(written);
  }
  const bool whole = done == bytes.size() && fsync(file) == 0;
  const int reason = errno;
  close(file);
  errno = reason;
  return whole;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  const std::filesystem::path fresh = path.string() + ".new";
  if (!write_file(fresh, as_bytes(checkpoint)) || rename(fresh.c_str(), path.c_str()) != 0) {
    const std::string reason = std::generic_category().message(errno);
    std::error_code ignored;
    std::filesystem::remove(fresh, ignored);
    throw SolidsFileError(path.string() + ": cannot write this file: " + reason);
  }
}

std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& path) {
  std::ifstream input(path, std::ios::binary);
  if (!input) return std::nullopt;
  const std::string bytes{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  std::size_t expected = 0;
  if (bytes.size() < sizeof expected) return std::nullopt;
  const std::size_t size = bytes.size() - sizeof expected;
  std::memcpy(&expected, bytes.data() + size, sizeof expected);
  if (checksum(bytes, size) != expected) return std::nullopt;
  Parts parts(bytes);
  Checkpoint checkpoint;
  checkpoint.signature = parts.text();
  checkpoint.reached = parts.number();
  const std::size_t series = parts.number();
  for (std::size_t s = 0; s < series; ++s) {
    checkpoint.rows.push_back(parts.number());
    checkpoint.open.push_back(parts.numbers());
  }
  return checkpoint;
}

}  // namespace millfoam::averaging
