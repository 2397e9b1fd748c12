// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "averaging/dumps/dump_error.hpp"
#include "averaging/values/particle.hpp"

namespace millfoam::averaging {

/// Parses one record in the text layout of LIGGGHTS' and LAMMPS' `dump custom`: the items TIMESTEP, NUMBER OF
/// ATOMS, BOX BOUNDS and ATOMS. Lines end with LF or CR LF, the last one too: without it a cut number would
/// look like a whole one. The item UNITS must be si. Items of other names are passed over.
///
/// The columns are found by name, in any order and among any others:
///
///     id vx vy vz                          always
///     x y z, or xu yu zu                   position, or that which is not wrapped at periodic boundaries
///     xs ys zs, or xsu ysu zsu             the same as parts of this record's box: x = xlo + xs (xhi - xlo)
///     radius                               of spheres
///     shapex shapey shapez                 half axes of superquadrics,
///     quat1 quat2 quat3 quat4              their quaternion, scalar part first,
///     blockiness1 blockiness2              and exponents, 2 and 2 without these columns
///
/// With shapes, Particle::radius is that of the smallest sphere around one.
/// @param text  the whole file
/// @param name  the file's name, for messages
///
/// Throws DumpError for fewer or more lines than the header says, units other than si, a missing column, more
/// than one kind of position, scaled positions in a tilted box, shapes that are not complete, a value that is
/// not a finite number, a radius or half axis that is not positive, a blockiness below 2, a quaternion that
/// is not of length 1 (it may be off by a half, and is normalised), two particles of one id, or a second
/// record.
ParticleRecord parse_dump(std::string_view text, const std::string& name);

/// Reads one record from a file, plain or gzip. Throws DumpError as `parse_dump`, for a file that cannot be
/// read to its end, and for a line of more than 1 MiB.
ParticleRecord read_dump(const std::filesystem::path& file);

}  // namespace millfoam::averaging
