// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/files/json_object.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

namespace millfoam {
namespace {

std::string refusal(const std::string& text, const std::function<void(const JsonObject&)>& read) {
  try {
    read(JsonObject(text, "run.json", ": run it again"));
  } catch (const JsonError& error) {
    return error.what();
  }
  return "";
}

TEST(JsonObject, GivesValuesListsTablesAndObjects) {
  const JsonObject json(R"({"dt": 1, "ends": [0, 2], "windows": [null, 0.5], "files": {"shell": "0a"},
                            "mill": {"walls": "1b"}, "averages": [{"exact": true}, {"exact": false}]})",
                        "run.json");
  EXPECT_EQ(json.get<double>("dt"), 1);
  EXPECT_EQ((json.get<std::array<int, 2>>("ends")), (std::array<int, 2>{0, 2}));
  EXPECT_EQ(json.get<std::vector<std::optional<double>>>("windows"),
            (std::vector<std::optional<double>>{std::nullopt, 0.5}));
  EXPECT_EQ((json.get<std::map<std::string, std::string>>("files").at("shell")), "0a");
  EXPECT_EQ(json.object("mill").get<std::string>("walls"), "1b");
  EXPECT_FALSE(json.objects("averages").at(1).get<bool>("exact"));
}

TEST(JsonObject, AKeyWithNullIsAsOneThatIsNotThere) {
  const JsonObject json(R"({"end_s": null})", "run.json");
  for (const char* key : {"end_s", "start_s"}) {
    EXPECT_FALSE(json.find<double>(key));
    EXPECT_FALSE(json.find_object(key));
  }
  EXPECT_TRUE(json.contains("end_s"));
  EXPECT_FALSE(json.get_or_null<double>("end_s"));
}

TEST(JsonObject, NamesFileKeyValueAndWhatWasExpected) {
  const std::string text =
      R"({"dt": "x", "steps": 1.5, "ends": [1], "parts": [{"share": true}], "mill": {},
          "nothing": null, "large": 4294967296})";
  const auto expect = [&](const std::string& words, const std::function<void(const JsonObject&)>& read) {
    EXPECT_EQ(refusal(text, read), "run.json: key " + words + ": run it again");
  };
  expect("'dt' is \"x\", expected a number", [](const JsonObject& json) { json.find<double>("dt"); });
  expect("'end' is missing, expected text", [](const JsonObject& json) { json.get<std::string>("end"); });
  expect("'steps' is 1.5, expected a whole number", [](const JsonObject& json) { json.get<long>("steps"); });
  expect("'ends' is [1], expected a list of 2 numbers",
         [](const JsonObject& json) { json.get<std::array<double, 2>>("ends"); });
  expect("'parts[0].share' is true, expected a number",
         [](const JsonObject& json) { json.objects("parts")[0].get<double>("share"); });
  expect("'mill.walls' is missing, expected text",
         [](const JsonObject& json) { json.object("mill").get<std::string>("walls"); });
  expect("'nothing' is null, expected a number", [](const JsonObject& json) { json.get<double>("nothing"); });
  expect("'end' is missing, expected a number or null",
         [](const JsonObject& json) { json.get_or_null<double>("end"); });
  expect("'large' is 4294967296, expected a whole number",
         [](const JsonObject& json) { json.get<int>("large"); });
  expect("'dt' is \"x\", expected a time above 0", [](const JsonObject& json) {
    json.get<double>("dt", "a time above 0", [](double value) { return value > 0; });
  });
  expect("'ends' is [1], expected a list of objects", [](const JsonObject& json) { json.objects("ends"); });
}

TEST(JsonObject, AFolderIsNoFile) {
  EXPECT_THROW(JsonObject::read(std::filesystem::temp_directory_path()), JsonError);
  EXPECT_FALSE(JsonObject::of_format(std::filesystem::temp_directory_path(), "a"));
  EXPECT_FALSE(JsonObject::read("no_such_file.json"));
}

TEST(JsonObject, NamesTheLineOfATextThatIsNotJson) {
  const auto nothing = [](const JsonObject&) {};
  EXPECT_EQ(refusal("{\n\"dt\": 1,\nsteps 2}", nothing),
            "run.json:3: this is not JSON, expected an object: run it again");
  EXPECT_EQ(refusal("[]", nothing),
            "run.json: expected an object of JSON, {\"key\": value, ...}: run it again");
  EXPECT_EQ(refusal("{\"format\": \"a\"}", [](const JsonObject& json) { json.require_format("b"); }),
            "run.json: is not of the format b: run it again");
}

}  // namespace
}  // namespace millfoam
