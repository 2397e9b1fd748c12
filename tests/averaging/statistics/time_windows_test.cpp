// SPDX-License-Identifier: GPL-3.0-or-later
#include "averaging/statistics/time_windows.hpp"

#include <gtest/gtest.h>

#include "tests/averaging/test_support.hpp"

namespace millfoam::averaging {
namespace {

/// Time-steps of records from 0 to `last`, both included.
std::vector<long long> every(long long interval, long long last) {
  std::vector<long long> steps;
  for (long long step = 0; step <= last; step += interval) steps.push_back(step);
  return steps;
}

WindowRequest windows_of(double length) {
  WindowRequest request;
  request.timestep = 1e-5;
  request.length = length;
  return request;
}

TEST(TimeWindows, RecordsOfAWindowAreThoseFromItsBeginningToBeforeItsEnd) {
  const WindowPlan plan = plan_windows(every(200, 19800), windows_of(0.05));
  ASSERT_EQ(plan.windows.size(), 4U);
  for (std::size_t w = 0; w < 4; ++w) {
    EXPECT_EQ(plan.windows[w].begin, static_cast<long long>(5000 * w));
    EXPECT_EQ(plan.windows[w].end, static_cast<long long>(5000 * (w + 1)));
    EXPECT_EQ(plan.windows[w].first_record, 25 * w);
    EXPECT_EQ(plan.windows[w].records, 25U);
  }
  EXPECT_TRUE(plan.notes.empty());
}

TEST(TimeWindows, NoRecordChangesWindowByRounding) {
  // 0.3 s / 1e-7 s and the products of 0.1 s are not whole numbers in floating point.
  WindowRequest request = windows_of(0.1);
  request.timestep = 1e-7;
  request.start = 0.3;
  const WindowPlan plan = plan_windows(every(10000, 8999999), request);
  ASSERT_EQ(plan.windows.size(), 6U);
  for (const WindowSpan& span : plan.windows) EXPECT_EQ(span.records, 100U);
}

TEST(TimeWindows, TheRecordAtTheVeryEndMakesNoWindowOfItsOwn) {
  const WindowPlan plan = plan_windows(every(200, 20000), windows_of(0.05));
  EXPECT_EQ(plan.windows.size(), 4U);
  ASSERT_EQ(plan.notes.size(), 1U);
  expect_named(plan.notes[0], {"0.2 s", "not used"});
}

TEST(TimeWindows, ALastWindowThatTheDumpsDoNotFillIsKeptWithAWarning) {
  const WindowPlan plan = plan_windows(every(200, 16000), windows_of(0.05));
  ASSERT_EQ(plan.windows.size(), 4U);
  EXPECT_EQ(plan.windows[3].records, 6U);
  EXPECT_EQ(plan.windows[3].end, 16200) << "one interval after the last record";
  EXPECT_EQ(plan.windows[3].expected, 25U) << "of the window that was requested";
  ASSERT_EQ(plan.notes.size(), 1U);
  expect_named(plan.notes[0], {"window 3", "0.15 s", "0.2 s", "6 records", "25"});
}

TEST(TimeWindows, OneRecordPerWindowIsAllowed) {
  const WindowPlan plan = plan_windows(every(200, 1000), windows_of(0.002));
  EXPECT_EQ(plan.windows.size(), 6U);
  EXPECT_TRUE(plan.notes.empty());
}

TEST(TimeWindows, AMissingDumpIsTold) {
  std::vector<long long> steps = every(200, 9800);
  steps.erase(steps.begin() + 30);
  const WindowPlan plan = plan_windows(steps, windows_of(0.05));
  ASSERT_EQ(plan.notes.size(), 1U);
  expect_named(plan.notes[0], {"window 1", "24 records", "25"});
  EXPECT_EQ(plan.windows[1].records, 24U);
  for (const WindowSpan& span : plan.windows) EXPECT_EQ(span.expected, 25U);
  EXPECT_FALSE(plan.windows[1].starts_late || plan.windows[1].ends_short) << "the gap is inside";
}

TEST(TimeWindows, RecordsOffTheIntervalAreTold) {
  std::vector<long long> steps = every(200, 9800);
  steps.insert(steps.begin() + 31, 6100);
  const WindowPlan plan = plan_windows(steps, windows_of(0.05));
  EXPECT_EQ(plan.windows[1].records, 26U);
  ASSERT_EQ(plan.notes.size(), 1U);
  expect_named(plan.notes[0], {"window 1", "26 records, 25 would fill it", "every 0.002 s"});
  // Windows that are no multiple of the interval hold one more or less
  EXPECT_TRUE(plan_windows(every(200, 9600), windows_of(0.007)).notes.empty());
}

TEST(TimeWindows, AWindowWithoutARecordIsRefusedWithItsTime) {
  std::vector<long long> steps = every(200, 4800);
  steps.push_back(30000);
  const auto gap = [&] { plan_windows(steps, windows_of(0.05)); };
  expect_named(message_of<WindowError>(gap), {"0.05 s", "0.1 s", "gap"});
}

TEST(TimeWindows, AWindowShorterThanTheRecordIntervalIsRefused) {
  const auto short_window = [] { plan_windows(every(200, 2000), windows_of(0.001)); };
  expect_named(message_of<WindowError>(short_window), {"0.001 s", "0.002 s"});
}

TEST(TimeWindows, StartAndEndChooseTheRecords) {
  WindowRequest request = windows_of(0.05);
  request.start = 0.05;
  request.end = 0.15;
  const WindowPlan plan = plan_windows(every(200, 20000), request);
  ASSERT_EQ(plan.windows.size(), 2U);
  EXPECT_EQ(plan.windows[0].begin, 5000);
  EXPECT_EQ(plan.windows[0].first_record, 25U);
  EXPECT_EQ(plan.windows[1].first_record + plan.windows[1].records, 75U);
  ASSERT_EQ(plan.notes.size(), 2U);
  expect_named(plan.notes[0], {"25 records before the start"});
  expect_named(plan.notes[1], {"26 records from the end on"});
}

TEST(TimeWindows, DumpsThatEndBeforeTheRequestedEndAreTold) {
  WindowRequest request = windows_of(0.05);
  request.end = 0.2;
  // The last record is one interval before the end
  EXPECT_TRUE(plan_windows(every(200, 19800), request).notes.empty());
  const WindowPlan plan = plan_windows(every(200, 9800), request);
  EXPECT_EQ(plan.windows.size(), 2U);
  EXPECT_EQ(plan.notes,
            std::vector<std::string>{"warning: the dumps end at 0.098 s, 0.102 s before the end 0.2 s"});
  request.up_to_end = true;
  plan_windows(every(200, 19800), request);
  expect_named(message_of<WindowError>([&] { plan_windows(every(200, 9800), request); }),
               {"the dumps end at 0.098 s, 0.102 s before the end 0.2 s", "expected those of the whole run"});
}

TEST(TimeWindows, AWholeRunIsOneWindowWithAllRecords) {
  WindowRequest request;
  request.timestep = 1e-5;
  request.start = 0.1;
  const WindowPlan plan = plan_windows(every(200, 20000), request);
  ASSERT_EQ(plan.windows.size(), 1U);
  EXPECT_EQ(plan.windows[0].begin, 10000);
  EXPECT_EQ(plan.windows[0].end, 20200);
  EXPECT_EQ(plan.windows[0].records, 51U);
}

TEST(TimeWindows, ARangeWithoutRecordsIsRefusedWithTheTimesThatThereAre) {
  WindowRequest request = windows_of(0.05);
  request.start = 7;
  const auto late = [&] { plan_windows(every(200, 20000), request); };
  expect_named(message_of<WindowError>(late), {"7 s", "from 0 s to 0.2 s"});
  request.end = 6;
  const auto turned = [&] { plan_windows(every(200, 20000), request); };
  expect_named(message_of<WindowError>(turned), {"6 s", "not after the start 7 s"});
}

}  // namespace
}  // namespace millfoam::averaging
