// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/case_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "dem_driver/segments.hpp"
#include "dem_driver/wall_check.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

constexpr int longest_wait = 100;  // tenths of a second

}  // namespace

std::vector<std::string> find_walls(const CaseFolder& folder, const meshing::Mill& mill) {
  std::vector<std::string> parts{"shell"};
  if (mill.geometry.lifters.count > 0) parts.push_back("lifters");
  if (mill.geometry.ends == meshing::Ends::plain) parts.insert(parts.end(), {"feedEnd", "dischargeEnd"});
  for (const auto& part : parts) {
    const fs::path file = folder.walls() / (part + ".stl");
    if (!fs::exists(file)) throw std::runtime_error(file.string() + ": no such wall, run millMesh first");
    check_wall(file);
  }
  return parts;
}

std::vector<fs::path> find_dumps(const CaseFolder& folder) {
  std::vector<fs::path> dumps;
  if (!fs::is_directory(folder.dumps())) return dumps;
  for (const auto& entry : fs::directory_iterator(folder.dumps())) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("dump.", 0) == 0 && entry.path().extension() == ".txt") dumps.push_back(entry.path());
  }
  return dumps;
}

FolderLock::FolderLock(const CaseFolder& folder)
    : file_(open(folder.lock().c_str(), O_RDWR | O_CREAT, 0666)) {
  if (file_ < 0) throw std::runtime_error(folder.lock().string() + ": cannot be written");
  for (int tenth = 0; flock(file_, LOCK_EX | LOCK_NB) != 0; ++tenth) {
    if (tenth == longest_wait) {
      close(file_);
      throw std::runtime_error(folder.dem().string() +
                               ": another millDem runs there, expected one at a time");
    }
    usleep(100000);
  }
}

FolderLock::~FolderLock() {
  close(file_);
}

void remove_results(const CaseFolder& folder) {
  for (const auto& file :
       {folder.run_file(), folder.results(), folder.energy(), folder.overlaps(), folder.charge()})
    fs::remove(file);
}

std::size_t prepare_folders(const CaseFolder& folder) {
  fs::create_directories(folder.dem());
  fs::create_directories(folder.dumps());
  remove_results(folder);
  for (const auto& restart : find_restarts(folder)) fs::remove(restart.file);
  for (const char* kind : segment_kinds)
    for (const auto& segment : find_segments(folder, kind)) fs::remove(segment.file);
  for (const char* kind : contact_kinds)
    for (const auto& contacts : find_contacts(folder, kind)) fs::remove(contacts.file);
  const auto old = find_dumps(folder);
  for (const auto& dump : old) fs::remove(dump);
  return old.size();
}

std::string wall_checksums(const CaseFolder& folder, const std::vector<std::string>& parts) {
  std::ostringstream lines;
  for (const auto& part : parts) {
    std::ifstream in(folder.walls() / (part + ".stl"), std::ios::binary);
    std::uint64_t sum = 14695981039346656037U;
    for (std::istreambuf_iterator<char> byte(in), end; byte != end; ++byte)
      sum = (sum ^ static_cast<unsigned char>(*byte)) * 1099511628211U;
    lines << "# wall " << part << ".stl " << std::hex << sum << '\n';
  }
  return lines.str();
}

void write_whole_file(const fs::path& file, const std::function<void(std::ostream&)>& write) {
  const fs::path unfinished = file.string() + ".part";
  {
    std::ofstream out(unfinished);
    write(out);
    out.close();
    if (!out) throw std::runtime_error(unfinished.string() + ": cannot be written");
  }
  fs::rename(unfinished, file);
}

void write_run_file(const CaseFolder& folder, const meshing::Mill& mill, const DemPlan& plan) {
  write_whole_file(folder.run_file(), [&](std::ostream& out) {
    out.precision(std::numeric_limits<double>::max_digits10);
    out << "timestep " << plan.step.value << "\ninterval " << plan.step.steps_per_record
        << "\nangular_velocity " << mill.angular_velocity << '\n';
  });
}

}  // namespace millfoam::dem_driver
