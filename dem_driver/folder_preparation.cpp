// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/folder_preparation.hpp"

#include "dem_driver/segments.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

std::size_t prepare_folders(const CaseFolder& folder) {
  fs::create_directories(folder.dem());
  fs::create_directories(folder.dumps());
  remove_results(folder);
  fs::remove(folder.fluid_order());
  fs::remove(folder.contact_order());
  remove_contact_states(folder, [](long) { return true; });
  fs::remove(folder.averages_order());
  for (const auto& file : find_averages(folder)) fs::remove(file);
  for (const auto& restart : find_restarts(folder)) fs::remove(restart.file);
  for (const char* kind : segment_kinds)
    for (const auto& segment : find_segments(folder, kind)) fs::remove(segment.file);
  for (const char* kind : contact_kinds)
    for (const auto& contacts : find_contacts(folder, kind)) fs::remove(contacts.file);
  const auto old = find_dumps(folder);
  for (const auto& dump : old) fs::remove(dump);
  return old.size();
}

}  // namespace millfoam::dem_driver
