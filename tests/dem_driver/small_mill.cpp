// SPDX-License-Identifier: GPL-3.0-or-later
#include "small_mill.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "meshing/surface/pi.hpp"

namespace millfoam::dem_driver::tests {

namespace fs = std::filesystem;

namespace {

using Point = std::array<double, 3>;

double ball_mass(double diameter) {
  return 2500 * pi / 6 * std::pow(diameter, 3);
}

constexpr int sides = 60;

Point rim(const meshing::Geometry& geometry, int side, double z) {
  const double angle = 2 * pi * (side % sides) / sides;
  return {geometry.radius() * std::cos(angle), geometry.radius() * std::sin(angle), z};
}

void write_facet(std::ostream& out, const std::array<Point, 3>& corners) {
  out << "facet normal 0 0 0\nouter loop\n";
  for (const auto& point : corners)
    out << "vertex " << point[0] << ' ' << point[1] << ' ' << point[2] << '\n';
  out << "endloop\nendfacet\n";
}

}  // namespace

meshing::Mill small_mill() {
  meshing::Mill mill;
  mill.title = "small drum";
  mill.geometry.diameter = 0.04;
  mill.geometry.length = 0.012;
  mill.geometry.ends = meshing::Ends::periodic;
  mill.angular_velocity = -12;
  mill.charge.classes = {{0.002, 100 * ball_mass(0.002)}, {0.003, 150 * ball_mass(0.003)}};
  mill.charge.start_radius = 0.018;
  mill.charge.start_length = 0.01;
  mill.ball = {2500, 6e10, 0.25};
  mill.wall = {2700, 7e10, 0.3};
  mill.ball_ball = {0.8, 0.5, 0.01};
  mill.ball_wall = {0.7, 0.4, 0.02};
  mill.dem.youngs_modulus = 5e6;
  mill.dem.rayleigh_fraction = 0.2;
  mill.dem.settle_time = 0.15;
  mill.dem.duration = 0.3;
  mill.dem.record_interval = 0.01;
  mill.dem.seed = 7;
  return mill;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "dem driver XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder: " + name);
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void write_shell(std::ostream& out, const meshing::Geometry& geometry) {
  for (int i = 0; i < sides; ++i) {
    const Point a = rim(geometry, i, 0), b = rim(geometry, i + 1, 0);
    const Point c = rim(geometry, i, geometry.length), d = rim(geometry, i + 1, geometry.length);
    write_facet(out, {a, b, d});
    write_facet(out, {a, d, c});
  }
}

void write_disc(std::ostream& out, const meshing::Geometry& geometry, double z) {
  for (int i = 0; i < sides; ++i)
    write_facet(out, {Point{0, 0, z}, rim(geometry, i, z), rim(geometry, i + 1, z)});
}

void write_drum(const CaseFolder& folder, const meshing::Geometry& geometry) {
  fs::create_directories(folder.walls());
  std::ofstream out(folder.walls() / "shell.stl");
  out.precision(12);
  out << "solid shell\n";
  write_shell(out, geometry);
  out << "endsolid shell\n";
}

void write_restart(const fs::path& file, const std::vector<int>& balls_of_ranks) {
  std::ofstream out(file, std::ios::binary);
  const auto put = [&](const auto& number) {
    out.write(reinterpret_cast<const char*>(&number), sizeof number);
  };
  out << "LIGGGHTS and what it writes before the balls\n";
  for (const int balls : balls_of_ranks) {
    // Balls with and without contacts have records of 20 and 28 numbers.
    put(std::int32_t{20 * ((balls + 1) / 2) + 28 * (balls / 2)});
    for (int ball = 0; ball < balls; ++ball) {
      const int length = ball % 2 == 0 ? 20 : 28;
      put(double(length));
      for (int number = 1; number < length; ++number) put(0.001 * number - 0.01 * ball);
    }
  }
}

void write_rows(const CaseFolder& folder, const DemPlan& plan, long step) {
  std::ofstream torque(folder.dem() / "torque.0.txt"), energy(folder.dem() / "energy.0.txt");
  torque << "# Time-averaged data for fix torque\n# TimeStep v_torque\n";
  energy << "# Time-averaged data for fix energy\n# TimeStep c_kinetic c_potential\n0 1 -2\n";
  for (long at = plan.step.steps_per_record; at <= step; at += plan.step.steps_per_record) {
    torque << at << " -1\n";
    energy << at << " 1 -2\n";
  }
}

nlohmann::json read_json(const fs::path& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in);
}

void write_script(const fs::path& file, const std::string& commands) {
  std::ofstream(file) << "#!/bin/sh\n" << commands << '\n';
  fs::permissions(file, fs::perms::owner_all);
}

Variable::Variable(std::string name, const std::string& value) : name_(std::move(name)) {
  if (const char* before = std::getenv(name_.c_str())) before_ = before;
  setenv(name_.c_str(), value.c_str(), 1);
}

Variable::~Variable() {
  if (before_)
    setenv(name_.c_str(), before_->c_str(), 1);
  else
    unsetenv(name_.c_str());
}

}  // namespace millfoam::dem_driver::tests
