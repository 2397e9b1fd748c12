// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/dump_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <variant>

#include "averaging/dumps/dump_error.hpp"

namespace millfoam::averaging {

namespace {

/// A grid along an axis.
struct Span {
  double length = 0;     ///< m
  bool repeats = false;  ///< after this length
};

using Spans = std::array<std::optional<Span>, 3>;

Spans spans_of(const BoxGrid& grid) {
  Spans spans;
  for (std::size_t axis = 0; axis < 3; ++axis)
    spans[axis] = {grid.upper()[axis] - grid.lower()[axis], grid.periodic()[axis]};
  return spans;
}

Spans spans_of(const CylinderGrid& grid) {
  return {std::nullopt, std::nullopt, Span{grid.ends()[1] - grid.ends()[0], grid.periodic_z()}};
}

/// Of a request, before its mesh is read: where it repeats.
Spans spans_of(const GridRequest& request) {
  if (const auto* box = std::get_if<BoxGrid>(&request)) return spans_of(*box);
  if (const auto* cylinder = std::get_if<CylinderRequest>(&request)) return spans_of(cylinder->grid);
  const auto& period = std::get<MeshRequest>(request).period_z;
  if (!period) return {};
  return {std::nullopt, std::nullopt, Span{*period, true}};
}

/// Of a mesh that does not repeat: from its lowest to its highest point.
Span height_of(const MeshCells& mesh) {
  if (mesh.points.empty()) return {};
  double low = mesh.points[2], high = low;
  for (std::size_t i = 2; i < mesh.points.size(); i += 3) {
    low = std::min(low, mesh.points[i]);
    high = std::max(high, mesh.points[i]);
  }
  return {high - low, false};
}

double period_of(const DumpBox& box, std::size_t axis) {
  return box.upper[axis] - box.lower[axis];
}

/// Whether a length is that of the dumps, whose bounds are written with six digits.
bool is_period(double length, const DumpBox& box, std::size_t axis) {
  const double largest = std::max(std::abs(box.lower[axis]), std::abs(box.upper[axis]));
  return std::abs(length - period_of(box, axis)) <= 2e-5 * std::max(length, largest);
}

}  // namespace

void check_numbers_of_balls(const std::vector<DumpFile>& dumps, std::size_t first, std::size_t end,
                            const std::function<void(const std::string&)>& note) {
  bool noted = false;
  std::size_t last_with_balls = end;
  for (std::size_t r = first; r < end; ++r) {
    const auto count = dumps[r].count;
    if (!count) continue;
    if (r > first && dumps[r - 1].count && *dumps[r - 1].count != *count && !noted) {
      noted = true;
      note("warning: " + dumps[r].path.string() + " has " + std::to_string(*count) +
           " balls, the dump before it has " + std::to_string(*dumps[r - 1].count) +
           ": balls were lost or added, or a dump is of another run");
    }
    if (*count == 0) continue;
    const bool gap = last_with_balls < end && r > last_with_balls + 1 && dumps[r - 1].count == 0;
    if (gap)
      throw DumpError(dumps[r - 1].path.string() +
                      ": the dump has no balls, expected some as in the dumps before and after it");
    last_with_balls = r;
  }
}

void VolumeCheck::add(std::size_t number, double volume) {
  const double before = std::exchange(volume_before_, volume);
  const std::optional<std::size_t> last = std::exchange(before_, number);
  if (!last || *last + 1 != number) return;
  const DumpFile &dump = dumps_[number], &earlier = dumps_[*last];
  if (!dump.count || dump.count != earlier.count || !(volume > 0 && before > 0)) return;
  const double ratio = std::max(volume / before, before / volume);
  if (ratio <= 1 + noted_volume_change || (noted_ && ratio <= largest_volume_ratio)) return;
  std::ostringstream sentence;
  sentence << dump.path.string() << ": the volume of the balls is " << volume
           << " m3, that of as many balls in " << earlier.path.string() << " is " << before << " m3";
  if (ratio > largest_volume_ratio)
    throw DumpError(sentence.str() + "; expected about the same: is one of them in another unit than m?");
  noted_ = true;
  note_("warning: " + sentence.str());
}

void require_period_of(const AverageRequest& request, const DumpBox& box, const std::string& name) {
  const Spans spans = spans_of(request.grid);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& span = spans[axis];
    if (!span || !span->repeats || box.flags[axis].empty()) continue;
    const bool periodic = box.periodic()[axis];
    if (periodic && is_period(span->length, box, axis)) continue;
    const std::string letter(1, "xyz"[axis]);
    const bool mesh = std::holds_alternative<MeshRequest>(request.grid);
    std::ostringstream message;
    message.precision(12);
    message << (mesh ? "--period" : "--periodic " + letter) << ": the cells repeat after " << span->length
            << " m along " << letter << ", but the balls of " << name;
    if (periodic)
      message << " after " << period_of(box, axis) << " m (from " << box.lower[axis] << " to "
              << box.upper[axis] << " m); expected the same length";
    else
      message << " do not: the flags of their box along " << letter << " are " << box.flags[axis]
              << "; expected pp, or cells that do not repeat";
    throw std::invalid_argument(message.str());
  }
}

std::string missing_period(const AverageRequest& request, const Grid& grid, const DumpBox& box,
                           double outside) {
  constexpr double nothing = 1e-9;  // round-off of the deposits
  if (outside <= nothing) return {};
  Spans spans = spans_of(request.grid);
  const auto* mesh = std::get_if<MeshCells>(&grid);
  if (mesh != nullptr && !spans[2]) spans[2] = height_of(*mesh);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& span = spans[axis];
    if (!span || span->repeats || !box.periodic()[axis] || !is_period(span->length, box, axis)) continue;
    const std::string letter(1, "xyz"[axis]);
    std::ostringstream sentence;
    sentence << "warning: " << 100 * outside
             << " % of the balls' volume lies outside the cells: the balls repeat "
             << "along " << letter << " after " << period_of(box, axis)
             << " m and the cells do not; expected ";
    if (mesh != nullptr)
      sentence << "--period " << span->length;
    else
      sentence << "--periodic " << letter;
    return sentence.str();
  }
  return {};
}

}  // namespace millfoam::averaging
