// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "dem_driver/contact_statistics.hpp"
#include "dem_driver/wall_cells.hpp"

namespace millfoam::dem_driver {

/// Names of the segments that millLiggghts writes of the contacts, `dem/<name>.<step>.txt`.
inline constexpr char contact_work_kind[] = "contactWork";
/// See `contact_work_kind`.
inline constexpr char contact_bins_kind[] = "contactBins";
/// See `contact_work_kind`.
inline constexpr char wall_cells_kind[] = "wallCells";
/// Name of the file beside each restart file, `dem/<name>.<step>.txt`.
inline constexpr char contact_state_kind[] = "contactState";

/// Writes the segments of a run that begins or resumes at a step. Every call is on the disk before it
/// returns.
class ContactRecord {
 public:
  /// Begins the files. Throws std::runtime_error naming a file that cannot be written.
  ContactRecord(const std::filesystem::path& folder, const ContactKinds& kinds, long start);
  /// The sums of the `steps` steps up to `step`.
  /// @param step  the last one
  /// @param steps  their number
  /// @param sums  of all kinds
  /// @param spin  energy of all balls' spin at the end of `step`, J
  /// Throws as above.
  void write(long step, long steps, double spin, const ContactSums& sums);
  /// The same of the wall cells. Throws as above.
  void write(long step, long steps, const WallSums& sums);

 private:
  struct File {
    std::filesystem::path name;
    std::ofstream out;
    File(const std::filesystem::path& name, const std::string& head);
    void flush();
  };
  ContactKinds kinds_;
  File work_, bins_, walls_;
};

/// What a resumed run needs besides LIGGGHTS' restart file.
struct ContactState {
  std::vector<OpenContact> open;     ///< the contacts that have not ended
  long wall_steps = 0;               ///< in `wall_numbers`
  std::vector<double> wall_numbers;  ///< of WallSums; empty: all are 0
};

/// Writes `<folder>/contactState.<step>.txt`, which appears whole or not at all. Throws std::runtime_error
/// naming the file.
void write_contact_state(const std::filesystem::path& folder, long step, const ContactState& state);

/// Reads it back; nothing where there is no such file. Throws std::runtime_error naming file and line where
/// it cannot be read.
std::optional<ContactState> read_contact_state(const std::filesystem::path& folder, long step);

/// Whether that file is there.
bool has_contact_state(const std::filesystem::path& folder, long step);

}  // namespace millfoam::dem_driver
