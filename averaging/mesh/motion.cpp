// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/mesh/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace millfoam::averaging {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Relative round-off of times, which are a step times the time-step.
constexpr double time_slack = 1e-12;

/// Number of the interval [i, i+1] of a table that holds the time; the first and the last also hold times
/// that are beyond by round-off.
std::size_t interval(const TimeTable& table, double time) {
  const double slack = time_slack * std::max(std::abs(table.times.front()), std::abs(table.times.back()));
  if (!(time >= table.times.front() - slack && time <= table.times.back() + slack)) {
    std::ostringstream message;
    message << (table.file.empty() ? "" : table.file + ": ") << "time " << time
            << " s is outside the table of the motion, which goes from " << table.times.front() << " to "
            << table.times.back() << " s";
    throw std::out_of_range(message.str());
  }
  const auto above = std::upper_bound(table.times.begin(), table.times.end(), time);
  const auto next = static_cast<std::size_t>(above - table.times.begin());
  return std::clamp<std::size_t>(next, 1, table.times.size() - 1) - 1;
}

class Rotation : public Motion {
 public:
  Rotation(const Vector3d& axis, const Vector3d& origin) : axis_(axis.normalized()), origin_(origin) {}
  Isometry3d place(double time) const override {
    return Eigen::Translation3d(origin_) * Eigen::AngleAxisd(angle(time), axis_) *
           Eigen::Translation3d(-origin_);
  }

 private:
  virtual double angle(double time) const = 0;
  Vector3d axis_;
  Vector3d origin_;
};

class SteadyRotation : public Rotation {
 public:
  SteadyRotation(double speed, const Vector3d& axis, const Vector3d& origin)
      : Rotation(axis, origin), speed_(speed) {}

 private:
  double angle(double time) const override { return speed_ * time; }
  double speed_;
};

class TableRotation : public Rotation {
 public:
  TableRotation(TimeTable speed, const Vector3d& axis, const Vector3d& origin)
      : Rotation(axis, origin), speed_(std::move(speed)) {}

 private:
  double angle(double time) const override { return integral_to(speed_, time); }
  TimeTable speed_;
};

class SteadyTranslation : public Motion {
 public:
  explicit SteadyTranslation(Vector3d velocity) : velocity_(std::move(velocity)) {}
  Isometry3d place(double time) const override { return Isometry3d(Eigen::Translation3d(velocity_ * time)); }

 private:
  Vector3d velocity_;
};

class TableTranslation : public Motion {
 public:
  explicit TableTranslation(std::array<TimeTable, 3> path) : path_(std::move(path)) {}
  Isometry3d place(double time) const override {
    return Isometry3d(
        Eigen::Translation3d(value_at(path_[0], time), value_at(path_[1], time), value_at(path_[2], time)));
  }

 private:
  std::array<TimeTable, 3> path_;
};

class Composition : public Motion {
 public:
  explicit Composition(std::vector<std::shared_ptr<const Motion>> parts) : parts_(std::move(parts)) {}
  Isometry3d place(double time) const override {
    Isometry3d result = Isometry3d::Identity();
    for (const auto& part : parts_) result = part->place(time) * result;
    return result;
  }

 private:
  std::vector<std::shared_ptr<const Motion>> parts_;
};

/// Whether all of `word` is a finite number.
bool read_number(const std::string& word, double& value) {
  char* end = nullptr;
  value = std::strtod(word.c_str(), &end);
  return !word.empty() && *end == '\0' && std::isfinite(value);
}

/// The number that a word in a line of a table file is; `place` names the line in the error.
double table_number(const std::string& word, const std::string& place) {
  double value = 0;
  if (!read_number(word, value)) throw std::invalid_argument(place + "'" + word + "' is not a finite number");
  return value;
}

/// The columns of a table file, each with the times of the first one.
std::vector<TimeTable> read_tables(const std::string& path, std::size_t columns) {
  std::ifstream in(path);
  if (!in) throw std::invalid_argument(path + ": cannot read this table of a motion");
  std::vector<TimeTable> tables(columns, TimeTable{{}, {}, path});
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::string place = path + ":" + std::to_string(number) + ": ";
    std::istringstream words(line.substr(0, line.find('#')));
    std::vector<double> row;
    for (std::string word; words >> word;) row.push_back(table_number(word, place));
    if (row.empty()) continue;
    if (row.size() != columns + 1) {
      throw std::invalid_argument(place + "there are " + std::to_string(row.size()) +
                                  " numbers, expected a time and " + std::to_string(columns) +
                                  (columns == 1 ? " value" : " values"));
    }
    if (!tables[0].times.empty() && row[0] <= tables[0].times.back()) {
      throw std::invalid_argument(place + "time " + std::to_string(row[0]) +
                                  " s does not follow the time before it");
    }
    for (std::size_t c = 0; c < columns; ++c) {
      tables[c].times.push_back(row[0]);
      tables[c].values.push_back(row[c + 1]);
    }
  }
  if (tables[0].times.size() < 2)
    throw std::invalid_argument(path + ": expected two or more lines of numbers");
  return tables;
}

/// The words of one motion's text, read from left to right.
class Words {
 public:
  explicit Words(const std::string& text) : text_(text), words_(text) {}

  bool at_end() { return (words_ >> std::ws).eof(); }

  std::string next(const std::string& expected) {
    std::string word;
    if (!(words_ >> word)) refuse("it ends where " + expected + " is expected");
    return word;
  }

  double number(const std::string& expected) {
    const std::string word = next(expected);
    double value = 0;
    if (!read_number(word, value)) refuse("'" + word + "' is not a finite number, expected " + expected);
    return value;
  }

  Vector3d vector(const std::string& expected) {
    const double x = number(expected + " x"), y = number(expected + " y");
    return {x, y, number(expected + " z")};
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw std::invalid_argument("motion '" + text_ + "': " + why);
  }

 private:
  std::string text_;
  std::istringstream words_;
};

std::shared_ptr<const Motion> parse_rotation(Words& words) {
  const std::string kind = words.next("'speed' or 'table'");
  double speed = 0;
  TimeTable table;
  if (kind == "speed") {
    speed = words.number("a speed in rad/s");
  } else if (kind == "table") {
    table = read_tables(words.next("the name of a table"), 1)[0];
  } else {
    words.refuse("'" + kind + "' is not known, expected 'speed' or 'table'");
  }
  Vector3d axis = Vector3d::UnitZ(), origin = Vector3d::Zero();
  while (!words.at_end()) {
    const std::string option = words.next("'axis' or 'origin'");
    if (option == "axis") {
      axis = words.vector("the axis'");
      if (!(axis.norm() > 0)) words.refuse("the axis has no direction");
    } else if (option == "origin") {
      origin = words.vector("the origin's");
    } else {
      words.refuse("'" + option + "' is not known, expected 'axis' or 'origin'");
    }
  }
  if (kind == "speed") return std::make_shared<SteadyRotation>(speed, axis, origin);
  return std::make_shared<TableRotation>(std::move(table), axis, origin);
}

std::shared_ptr<const Motion> parse_translation(Words& words) {
  const std::string kind = words.next("'velocity' or 'table'");
  std::shared_ptr<const Motion> motion;
  if (kind == "velocity") {
    motion = std::make_shared<SteadyTranslation>(words.vector("the velocity's"));
  } else if (kind == "table") {
    const std::vector<TimeTable> path = read_tables(words.next("the name of a table"), 3);
    motion = std::make_shared<TableTranslation>(std::array<TimeTable, 3>{path[0], path[1], path[2]});
  } else {
    words.refuse("'" + kind + "' is not known, expected 'velocity' or 'table'");
  }
  if (!words.at_end()) words.refuse("unexpected word '" + words.next("") + "'");
  return motion;
}

}  // namespace

double value_at(const TimeTable& table, double time) {
  const std::size_t i = interval(table, time);
  const double part = (time - table.times[i]) / (table.times[i + 1] - table.times[i]);
  return table.values[i] + part * (table.values[i + 1] - table.values[i]);
}

double integral_to(const TimeTable& table, double time) {
  const std::size_t last = interval(table, time);
  double sum = 0;
  for (std::size_t i = 0; i < last; ++i) {
    sum += (table.times[i + 1] - table.times[i]) * (table.values[i] + table.values[i + 1]) / 2;
  }
  return sum + (time - table.times[last]) * (table.values[last] + value_at(table, time)) / 2;
}

std::shared_ptr<const Motion> parse_motion(const std::vector<std::string>& texts) {
  std::vector<std::shared_ptr<const Motion>> parts;
  for (const std::string& text : texts) {
    Words words(text);
    const std::string kind = words.next("'rotation' or 'translation'");
    if (kind == "rotation") {
      parts.push_back(parse_rotation(words));
    } else if (kind == "translation") {
      parts.push_back(parse_translation(words));
    } else {
      words.refuse("'" + kind + "' is not known, expected 'rotation' or 'translation'");
    }
  }
  return std::make_shared<Composition>(std::move(parts));
}

}  // namespace millfoam::averaging
