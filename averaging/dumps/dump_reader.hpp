// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "averaging/dumps/particle.hpp"

namespace millfoam::averaging {

/// Dumps that cannot be used; the message begins with "file:line:" or the file's name.
class DumpError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// All balls at one time.
struct ParticleRecord {
  long long step = 0;  ///< DEM time-step
  std::vector<Particle> particles;
  std::vector<Superquadric> shapes;  ///< [particles], or empty when all are spheres
};

/// Parses one record in the text layout of LIGGGHTS' and LAMMPS' `dump custom`: the items TIMESTEP, NUMBER OF
/// ATOMS, BOX BOUNDS and ATOMS, the last with the columns id x y z vx vy vz radius in any order and among any
/// others. Lines end with LF or CR LF, the last one too: without it a cut number would look like a whole one.
/// Items of other names are passed over.
/// @param text  the whole file
/// @param name  the file's name, for messages
/// Throws DumpError for fewer or more lines than the header says, a missing column, a value that is not a
/// finite number, a radius that is not positive, or a second record.
ParticleRecord parse_dump(std::string_view text, const std::string& name);

/// Reads one record from a file, plain or gzip. Throws DumpError as `parse_dump`, and for a file that cannot
/// be read.
ParticleRecord read_dump(const std::filesystem::path& file);

/// Reads the time-step out of a dump's header only. Throws DumpError.
long long read_dump_step(const std::filesystem::path& file);

}  // namespace millfoam::averaging
