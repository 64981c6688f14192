// What a trace says must agree with what the run reports.
#include "model/trace/trace_writer.hpp"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "model/config/knobs/effective.hpp"
#include "model/config/scenario_file.hpp"
#include "tests/model/trace/recording.hpp"

namespace stormproof::model::trace {
namespace trace_writer_test {

using Json = nlohmann::ordered_json;

/// How many packets an element of "emitted" stands for.
std::uint64_t copies(const Json& packet) {
  return packet["to"] == "multicast" ? 1 : packet["to"].size();
}

Counts counted(const std::vector<Json>& events, std::uint64_t& user_control) {
  Counts counts;
  for (const Json& event : events) {
    for (const Json& packet : event.value("emitted", Json::array())) {
      const std::string kind = packet["kind"];
      counts.heartbeat +=
          copies(packet) * packet.value("heartbeats", kind == "heartbeat" ? 1U : 0U);
      if (kind == "acknack") counts.acknack += copies(packet);
      if (kind == "spdp_multicast") counts.spdp_multicast += copies(packet);
      if (kind == "spdp_unicast") counts.spdp_unicast += copies(packet);
      if (kind == "user_heartbeat" || kind == "user_acknack") ++user_control;
      counts.initial_data += packet.value("initial_data", 0U);
      counts.repair_data += packet.value("repair_data", 0U);
    }
  }
  return counts;
}

class TraceWriterTest : public testing::TestWithParam<Case> {};

TEST_P(TraceWriterTest, HeaderGivesTheScenarioBack) {
  const Recording& trace = recorded(GetParam());
  EXPECT_EQ(trace.header["format"], "stormproof-trace");
  EXPECT_EQ(trace.header["version"], 1);
  EXPECT_EQ(trace.header["program"].get<std::string>().rfind("stormproof ", 0), 0U);
  const auto scenario =
      config::parse_scenario(trace.header["scenario"].dump(), "header", {}, config::SpecPath{});
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  EXPECT_EQ(*scenario, GetParam().scenario());
}

TEST_P(TraceWriterTest, SumsOverTheLinesAreTheCountsOfTheRun) {
  const Recording& trace = recorded(GetParam());
  std::uint64_t user_control = 0;
  EXPECT_EQ(counted(trace.events, user_control), trace.result.counts);
  EXPECT_EQ(user_control, trace.result.user_control);
  EXPECT_EQ(trace.end["user_control"], user_control);
  for (const Counts::Entry& count : trace.result.counts.entries()) {
    EXPECT_EQ(trace.end["counts"][count.name], count.value);
  }
  EXPECT_EQ(trace.end["counts"]["total"], trace.result.counts.total());
}

TEST_P(TraceWriterTest, OneLineForEachEventInOrder) {
  const Recording& trace = recorded(GetParam());
  ASSERT_EQ(trace.events.size(), trace.result.events);
  EXPECT_EQ(trace.end["events"], trace.result.events);
  std::int64_t time = 0;
  std::set<std::uint64_t> insertions;
  for (std::size_t n = 0; n < trace.events.size(); ++n) {
    const Json& event = trace.events[n];
    EXPECT_EQ(event["n"], n);
    EXPECT_GE(event["t"], time);
    time = event["t"];
    EXPECT_TRUE(insertions.insert(event["insertion"].get<std::uint64_t>()).second);
  }
  EXPECT_EQ(time, trace.result.end_time.count());
}

TEST_P(TraceWriterTest, EveryEventHasAnEarlierCauseOrIsFromBeforeTheRun) {
  const Recording& trace = recorded(GetParam());
  std::uint64_t before_run = 0;  // announcements, and with Fast DDS the creation of endpoints
  for (const Json& event : trace.events) {
    before_run += event["event"] == "endpoint_creation" ? 1U : 0U;
  }
  before_run += GetParam().scenario().deployment.participants.size();
  for (const Json& event : trace.events) {
    const bool is_from_before = event["insertion"] < before_run;
    EXPECT_EQ(event["cause"].is_null(), is_from_before) << event;
    EXPECT_TRUE(is_from_before || event["cause"] < event["n"]) << event;
  }
}

TEST_P(TraceWriterTest, EndSaysHowTheRunEnded) {
  const Recording& trace = recorded(GetParam());
  if (trace.result.discovery_time) {
    EXPECT_EQ(trace.end["end"], "completed");
    EXPECT_EQ(trace.end["t_disc_ns"], trace.result.discovery_time->count());
    EXPECT_EQ(trace.events.back()["missing"], 0);
  } else {
    EXPECT_TRUE(trace.end["t_disc_ns"].is_null());
    EXPECT_EQ(trace.end["missing"], trace.result.missing_count);
  }
}

TEST_P(TraceWriterTest, AChannelFinishesWhatItServes) {
  std::map<std::string, Json> serving;
  for (const Json& event : recorded(GetParam()).events) {
    if (event["event"] == "service_finished") {
      const auto found = serving.find(event["channel"]);
      ASSERT_NE(found, serving.end()) << event;
      EXPECT_EQ(found->second["until"], event["t"]);
      for (const char* key : {"stage", "packet", "fragment"}) {
        EXPECT_EQ(found->second[key], event[key]) << event;
      }
      serving.erase(found);
    }
    if (!event.contains("service")) continue;
    EXPECT_EQ(event["event"], "dispatch");
    EXPECT_TRUE(serving.emplace(event["service"]["channel"], event["service"]).second) << event;
  }
}

TEST_P(TraceWriterTest, PacketsLeaveTheirSourceAndArriveOnceAfterTheyWereEmitted) {
  std::map<std::uint64_t, Json> under_way;
  std::set<std::uint64_t> left;
  std::vector<std::uint64_t> lost;
  for (const Json& event : recorded(GetParam()).events) {
    for (const Json& packet : event.value("emitted", Json::array())) {
      for (std::uint64_t k = 0; k < copies(packet); ++k) {
        Json one = packet;
        if (packet["to"].is_array()) one["to"] = packet["to"][k];
        EXPECT_TRUE(under_way.emplace(packet["packet"].get<std::uint64_t>() + k, one).second);
      }
    }
    if (event.contains("left_source")) {
      EXPECT_TRUE(left.insert(event["left_source"].get<std::uint64_t>()).second) << event;
    }
    if (!event.contains("arrived")) continue;
    const Json& arrived = event["arrived"];
    const std::uint64_t number = arrived["packet"];
    ASSERT_TRUE(under_way.contains(number)) << event;
    EXPECT_TRUE(left.contains(number)) << event;
    for (const char* key : {"kind", "from", "to"}) {
      EXPECT_EQ(arrived[key], under_way[number][key]) << event;
    }
    under_way.erase(number);
    if (arrived.value("lost", false)) lost.push_back(number);
  }
  for (const std::uint64_t number : lost) {
    const auto& all = GetParam().scenario().wireless.lost_packets;
    EXPECT_NE(std::ranges::find(all, number), all.end());
  }
}

TEST_P(TraceWriterTest, SecondRunGivesTheSameBytes) {
  EXPECT_EQ(record(GetParam().scenario()).text, recorded(GetParam()).text);
}

INSTANTIATE_TEST_SUITE_P(Cases, TraceWriterTest, testing::ValuesIn(trace_cases()), CaseName{});

TEST(TraceWriter, LostPacketsAreMarked) {
  int lost = 0;
  for (const Json& event : record(case_named("v1")).events) {
    if (event.contains("arrived") && event["arrived"].value("lost", false)) ++lost;
  }
  EXPECT_EQ(lost, 2);
}

TEST(TraceWriter, EventsOfConstantDelayNameTheirPacket) {
  for (const Json& event : record(case_named("constant_delay")).events) {
    if (event["event"] == "delayed_reception") {
      EXPECT_EQ(event["packet"], event["arrived"]["packet"]);
    }
    if (event["event"] == "source_completion") {
      EXPECT_EQ(event["packet"], event["left_source"]);
    }
  }
}

TEST(TraceWriter, CycleEventsShowTheirCycle) {
  bool seen = false;
  for (const Json& event : record(case_named("v3")).events) {
    if (event["event"] != "cycle_start") continue;
    seen = true;
    EXPECT_TRUE(event["cycle"].is_number());
    EXPECT_TRUE(event["writer"]["participant"].is_number());
  }
  EXPECT_TRUE(seen);
}

TEST(TraceWriter, RelationsWithManyDescriptorsHaveOneTransitionForAllOfThem) {
  std::size_t most = 0;
  for (const Json& event : record(case_named("many_descriptors")).events) {
    for (const Json& transition : event.value("transitions", Json::array())) {
      if (!transition.contains("descriptors")) continue;
      const auto list = transition["descriptors"].get<std::vector<std::uint32_t>>();
      EXPECT_TRUE(std::ranges::is_sorted(list));
      most = std::max(most, list.size());
    }
  }
  EXPECT_EQ(most, 84U);  // 9 default and 75 user publications
}

TEST(TraceWriter, ChannelNamesAreEscaped) {
  Scenario scenario = case_named("hosts2x1x2");
  for (Stage& stage : scenario.wireless.stages) stage.channel = "a \"b\"\n\xff";
  const Recording trace = record(scenario);
  EXPECT_EQ(trace.events[2]["channel"], "a \"b\"\n\xef\xbf\xbd");
}

TEST(TraceWriter, InterruptedRunHasACompleteTrace) {
  const Recording trace = record(long_scenario(), [](const Progress&) { return false; });
  EXPECT_EQ(trace.end["end"], "interrupted");
  EXPECT_EQ(trace.events.size(), RunOptions::progress_interval);
}

}  // namespace trace_writer_test
}  // namespace stormproof::model::trace
