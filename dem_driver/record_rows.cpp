// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/record_rows.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include "dem_driver/deck_outputs.hpp"
#include "dem_driver/segments.hpp"
#include "dem_driver/wall_parts.hpp"

namespace millfoam::dem_driver {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t histogram_numbers = 6;  // step, bins, contacts within and beyond, least, largest
constexpr std::size_t bin_numbers = 4;        // number, middle, contacts, share

/// The lines of a file from a byte on, without comments and without a half line at its end.
class Lines {
 public:
  Lines(const fs::path& file, std::uintmax_t begin, long line)
      : in_(file, std::ios::binary), bytes_(begin), line_(line) {
    in_.seekg(static_cast<std::streamoff>(begin));
  }
  bool next() {
    while (std::getline(in_, text_) && !in_.eof()) {
      bytes_ += text_.size() + 1;
      ++line_;
      if (!text_.empty() && text_.front() != '#') return true;
    }
    return false;
  }
  const std::string& text() const { return text_; }
  /// Of the file, up to the end of this line.
  std::uintmax_t bytes() const { return bytes_; }
  long line() const { return line_; }

 private:
  std::ifstream in_;
  std::string text_;
  std::uintmax_t bytes_;
  long line_;
};

std::string refusal(const Lines& lines, const std::string& expected) {
  constexpr std::size_t shown = 80;
  const std::string text = lines.text().substr(0, shown) + (lines.text().size() > shown ? "..." : "");
  return ": line " + std::to_string(lines.line()) + " is '" + text + "', expected " + expected;
}

/// Whether the lines that follow are those of a whole histogram; the complaint where they are not.
std::string bins_complaint(Lines& lines, long bins, long step) {
  const std::string of_step = " bins of step " + std::to_string(step);
  for (long bin = 1; bin <= bins; ++bin) {
    if (!lines.next())
      return " with " + std::to_string(bin - 1) + of_step + ", expected " + std::to_string(bins);
    const auto values = numbers_of(lines.text());
    if (!values || values->size() != bin_numbers || values->front() != static_cast<double>(bin))
      return refusal(lines, "bin " + std::to_string(bin) + " of the" + of_step);
  }
  return {};
}

bool has_numbers(const RowKind& kind, const std::optional<std::vector<double>>& values) {
  return values && std::find(kind.numbers.begin(), kind.numbers.end(), values->size()) != kind.numbers.end();
}

/// A segment and the step up to which it has the rows of the run.
struct Piece {
  NumberedFile segment;
  long end = 0;
};

/// The segments of a kind that hold the rows up to a step: each up to the begin of the next one.
std::vector<Piece> pieces_until(const CaseFolder& folder, const RowKind& kind, long step) {
  std::vector<Piece> pieces;
  for (const NumberedFile& segment : find_segments(folder, kind.name)) {
    if (segment.step >= step && !pieces.empty()) break;
    if (!pieces.empty()) pieces.back().end = segment.step;
    pieces.push_back({segment, step});
  }
  return pieces;
}

}  // namespace

std::vector<RowKind> row_kinds(const CaseFolder& folder, const DemPlan& plan) {
  std::vector<RowKind> kinds{{"torque", {2}}, {"energy", {3}, true}};
  if (!find_segments(folder, part_torques_kind).empty())
    kinds.push_back({part_torques_kind, {1 + std::size(stirred_parts)}});
  // Ledgers of millFoam 0.2.0 have no balance
  if (plan.fluid.kind != FluidKind::none) kinds.push_back({"fluid", {11, 10}});
  for (const char* name : {"ballOverlaps", "wallOverlaps"})
    kinds.push_back({name, {histogram_numbers}, false, overlap_bins});
  return kinds;
}

RowCheck::RowCheck(const CaseFolder& folder, RowKind kind, long begin, long record)
    : kind_(std::move(kind)),
      file_(folder.dem() / (kind_.name + '.' + std::to_string(begin) + ".txt")),
      record_(record),
      next_(kind_.at_begin ? begin : begin + record) {}

std::string RowCheck::complaint(long step) {
  const std::string wrong = fault(step);
  if (wrong.empty()) return {};
  std::error_code none;
  const auto bytes = fs::file_size(file_, none);
  return none ? "no such file, expected " + kind_.name + " of the run"
              : std::to_string(bytes) + " bytes" + wrong;
}

std::string RowCheck::fault(long step) {
  Lines lines(file_, whole_bytes_, line_);
  while ((kind_.is_histogram() || next_ <= step) && lines.next()) {
    const auto values = numbers_of(lines.text());
    if (values && !values->empty() && values->front() > static_cast<double>(step)) break;
    if (!has_numbers(kind_, values) ||
        (!kind_.is_histogram() && values->front() != static_cast<double>(next_)))
      return refusal(lines, kind_.is_histogram() ? "the first line of a histogram"
                                                 : std::to_string(kind_.numbers.front()) +
                                                       " numbers of step " + std::to_string(next_));
    if (kind_.is_histogram()) {
      const std::string wrong = bins_complaint(lines, kind_.bins, static_cast<long>(values->front()));
      if (!wrong.empty()) return wrong;
    } else {
      next_ += record_;
    }
    whole_bytes_ = lines.bytes();
    line_ = lines.line();
  }
  if (!kind_.is_histogram() && next_ <= step)
    return " without a whole line of step " + std::to_string(next_) + ", expected one";
  return {};
}

std::string rows_complaint(const CaseFolder& folder, const DemPlan& plan, long step) {
  for (const RowKind& kind : row_kinds(folder, plan)) {
    const auto pieces = pieces_until(folder, kind, step);
    RowCheck first(folder, kind, plan.begin, plan.step.steps_per_record);
    if (pieces.empty() || pieces.front().segment.step != plan.begin) {
      const std::string wrong = first.complaint(step);
      if (!wrong.empty()) return first.file().string() + ": " + wrong;
    }
    for (const Piece& piece : pieces) {
      RowCheck check(folder, kind, piece.segment.step, plan.step.steps_per_record);
      const std::string wrong = check.complaint(piece.end);
      if (!wrong.empty()) return check.file().string() + ": " + wrong;
    }
  }
  return {};
}

void cut_rows_after(const CaseFolder& folder, const DemPlan& plan, long step) {
  for (const RowKind& kind : row_kinds(folder, plan))
    for (const Piece& piece : pieces_until(folder, kind, step)) {
      RowCheck check(folder, kind, piece.segment.step, plan.step.steps_per_record);
      check.complaint(piece.end);
      if (fs::file_size(check.file()) > check.whole_bytes())
        fs::resize_file(check.file(), check.whole_bytes());
    }
}

}  // namespace millfoam::dem_driver
