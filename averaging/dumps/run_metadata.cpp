// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/dumps/run_metadata.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "averaging/dumps/dump_reader.hpp"
#include "meshing/files/file_fingerprint.hpp"

namespace millfoam::averaging {

namespace {

/// The keys of an object in a file, which messages name.
class MetadataValues {
 public:
  /// Throws DumpError unless `text` is an object.
  MetadataValues(const std::string& text, std::string file) : file_(std::move(file)) {
    try {
      object_ = nlohmann::json::parse(text);
    } catch (const nlohmann::json::parse_error& error) {
      const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
      throw DumpError(file_ + ':' + std::to_string(1 + std::count(text.begin(), end, '\n')) +
                      ": this is not JSON, expected an object as millDem writes it");
    } catch (const nlohmann::json::exception& error) {
      throw DumpError(file_ + ": " + error.what());
    }
    if (!object_.is_object()) throw DumpError(file_ + ": expected an object of JSON, {\"key\": value, ...}");
  }

  /// A number that `allowed` accepts; nothing when the key is not there.
  template <typename Allowed>
  std::optional<double> number(const char* key, const char* expected, Allowed allowed) const {
    const nlohmann::json* value = find(object_, key);
    if (value == nullptr) return std::nullopt;
    if (!value->is_number() || !allowed(value->get<double>())) fail(key, *value, expected);
    return value->get<double>();
  }

  /// A whole number of at least `least`; nothing when the key is not there.
  std::optional<long long> count(const char* key, long long least) const {
    const nlohmann::json* value = find(object_, key);
    if (value == nullptr) return std::nullopt;
    if (!value->is_number_integer() || value->get<long long>() < least)
      fail(key, *value, least > 0 ? "a positive whole number" : "a whole number of 0 or more");
    return value->get<long long>();
  }

  /// Text; empty when the key is not there. With `group` a key of the object that is this key of the file.
  std::string text(const char* key, const char* group = nullptr) const {
    const nlohmann::json* object = group == nullptr ? &object_ : find(object_, group);
    if (object == nullptr) return {};
    if (!object->is_object()) fail(group, *object, "an object");
    const nlohmann::json* value = find(*object, key);
    if (value == nullptr) return {};
    if (!value->is_string()) fail(group == nullptr ? key : std::string(group) + '.' + key, *value, "text");
    return value->get<std::string>();
  }

  [[noreturn]] void fail(const std::string& key, const nlohmann::json& value, const char* expected) const {
    throw DumpError(file_ + ": key '" + key + "' is " + value.dump() + ", expected " + expected);
  }

 private:
  static const nlohmann::json* find(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found == object.end() || found->is_null() ? nullptr : &*found;
  }

  std::string file_;
  nlohmann::json object_;
};

std::optional<double> fines_share(const MetadataValues& values) {
  const auto mass = [&](const char* key) {
    return values.number(key, "a mass of 0 kg or more", [](double m) { return m >= 0 && std::isfinite(m); });
  };
  const std::optional<double> fines = mass("fines_mass_kg"), balls = mass("charge_mass_kg");
  if (!fines || !balls || *fines + *balls == 0) return std::nullopt;
  return *fines / (*fines + *balls);
}

}  // namespace

std::optional<RunMetadata> read_run_metadata(const std::filesystem::path& folder) {
  RunMetadata metadata;
  metadata.file = folder / "run.json";
  std::ifstream input(metadata.file, std::ios::binary);
  if (!input) return std::nullopt;
  const std::string text{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  metadata.run_id = fingerprint(text);
  const MetadataValues values(text, metadata.file.string());
  const std::string format = values.text("format");
  if (!format.empty() && format != "millfoam-dumps") values.fail("format", format, "\"millfoam-dumps\"");
  metadata.timestep =
      values.number("timestep_s", "a positive number", [](double dt) { return dt > 0 && std::isfinite(dt); });
  metadata.interval = values.count("interval", 1);
  metadata.angular_velocity = values.number("angular_velocity_rad_s", "a finite number",
                                            [](double omega) { return std::isfinite(omega); });
  metadata.begin =
      values.number("begin_s", "a finite time in s", [](double time) { return std::isfinite(time); });
  metadata.duration = values.number("duration_s", "a time in s above 0",
                                    [](double time) { return time > 0 && std::isfinite(time); });
  metadata.dumps = values.count("dumps", 0);
  metadata.mill_walls = values.text("walls", "mill");
  metadata.mill_charge = values.text("charge", "mill");
  metadata.fines_share = fines_share(values);
  return metadata;
}

void require_dumps(const RunMetadata& metadata) {
  if (metadata.dumps.value_or(1) > 0) return;
  throw DumpError(metadata.file.string() +
                  ": the run wrote no dumps (dem.dumps: no): its averages were made while it ran");
}

void require_all_dumps(const RunMetadata& metadata, std::size_t found) {
  const long long written = metadata.dumps.value_or(0);
  if (static_cast<long long>(found) >= written) return;
  throw DumpError(metadata.file.parent_path().string() + ": " + std::to_string(found) + " dumps, " +
                  metadata.file.filename().string() + " says " + std::to_string(written) +
                  "; expected all of them, or --window and --start for a part of the run");
}

double agreed_timestep(std::optional<double> given, const std::optional<RunMetadata>& metadata) {
  std::ostringstream message;
  message.precision(12);
  const bool known = metadata && metadata->timestep;
  if (!given && !known) {
    message << "the DEM time-step is not known: give --dt SECONDS, or a file 'run.json' with the key "
               "'timestep_s' in the folder of the dumps";
  } else if (given && !(*given > 0 && std::isfinite(*given))) {
    message << "--dt is " << *given << ", expected a positive time in s";
  } else if (given && known && std::abs(*given - *metadata->timestep) > 1e-9 * *metadata->timestep) {
    message << "--dt is " << *given << " s, but " << metadata->file.string() << " has timestep_s "
            << *metadata->timestep << " s; they must be the same";
  } else {
    return known ? *metadata->timestep : *given;
  }
  throw DumpError(message.str());
}

std::optional<double> agreed_angular_velocity(std::optional<double> given,
                                              const std::optional<RunMetadata>& metadata) {
  std::ostringstream message;
  message.precision(12);
  if (given && !std::isfinite(*given)) {
    message << "--speed is " << *given << ", expected a finite angular velocity in rad/s";
  } else if (given && metadata && metadata->angular_velocity &&
             std::abs(*given - *metadata->angular_velocity) > 1e-9 * std::abs(*given)) {
    message << "--speed is " << *given << " rad/s, but " << metadata->file.string()
            << " has angular_velocity_rad_s " << *metadata->angular_velocity
            << " rad/s; they must be the same";
  } else if (given) {
    return given;
  } else {
    return metadata ? metadata->angular_velocity : std::nullopt;
  }
  throw DumpError(message.str());
}

}  // namespace millfoam::averaging
