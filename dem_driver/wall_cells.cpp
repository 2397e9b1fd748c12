// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/wall_cells.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "meshing/surface/stl_file.hpp"

namespace millfoam::dem_driver {

namespace {

using Eigen::Vector3d;

Vector3d vector_of(const std::array<double, 3>& point) {
  return {point[0], point[1], point[2]};
}

std::array<double, 3> array_of(const Vector3d& point) {
  return {point.x(), point.y(), point.z()};
}

double longest_edge(const Triangle& triangle) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k)
    longest = std::max(longest, (vector_of(triangle[k]) - vector_of(triangle[(k + 1) % 3])).norm());
  return longest;
}

}  // namespace

WallCells::WallCells(const std::filesystem::path& folder, const std::vector<std::string>& parts,
                     double longest) {
  assert(longest > 0);
  for (const auto& name : parts) {
    Part part{name, {}, {}, {}};
    for (const auto& read : surface::read_stl(folder / (name + ".stl"))) {
      const Triangle triangle{array_of(read.corners[0]), array_of(read.corners[1]),
                              array_of(read.corners[2])};
      const double wished = std::ceil(longest_edge(triangle) / longest * (1 - 1e-9));
      const int n = static_cast<int>(std::clamp<double>(wished, 1, most_divisions));
      part.triangles.push_back(triangle);
      part.divisions.push_back(n);
      part.first.push_back(size_);
      size_ += static_cast<std::size_t>(n * n);
    }
    parts_.push_back(std::move(part));
  }
}

std::size_t WallCells::cell_of(std::size_t part, std::size_t triangle,
                               const std::array<double, 3>& point) const {
  const Part& of = parts_[part];
  const Triangle& corners = of.triangles[triangle];
  const int n = of.divisions[triangle];
  const Vector3d origin = vector_of(corners[0]);
  const Vector3d first = vector_of(corners[1]) - origin, second = vector_of(corners[2]) - origin;
  const Vector3d to = vector_of(point) - origin;
  const double a = first.dot(first), b = first.dot(second), c = second.dot(second);
  const double determinant = a * c - b * b;
  const double u = std::max(0.0, (c * to.dot(first) - b * to.dot(second)) / determinant) * n;
  const double v = std::max(0.0, (a * to.dot(second) - b * to.dot(first)) / determinant) * n;
  const int i = std::min(static_cast<int>(std::min<double>(u, n)), n - 1);
  const int j = std::min(static_cast<int>(std::min<double>(v, n)), n - 1 - i);
  const bool upper = i + j < n - 1 && (u - i) + (v - j) > 1;
  // Row i has 2 (n - i) - 1 cells
  return of.first[triangle] + static_cast<std::size_t>(i * (2 * n - i) + 2 * j + (upper ? 1 : 0));
}

std::vector<Triangle> WallCells::corners() const {
  std::vector<Triangle> cells;
  cells.reserve(size_);
  for (const Part& part : parts_)
    for (std::size_t t = 0; t < part.triangles.size(); ++t) {
      const Triangle& corners = part.triangles[t];
      const int n = part.divisions[t];
      const auto at = [&](int i, int j) {
        const Vector3d origin = vector_of(corners[0]);
        return array_of(origin + (vector_of(corners[1]) - origin) * i / n +
                        (vector_of(corners[2]) - origin) * j / n);
      };
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n - i; ++j) {
          cells.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
          if (i + j < n - 1) cells.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
  return cells;
}

std::vector<int> WallCells::part_of_cells() const {
  std::vector<int> parts;
  for (std::size_t p = 0; p < parts_.size(); ++p)
    for (const int n : parts_[p].divisions)
      parts.insert(parts.end(), static_cast<std::size_t>(n * n), static_cast<int>(p));
  return parts;
}

double area_of(const Triangle& triangle) {
  const Vector3d origin = vector_of(triangle[0]);
  return (vector_of(triangle[1]) - origin).cross(vector_of(triangle[2]) - origin).norm() / 2;
}

void WallSums::add(std::size_t cell, const ContactForce& contact, double moment, const ContactWork& work) {
  const double shear = vector_of(tangential_force(contact)).norm();
  const double values[numbers_per_wall_cell] = {
      1,      contact.push, shear,          -contact.force[0], -contact.force[1], -contact.force[2],
      moment, work.normal,  work.tangential};
  add(cell, values);
}

void WallSums::add(std::size_t cell, const double* values) {
  double* at = numbers.data() + cell * numbers_per_wall_cell;
  for (std::size_t k = 0; k < numbers_per_wall_cell; ++k) at[k] += values[k];
}

WallCellSums WallSums::of(std::size_t cell) const {
  const double* at = numbers.data() + cell * numbers_per_wall_cell;
  return {at[0], at[1], at[2], {at[3], at[4], at[5]}, at[6], at[7], at[8]};
}

void WallSums::clear() {
  std::fill(numbers.begin(), numbers.end(), 0.0);
}

}  // namespace millfoam::dem_driver
