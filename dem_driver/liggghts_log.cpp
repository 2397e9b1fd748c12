// SPDX-License-Identifier: GPL-3.0-or-later
#include "dem_driver/liggghts_log.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "dem_driver/deck.hpp"

namespace millfoam::dem_driver {

namespace {

constexpr std::size_t head_length = 5;
constexpr std::size_t tail_length = 12;

std::vector<std::string> split(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

bool starts_with(const std::string& text, const std::string& start) {
  return text.rfind(start, 0) == 0;
}

/// "LIGGGHTS-PUBLIC 3.8.0" of the line "LIGGGHTS (Version LIGGGHTS-PUBLIC 3.8.0, compiled …)".
std::string version_in(const std::string& line) {
  const std::string before = "(Version ";
  const auto begin = line.find(before);
  if (begin == std::string::npos) return {};
  const auto end = line.find_first_of(",)", begin);
  return line.substr(begin + before.size(), end == std::string::npos ? end : end - begin - before.size());
}

/// A line of dashes, between which Open MPI puts its messages.
bool is_rule(const std::string& line) {
  return line.find_first_not_of('-') == std::string::npos;
}

std::string indented(const std::string& line) {
  return "  " + line + '\n';
}

/// LIGGGHTS mixes warnings into its table, so only a line of numbers is a row.
bool is_row(const std::vector<std::string>& words, std::size_t columns) {
  if (words.size() != columns) return false;
  return std::all_of(words.begin(), words.end(), [](const std::string& word) {
    char* end = nullptr;
    std::strtod(word.c_str(), &end);
    return *end == '\0';
  });
}

}  // namespace

LiggghtsLog::LiggghtsLog(const DemPlan& plan, bool resumed)
    : plan_(plan), expected_balls_(resumed || plan.continues() ? plan.charge.balls() : 0) {}

void LiggghtsLog::read(const std::string& line) {
  if (line.empty()) return;
  tail_.push_back(line);
  if (tail_.size() > tail_length) tail_.pop_front();
  if (head_.size() < head_length && !is_rule(line)) head_.push_back(line);

  const auto words = split(line);
  if (starts_with(line, "LIGGGHTS (")) {
    begun_ = true;
    version_ = version_in(line);
  } else if (starts_with(line, "ERROR")) {
    if (error_.empty()) error_ = line;
  } else if (starts_with(line, inserted_mark)) {
    read_insertion(line);
  } else if (starts_with(line, turning_mark)) {
    turning_ = true;
    last_step_ = plan_.begin;
  } else if (starts_with(line, restart_mark)) {
    restart_step_ = std::atol(line.c_str() + std::string(restart_mark).size());
    dumped_until_ = restart_step_;
  } else if (starts_with(line, finished_mark)) {
    finished_ = true;
  } else if (words.size() >= 3 && words[0] == "Step" && words[1] == "Atoms") {
    columns_ = words;
  } else if (starts_with(line, "Loop time")) {
    columns_.clear();
  } else if (!columns_.empty() && is_row(words, columns_.size())) {
    read_thermo(words);
  }
}

void LiggghtsLog::read_thermo(const std::vector<std::string>& words) {
  const long step = std::atol(words[0].c_str());
  balls_ = std::atol(words[1].c_str());
  check_balls(step, balls_);
  for (std::size_t i = 2; i < words.size(); ++i)
    if (columns_[i] == "KinEng" && !std::isfinite(std::strtod(words[i].c_str(), nullptr)))
      throw RunError("the kinetic energy is not finite at step " + words[0] +
                     ": shorten dem.rayleigh_fraction");
  last_step_ = step;
  if (turning_) dumped_until_ = step;  // LIGGGHTS prints a line after the dumps of its step
  steps_done_ = turning_ ? plan_.resting_steps() + step - plan_.begin : step;
}

void LiggghtsLog::check_balls(long step, long balls) const {
  if (balls >= expected_balls_) return;
  std::ostringstream message;
  message << "LIGGGHTS lost " << expected_balls_ - balls << " of " << expected_balls_
          << " balls between steps " << last_step_ << " and " << step
          << (turning_ ? " of the turning mill" : " of the mill at rest") << " (time-step "
          << plan_.step.value << " s): they left through the walls";
  throw RunError(message.str());
}

void LiggghtsLog::read_insertion(const std::string& line) {
  std::istringstream in(line.substr(std::string(inserted_mark).size()));
  long asked = 0;
  long total = 0;
  double diameter = 0;
  std::string word;
  if (!(in >> asked >> word >> diameter >> word >> total))
    throw RunError("cannot read LIGGGHTS' line: " + line);
  const long inserted = total - expected_balls_;
  if (inserted != asked) {
    std::ostringstream message;
    message << "LIGGGHTS inserted " << inserted << " of " << asked << " balls of diameter " << diameter
            << " m";
    if (inserted < asked) message << ": raise charge.start_radius or lower the masses";
    throw RunError(message.str());
  }
  expected_balls_ = total;
}

std::string LiggghtsLog::first_lines() const {
  std::string text;
  for (const auto& line : head_) text += indented(line);
  return text;
}

std::string LiggghtsLog::last_lines() const {
  std::string text;
  for (const auto& line : tail_) text += indented(line);
  return text;
}

}  // namespace millfoam::dem_driver
