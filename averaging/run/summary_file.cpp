// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/run/summary_file.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "meshing/files/json_object.hpp"
#include "meshing/files/output_file.hpp"

namespace millfoam::averaging {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* summary_format = "millfoam-averages";

Json known(const std::string& text) {
  return text.empty() ? Json() : Json(text);
}

Json fingerprints(const SolidsHeader& header) {
  Json mill = Json::object();
  if (!header.mill_charge.empty()) mill["charge"] = header.mill_charge;
  if (!header.mill_averages.empty()) mill["averages"] = header.mill_averages;
  return mill;
}

/// `value` of each window.
template <typename Value>
Json column(const SolidsSummary& summary, Value value) {
  Json values = Json::array();
  for (const WindowSummary& window : summary.windows) values.push_back(value(window));
  return values;
}

Json columns(const SolidsSummary& summary) {
  const auto of_ledger = [&](double Ledger::*part) {
    return column(summary, [part](const WindowSummary& w) { return w.ledger.*part; });
  };
  return {{"begin_s", column(summary, [](const WindowSummary& w) { return w.time.begin; })},
          {"end_s", column(summary, [](const WindowSummary& w) { return w.time.end; })},
          {"records", column(summary, [](const WindowSummary& w) { return w.time.records; })},
          {"expected_records", column(summary,
                                      [](const WindowSummary& w) {
                                        return w.time.expected > 0 ? Json(w.time.expected) : Json();
                                      })},
          {"starts_late", column(summary, [](const WindowSummary& w) { return w.time.starts_late; })},
          {"ends_short", column(summary, [](const WindowSummary& w) { return w.time.ends_short; })},
          {"volume_in_m3", of_ledger(&Ledger::volume_in)},
          {"deposited_m3", of_ledger(&Ledger::deposited)},
          {"outside_m3", of_ledger(&Ledger::outside)},
          {"clipped_m3", of_ledger(&Ledger::clipped)},
          {"balls_per_cell", column(summary, [](const WindowSummary& w) { return w.balls_per_cell; })},
          {"largest_solidity", column(summary, [](const WindowSummary& w) { return w.largest_solidity; })}};
}

/// Mean over the records.
double mean_volume_in(const SolidsSummary& summary) {
  double volume = 0, records = 0;
  for (const WindowSummary& window : summary.windows) {
    volume += window.ledger.volume_in * static_cast<double>(window.time.records);
    records += static_cast<double>(window.time.records);
  }
  return volume / records;
}

Json sentences(const SolidsSummary& summary, bool warnings) {
  Json list = Json::array();
  for (const Remark& remark : remarks(summary)) {
    if (remark.warning == warnings) list.push_back(remark.sentence);
  }
  return list;
}

/// From one window's begin to the next; of a single one its own length.
double window_length(const std::vector<WindowSummary>& windows) {
  return (windows.size() > 1 ? windows[1].time.begin : windows[0].time.end) - windows[0].time.begin;
}

/// The windows in time and the settings.
void put_settings(Json& json, const SolidsSummary& summary) {
  const SolidsHeader& header = summary.header;
  long long records = 0;
  for (const WindowSummary& window : summary.windows) records += window.time.records;
  json["time0_s"] = header.time0;
  json["end_s"] = summary.windows.back().time.end;
  json["windows"] = summary.windows.size();
  json["window_s"] = window_length(summary.windows);
  json["whole_run"] = header.whole_run;
  json["records"] = records;
  json["timestep_s"] = header.timestep;
  json["angular_velocity_rad_s"] = header.angular_velocity;
  json["method"] = header.method;
  json["grid"] = summary.grid;
  json["shape"] = summary.shape;
  json["smoothing_m"] = header.smoothing;
  json["solidity_cap"] = header.solidity_cap;
}

}  // namespace

std::filesystem::path summary_path(const std::filesystem::path& solids_file) {
  std::filesystem::path path = solids_file;
  path.replace_extension(".json");
  if (path != solids_file) return path;
  throw SolidsFileError(path.string() + ": this is the name of the summary, expected one like solids.h5");
}

void require_summary_or_nothing(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path) || JsonObject::of_format(path, summary_format)) return;
  throw SolidsFileError(path.string() + ": this file exists and is not a " + summary_format +
                        " file; it would be overwritten: give another name or remove it");
}

std::string run_of_summary(const std::filesystem::path& path) {
  try {
    const auto found = JsonObject::of_format(path, summary_format);
    return found ? found->find<std::string>("run_id").value_or("") : "";
  } catch (const JsonError&) {
    return "";
  }
}

std::string as_json(const SolidsSummary& summary, const std::string& writer) {
  const WindowSummary all = overall(summary);
  Json json{{"format", summary_format},
            {"program", writer},
            {"mill", fingerprints(summary.header)},
            {"run_id", known(summary.header.run_id)},
            {"file", summary.file.filename().string()}};
  put_settings(json, summary);
  json["volume_in_m3"] = mean_volume_in(summary);
  json["largest_outside"] = largest_share(summary, &Ledger::outside);
  json["largest_clipped"] = largest_share(summary, &Ledger::clipped);
  json["balls_of_laws"] = {fewest_balls, most_balls};
  json["balls_per_cell"] = all.balls_per_cell;
  json["mean_solidity"] = all.mean_solidity;
  json["largest_solidity"] = all.largest_solidity;
  json["fines_share"] = summary.header.fines_share;
  json["advice"] = sentences(summary, false);
  json["warnings"] = sentences(summary, true);
  json["per_window"] = columns(summary);
  // Names of files may be of any bytes.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

void write_summary(const std::filesystem::path& path, const SolidsSummary& summary,
                   const std::string& writer) {
  const std::string text = as_json(summary, writer);
  try {
    replace_file(path, [&](std::ostream& out) { out << text; });
  } catch (const std::runtime_error&) {
    throw SolidsFileError(path.string() + ": cannot write this file (is the disk full?)");
  }
}

}  // namespace millfoam::averaging
