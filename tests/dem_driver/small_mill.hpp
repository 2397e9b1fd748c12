// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/dem_plan.hpp"
#include "meshing/mill/mill.hpp"

namespace millfoam::dem_driver::tests {

/// A smooth periodic drum of 40 mm diameter, turning clockwise, with 150 balls of 3 mm and 100 of 2 mm.
meshing::Mill small_mill();

/// A folder with a blank in its name, removed at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Writes a file whose end is that of LIGGGHTS' restart files, one block of so many balls for each rank.
void write_restart(const std::filesystem::path& file, const std::vector<int>& balls_of_ranks);

/// Writes the torques and energies of the records up to a step: torque -1 N m, energies 1 and -2 J.
void write_rows(const CaseFolder& folder, const DemPlan& plan, long step);

/// Writes `walls/shell.stl` of a smooth drum, 60 flat sides.
void write_drum(const CaseFolder& folder, const meshing::Geometry& geometry);

/// The facets of such a drum alone, and those of the disc that closes it at `z`, m.
void write_shell(std::ostream& out, const meshing::Geometry& geometry);
void write_disc(std::ostream& out, const meshing::Geometry& geometry, double z);

/// The content of a JSON file.
nlohmann::json read_json(const std::filesystem::path& file);

/// Writes a shell script that can be run.
void write_script(const std::filesystem::path& file, const std::string& commands);

/// Script of an mpirun that does what Open MPI's does when it has fewer slots than requested.
inline constexpr char refusal_of_open_mpi[] = R"(cat <<'END'
--------------------------------------------------------------------------
There are not enough slots available in the system to satisfy the 64
slots that were requested by the application:

  /usr/bin/setpriv

Either request fewer slots for your application, or make more slots
available for use.

A "slot" is the Open MPI term for an allocatable unit where we can
launch a process.  The number of slots available are defined by the
environment in which Open MPI processes are run:

  1. Hostfile, via "slots=N" clauses (N defaults to number of
     processor cores if not provided)
  2. The --host command line parameter, via a ":N" suffix on the
     hostname (N defaults to 1 if not provided)
--------------------------------------------------------------------------
END
exit 1)";

/// Sets a variable of the environment for the life of the object.
class Variable {
 public:
  Variable(std::string name, const std::string& value);
  ~Variable();
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  std::string name_;
  std::optional<std::string> before_;
};

/// The message of what `action` throws; empty when it throws nothing.
template <typename Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace millfoam::dem_driver::tests
