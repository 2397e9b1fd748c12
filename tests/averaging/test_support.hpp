// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "averaging/dumps/dump_reader.hpp"
#include "meshing/surface/pi.hpp"

namespace millfoam::averaging {

inline double sphere_volume(double radius) {
  return 4.0 / 3.0 * pi * radius * radius * radius;
}

/// A folder that is gone when the test is over.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "averaging_test_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// Text of a dump as LIGGGHTS writes it, with enough digits to read back the same numbers.
/// @param flags  of the ends of its box along x, y and z
inline std::string dump_text(long long step, const std::vector<Particle>& particles,
                             const std::string& flags = "mm mm pp") {
  std::ostringstream text;
  text.precision(17);
  text << "ITEM: TIMESTEP\n"
       << step << "\nITEM: NUMBER OF ATOMS\n"
       << particles.size() << "\nITEM: BOX BOUNDS " << flags
       << "\n-1 1\n-1 1\n0 1\nITEM: ATOMS id type x y z vx vy vz radius \n";
  for (const Particle& p : particles) {
    text << p.id << " 1";
    for (const double value : p.position) text << ' ' << value;
    for (const double value : p.velocity) text << ' ' << value;
    text << ' ' << p.radius << " \n";
  }
  return text.str();
}

/// The message of the `Exception` that `action` throws; fails the test when it throws none.
template <typename Exception, typename Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

/// Why a dump of that text is refused.
inline std::string refusal_of_dump(const std::string& text) {
  return message_of<DumpError>([&] { parse_dump(text, "dump7.txt"); });
}

/// Expects `text` to hold each of the parts.
inline void expect_named(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
  }
}

}  // namespace millfoam::averaging
