// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "dem_driver/case_folder.hpp"
#include "dem_driver/contact_order.hpp"
#include "dem_driver/contact_statistics.hpp"
#include "dem_driver/wall_cells.hpp"

namespace millfoam::dem_driver {

/// The contacts of some steps that follow each other.
struct ContactBlock {
  long step = 0;     ///< the last one
  long steps = 0;    ///< their number
  double spin = 0;   ///< energy of all balls' spin at the end of the last one, J
  ContactSums sums;  ///< over them
};

/// All blocks that millLiggghts has written, in order. Throws std::runtime_error naming file and line where
/// they cannot be read.
std::vector<ContactBlock> read_contact_blocks(const CaseFolder& folder, const ContactOrder& order);

/// Sums over the steps after `begin` up to `end`.
struct ContactSpan {
  long begin = 0;        ///< step
  long end = 0;          ///< step
  double spin_gain = 0;  ///< of the energy of spin, J; 0 where that at the begin is not known
  ContactSums sums;      ///< of all kinds
};

/// The blocks that begin at `from` (a step) or later, but at least the last one; not the run's first block,
/// if there are others, because energies at its begin are not recorded.
ContactSpan sum_blocks(const std::vector<ContactBlock>& blocks, const ContactOrder& order, long from);

/// What the mill gives to the charge at one record.
struct DriveRow {
  long step = 0;      ///< at the record's end
  double power = 0;   ///< of the mill's drive and of the fluid, mean over the record's steps, W
  double torque = 0;  ///< of the charge on the walls that turn, mean over the record's steps, N m
  double energy = 0;  ///< kinetic of translation and potential, at the record's end, J
};

/// What the contacts take and what the drive gives, in the same steps, W.
struct ContactBalance {
  ContactWork power;  ///< of the contacts
  double drive = 0;   ///< of the mill's drive, and of the fluid
  double gain = 0;    ///< of the charge's kinetic energy, of spin too, and potential energy
  double torque = 0;  ///< of the charge on the walls that turn, N m
  /// What the contacts take over what the drive gives less the gain; 1 where the energy is balanced.
  double ratio() const { return power.total() / (drive - gain); }
};

/// The balance of a span. A span that begins before the first row has the gain from that row on. Throws
/// std::runtime_error where rows are missing.
ContactBalance balance_of(const ContactSpan& span, const ContactOrder& order,
                          const std::vector<DriveRow>& rows);

/// The wall cells of a span.
struct WallSpan {
  long begin = 0;  ///< step
  long end = 0;    ///< step
  WallSums sums;   ///< of all cells
};

/// The records of the wall cells that begin at `from` (a step) or later, but at least the last one. Throws as
/// read_contact_blocks.
WallSpan read_wall_span(const CaseFolder& folder, const WallCells& cells, long from);

/// The contacts of a run.
struct ContactResults {
  ContactOrder order;                    ///< of the run
  std::vector<ContactBlock> blocks;      ///< in order of time
  ContactSpan span;                      ///< of the steady part
  ContactBalance balance;                ///< of `span`
  WallSpan walls;                        ///< of the steady part
  double time() const;                   ///< of `span`, s
  double collisions_per_second() const;  ///< in `span`
  /// Of the forces on the cells of the walls that turn, about the axis, N m, mean over `walls`.
  double wall_torque() const;
};

/// Reads what millLiggghts has written. Throws as the functions above.
/// @param folder  of the case
/// @param order  of the run
/// @param rows  of the drive, one for each record
/// @param from  step from which the run is steady
ContactResults gather_contacts(const CaseFolder& folder, const ContactOrder& order,
                               const std::vector<DriveRow>& rows, long from);

/// Writes `dumps/contact_power.csv`, `dumps/contact_spectra.csv` and `dumps/wall_forces.vtp` (FORMATS.md).
/// Throws std::runtime_error naming a file that cannot be written.
void write_contact_files(const CaseFolder& folder, const ContactResults& contacts);

/// The entry `contacts` of results.json, as text of JSON.
std::string contact_entry(const ContactResults& contacts);

/// Prints the same in words.
void print_contacts(std::ostream& out, const ContactResults& contacts);

}  // namespace millfoam::dem_driver
