// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "averaging/files/hdf5_handle.hpp"

/// @file
/// Files that say what they are and whether they are complete. All functions throw hdf5::Error.

namespace millfoam::averaging::hdf5 {

/// Makes a new file, replacing an older one.
Handle create_file(const std::filesystem::path& path);

/// Opens a file to read it, without HDF5's locks, so that the ranks of a parallel flow can share it on any
/// file system. Says so where only the unfinished file `path` + ".part" is there, and for a file that is cut
/// short or no HDF5 file.
/// @param path  of the file
/// @param maker  that makes such files, for the message
Handle open_file(const std::filesystem::path& path, const std::string& maker = "the program that writes it");

/// Throws where there is something at `path` that is no file of this format, whole or not and of any version:
/// it would be overwritten.
void require_format_or_nothing(const std::filesystem::path& path, const std::string& format);

/// Throws unless the attributes `format`, `version` and `complete` of a file say that it is of this format
/// and of one of these versions, and whole. `advice` ends the message about another version.
void check_format(hid_t file, const std::string& format, const std::vector<int>& versions,
                  const std::string& advice);

/// Pushes all that was written to the disk.
void flush(hid_t file);

/// Gives a finished file its name, replacing an older one.
void rename_file(const std::filesystem::path& part, const std::filesystem::path& path);

}  // namespace millfoam::averaging::hdf5
