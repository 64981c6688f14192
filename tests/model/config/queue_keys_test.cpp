// `wireless.queue`: its defaults, what each discipline needs, and errors at their places.
#include <gtest/gtest.h>

#include "model/config/knobs/effective.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace queue_keys_test {

/// The profile begins in line 4, its queue is line 6.
Result<Scenario> read(const std::string& queue, const std::string& rest = "",
                      const std::string& base = "wifi-80211n-ampdu") {
  const std::string text =
      "dds: fastdds-2.6.11\ntime_limit: 60s\ndeployment: {hosts: 2, participants_per_host: 2, "
      "endpoints_per_participant: 2}\nwireless:\n  base: " +
      base + "\n  queue: " + queue + "\n" + rest;
  TestFiles files;
  return read_scenario(files.write("queue.yaml", text), {}, source_specs());
}

std::string error_of(const Result<Scenario>& result) {
  if (result) return "no error";
  const std::string text = to_string(result.error());
  return text.substr(text.find("queue.yaml"));
}

TEST(QueueKeys, ADisciplineHasTheDefaultsOfItsRfc) {
  const auto scenario = read("{discipline: codel}");
  ASSERT_TRUE(scenario) << error_of(scenario);
  const QueueManagement expected{QueueDiscipline::codel, QueuesOf::everybody,     {}, {},
                                 Nanoseconds{5'000'000}, Nanoseconds{100'000'000}};
  EXPECT_EQ(scenario->wireless.queue, expected);
  EXPECT_TRUE(queues_drop(scenario->wireless));
  EXPECT_FALSE(queues_drop(read("{discipline: unlimited}")->wireless));
  EXPECT_FALSE(queues_drop(WirelessProfile{}));
}

TEST(QueueKeys, EachCanBeSetAndIsWrittenAgain) {
  const auto scenario = read(
      "{discipline: fq_codel, of: access_points, max_frames: 8192, max_bytes: 16000000, target: "
      "20ms, interval: 300ms}",
      "  queueing: flows\n");
  ASSERT_TRUE(scenario) << error_of(scenario);
  const QueueManagement expected{
      QueueDiscipline::fq_codel, QueuesOf::access_points, 8'192,
      Bytes{16'000'000},         Nanoseconds{20'000'000}, Nanoseconds{300'000'000}};
  EXPECT_EQ(scenario->wireless.queue, expected);
  const auto again = parse_scenario(effective_yaml(*scenario), "again", {}, source_specs());
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(*again, *scenario);
}

TEST(QueueKeys, NumbersOfAQueueCanBeVaried) {
  Scenario scenario = *read("{discipline: tail_drop, max_frames: 100}");
  EXPECT_TRUE(set_numeric_knob(scenario, "wireless.queue.max_frames", 7));
  EXPECT_EQ(scenario.wireless.queue->max_frames, 7U);
  EXPECT_TRUE(set_numeric_knob(scenario, "wireless.queue.target", 1));
  EXPECT_FALSE(set_numeric_knob(scenario, "wireless.queue.max_bytes", 7'000)) << "it is absent";
}

TEST(QueueKeys, WhatDoesNotFitIsRefusedAtItsPlace) {
  const auto says = [](const Result<Scenario>& result, const std::string& place,
                       const std::string& expected) {
    const std::string error = error_of(result);
    EXPECT_NE(error.find(place), std::string::npos) << error;
    EXPECT_NE(error.find(expected), std::string::npos) << error;
  };
  says(read("{discipline: tail_drop}"), ":6:", "max_frames or max_bytes");
  says(read("{discipline: red}"), ":6:", "expected one of unlimited, tail_drop, codel, fq_codel");
  says(read("{max_frames: 5}"), ":6:", "discipline");
  says(read("{discipline: codel, max_frames: 0}"), ":6:", "max_frames");
  says(read("{discipline: codel, interval: 0s}"), ":6:", "interval");
  says(read("{discipline: codel, of: robots}"),
       ":6:", "expected one of everybody, access_points, stations");
  says(read("{discipline: fq_codel}"), ":6:", "queueing: flows");
  says(read("{discipline: codel}", "  queueing: flows\n"), ":6:", "fq_codel with queueing: flows");
  says(read("{discipline: codel, max_bytes: 1537}"), ":6:", "at least 1538");
  says(read("{discipline: codel}", "", "wifi-80211n"), ":6:", "service: unit");
}

}  // namespace queue_keys_test
}  // namespace stormproof::model::config
