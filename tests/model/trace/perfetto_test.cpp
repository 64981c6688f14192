// The timeline is well-formed in the sense of its readers, and shows the run that happened.
#include "model/trace/perfetto.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "tests/model/trace/recording.hpp"

namespace stormproof::model::trace {
namespace perfetto_test {

using Json = nlohmann::ordered_json;
using TrackKey = std::pair<std::uint32_t, std::uint32_t>;

TrackKey track_of(const Json& event) {
  return {event["pid"].get<std::uint32_t>(), event.value("tid", 0U)};
}

std::int64_t time_of(const Json& event) { return std::llround(event["ts"].get<double>() * 1e3); }

class PerfettoTest : public testing::TestWithParam<Case> {
 protected:
  static bool fastdds() {
    return GetParam().scenario().dds.implementation == ImplementationKind::fastdds;
  }
};

TEST_P(PerfettoTest, SlicesOfARowNestAndEnd) {
  const Timeline& timeline = recorded_timeline(GetParam());
  std::map<TrackKey, std::vector<std::int64_t>> open;
  std::int64_t last = 0;
  for (const Json& event : timeline.document["traceEvents"]) {
    if (event["ph"] == "M") continue;
    EXPECT_GE(time_of(event), last);
    last = time_of(event);
    auto& stack = open[track_of(event)];
    if (event["ph"] == "B") stack.push_back(time_of(event));
    if (event["ph"] != "E") continue;
    ASSERT_FALSE(stack.empty()) << event;
    stack.pop_back();
  }
  for (const auto& [track, stack] : open) EXPECT_TRUE(stack.empty()) << track.second;
}

TEST_P(PerfettoTest, ChannelsAreBusyAsLongAsTheRunSays) {
  const Timeline& timeline = recorded_timeline(GetParam());
  std::map<std::uint32_t, std::int64_t> busy;
  std::map<std::uint32_t, int> depth;
  for (const Json& event : timeline.document["traceEvents"]) {
    if (event["pid"] != 1 || (event["ph"] != "B" && event["ph"] != "E")) continue;
    const std::uint32_t row = event["tid"];
    const bool begins = event["ph"] == "B";
    busy[row] += begins ? -time_of(event) : time_of(event);
    depth[row] += begins ? 1 : -1;
    EXPECT_LE(depth[row], 1) << "two services at once: " << event;
  }
  std::size_t channel = 0;
  for (const auto& [row, time] : busy) {
    ASSERT_LT(channel, timeline.result.channels.size());
    EXPECT_EQ(time, timeline.result.channels[channel++].total_busy().count());
  }
  EXPECT_EQ(channel, timeline.result.channels.size());
}

TEST_P(PerfettoTest, ArrowsStartOnceInsideASliceAndEndAfterThat) {
  const Timeline& timeline = recorded_timeline(GetParam());
  std::map<TrackKey, int> depth;
  std::set<std::pair<std::string, std::uint64_t>> started;
  std::set<std::pair<std::string, std::uint64_t>> ended;
  for (const Json& event : timeline.document["traceEvents"]) {
    if (event["ph"] == "B") ++depth[track_of(event)];
    if (event["ph"] == "E") --depth[track_of(event)];
    if (!event.contains("id")) continue;
    EXPECT_GT(depth[track_of(event)], 0) << event;
    const std::pair<std::string, std::uint64_t> id{event["cat"], event["id"]};
    const bool is_start = event["ph"] == "s";
    EXPECT_EQ(started.insert(id).second, is_start) << event;
    if (event["ph"] == "f") ended.insert(id);
  }
  std::set<std::pair<std::string, std::uint64_t>> emitted;
  std::set<std::pair<std::string, std::uint64_t>> arrived;
  for (const Json& event : recorded(GetParam()).events) {
    for (const Json& packet : event.value("emitted", Json::array())) {
      const std::size_t copies = packet["to"].is_array() ? packet["to"].size() : 1;
      for (std::size_t k = 0; k < copies; ++k) {
        emitted.emplace("packet", packet["packet"].get<std::uint64_t>() + k);
      }
    }
    if (event.contains("arrived")) {
      arrived.emplace("packet", event["arrived"]["packet"].get<std::uint64_t>());
    }
  }
  std::erase_if(started, [](const auto& id) { return id.first != "packet"; });
  std::erase_if(ended, [](const auto& id) { return id.first != "packet"; });
  EXPECT_EQ(started, emitted);
  // The others are under way when the run ends; or, with Fast DDS, arrived but not yet received.
  EXPECT_TRUE(std::ranges::includes(arrived, ended));
  EXPECT_LE(arrived.size() - ended.size(), fastdds() ? 10U : 0U);
}

TEST_P(PerfettoTest, CountersEndWhereTheRunEnds) {
  const Timeline& timeline = recorded_timeline(GetParam());
  std::uint64_t missing = 0;
  std::map<std::uint32_t, std::uint64_t> backlog;
  for (const Json& event : timeline.document["traceEvents"]) {
    if (event["ph"] != "C") continue;
    if (event["name"] == "missing") missing = event["args"]["descriptors"];
    if (event["name"] == "source") backlog[event["pid"]] = event["args"]["backlog packets"];
  }
  EXPECT_EQ(missing, timeline.result.missing_count);
  for (const auto& [process, packets] : backlog) {
    EXPECT_EQ(packets, timeline.result.backlog[process - 2].packets_at_end);
  }
}

TEST_P(PerfettoTest, EveryRowHasAName) {
  const Timeline& timeline = recorded_timeline(GetParam());
  std::set<TrackKey> named;
  std::set<std::uint32_t> threads;
  for (const Json& event : timeline.document["traceEvents"]) {
    if (event.value("name", "") == "thread_name") {
      named.insert(track_of(event));
      EXPECT_TRUE(threads.insert(event["tid"].get<std::uint32_t>()).second);
    }
    if (event["ph"] == "B") {
      EXPECT_TRUE(named.contains(track_of(event))) << event;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, PerfettoTest, testing::ValuesIn(trace_cases()), CaseName{});

TEST(Perfetto, TimesAreExactMicroseconds) {
  const Timeline timeline = record_timeline(case_named("hosts2x1x2"));
  const Json& last = timeline.document["traceEvents"].back();
  EXPECT_EQ(last["ts"].dump(), "16136.228");
}

TEST(Perfetto, AnInterruptedRunHasACompleteDocument) {
  const Timeline timeline = record_timeline(long_scenario(), [](const Progress&) { return false; });
  EXPECT_EQ(timeline.result.end, RunEnd::interrupted);
  EXPECT_GT(timeline.document["traceEvents"].size(), 1000U);
}

TEST(Perfetto, LostPacketsShowAtTheirSender) {
  std::set<std::string> lost;
  const Timeline timeline = record_timeline(case_named("v1"));
  for (const Json& event : timeline.document["traceEvents"]) {
    const std::string name = event.value("name", "");
    if (name.rfind("lost: ", 0) == 0) lost.insert(event["args"]["packet"].dump());
  }
  EXPECT_EQ(lost, (std::set<std::string>{"22", "36"}));
}

}  // namespace perfetto_test
}  // namespace stormproof::model::trace
