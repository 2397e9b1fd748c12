// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/files/file_fingerprint.hpp"

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace millfoam {
namespace {

class Fnv {
 public:
  void add(const char* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      sum_ = (sum_ ^ static_cast<unsigned char>(bytes[i])) * 1099511628211U;
  }
  std::string digits() const {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(sum_));
    return text;
  }

 private:
  std::uint64_t sum_ = 14695981039346656037U;
};

}  // namespace

std::string fingerprint(const std::string& bytes) {
  Fnv sum;
  sum.add(bytes.data(), bytes.size());
  return sum.digits();
}

std::string file_fingerprint(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  Fnv sum;
  std::vector<char> bytes(1 << 16);
  do {
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    sum.add(bytes.data(), static_cast<std::size_t>(in.gcount()));
  } while (in);
  if (!in.eof()) throw std::runtime_error(file.string() + ": cannot be read");
  return sum.digits();
}

}  // namespace millfoam
