// Runs over queues that drop: what the result counts is what a probe hears of; a packet of which a
// station dropped a fragment is received by nobody, and all of it leaves its source.
#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "model/engine/packet.hpp"
#include "model/simulator.hpp"
#include "model/trace/packet_text.hpp"

namespace stormproof::model {
namespace dropping_queues_test {

constexpr std::uint32_t per_host = 3;

class Drops final : public Probe {
 public:
  void emitted(const Packet& packet, std::uint32_t, std::span<const std::uint32_t>) override {
    emitted_ += packet.copies;
  }
  void dropped(std::uint32_t, std::uint32_t stage, const Packet& packet, std::uint32_t) override {
    ++(stage == 0 ? counted.at_stations
                  : counted.at_access_points)[static_cast<std::size_t>(traffic_class(packet))];
    if (stage == 0) nobodys.insert(packet.number);
  }
  void source_completed(const Packet& packet) override { left.insert(packet.number); }
  void received(const Packet& packet, std::uint32_t receiver) override {
    const std::uint32_t sender = trace::packet_ends(packet, *topology_).from;
    if (host_of(sender) == host_of(receiver)) return;  // packets on a host have no number
    EXPECT_FALSE(nobodys.contains(packet.number)) << packet.number;
  }
  void run_started(const Topology& topology) override { topology_ = &topology; }
  [[nodiscard]] std::uint64_t emitted_packets() const { return emitted_; }

  DroppedFrames counted;
  std::set<std::uint64_t> nobodys;
  std::set<std::uint64_t> left;

 private:
  static std::uint32_t host_of(std::uint32_t participant) { return participant / per_host; }

  const Topology* topology_ = nullptr;
  std::uint64_t emitted_ = 0;
};

Scenario scenario_with(const std::string& wireless) {
  const std::string text =
      "deployment: {hosts: 2, participants_per_host: 3, endpoints_per_participant: 20}\n"
      "dds: fastdds-2.6.11\nwireless: {base: wifi-80211n-ampdu, aggregation: {max_frames: 2}, " +
      wireless + "}\ntime_limit: 5s\n";
  auto read = config::parse_scenario(text, "test.yaml", {}, config::SpecPath::standard());
  EXPECT_TRUE(read) << (read ? "" : to_string(read.error()));
  return read ? *read : Scenario{};
}

class DroppingQueues : public testing::TestWithParam<const char*> {};

TEST_P(DroppingQueues, AreCountedAsTheyDrop) {
  const Scenario scenario = scenario_with(GetParam());
  Drops drops;
  RunOptions options;
  options.probe = &drops;
  const RunResult result = simulate(scenario, options);
  ASSERT_TRUE(result.dropped);
  EXPECT_EQ(*result.dropped, drops.counted);
  EXPECT_NE(*result.dropped, DroppedFrames{});
  EXPECT_LT(drops.nobodys.size(), drops.emitted_packets());
  EXPECT_TRUE(std::ranges::includes(drops.left, drops.nobodys)) << "a source keeps a packet";
  const RunResult again = simulate(scenario);
  EXPECT_EQ(again.dropped, result.dropped);
  EXPECT_EQ(again.end_time, result.end_time);
}

INSTANTIATE_TEST_SUITE_P(
    Each, DroppingQueues,
    testing::Values("queue: {discipline: tail_drop, max_frames: 20}",
                    "queue: {discipline: tail_drop, max_bytes: 9000, of: stations}",
                    "queue: {discipline: codel, target: 1ms, interval: 10ms}",
                    "queueing: flows, queue: {discipline: fq_codel, max_frames: 30, target: 1ms}"));

TEST(UnlimitedQueues, ChangeNothing) {
  const Scenario plain = scenario_with("queueing: flows");
  Scenario unlimited = plain;
  unlimited.wireless.queue.emplace();
  const RunResult one = simulate(plain);
  const RunResult other = simulate(unlimited);
  EXPECT_FALSE(other.dropped);
  EXPECT_EQ(one.end_time, other.end_time);
  EXPECT_EQ(one.events, other.events);
  EXPECT_EQ(one.counts, other.counts);
}

/// What happens in each period of three seconds, from a time on: every event with its time in the
/// period, every step of a machine, every frame that is dropped.
class Periods final : public Probe {
 public:
  static constexpr std::int64_t length_ns = 3'000'000'000;

  void event_started(const Event& event) override {
    const std::int64_t time = event.time.count() - begin_ns;
    if (time < 0) return;
    list.resize(static_cast<std::size_t>(time / length_ns) + 1);
    note("{} {}", time % length_ns, name_of(event.kind));
  }
  void transition(const Transition& fired) override {
    note("{} {} {} {}", fired.machine.machine, fired.machine.subject, fired.event, fired.after);
  }
  void dropped(std::uint32_t, std::uint32_t stage, const Packet& packet,
               std::uint32_t fragment) override {
    note("drop {} {} {}", stage, name_of(packet.kind), fragment);
  }

  std::vector<std::vector<std::string>> list;

 private:
  static constexpr std::int64_t begin_ns = 10'000'000'000;

  template <class... Args>
  void note(fmt::format_string<Args...> format, Args&&... args) {
    if (!list.empty()) list.back().push_back(fmt::format(format, std::forward<Args>(args)...));
  }
};

config::Result<Scenario> endless(const std::vector<std::string>& overrides = {}) {
  return config::read_scenario(STORMPROOF_SPECS_DIR "/findings/queues-that-drop.yaml", overrides,
                               config::SpecPath::standard());
}

TEST(EndlessRepairs, APeriodIsLikeTheOneBefore) {
  const auto scenario = endless({"time_limit=160s"});
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  Periods periods;
  RunOptions options;
  options.probe = &periods;
  const RunResult result = simulate(*scenario, options);
  EXPECT_EQ(result.end, RunEnd::time_limit);
  EXPECT_EQ(result.missing_count, 234U) << "all that each process has";
  ASSERT_EQ(periods.list.size(), 50U);
  for (std::size_t k = 1; k + 1 < periods.list.size(); ++k) {
    ASSERT_EQ(periods.list[k], periods.list[0]) << "period " << k;
  }
  EXPECT_GT(std::ranges::count(periods.list[0], "drop 1 data 17"), 0);
}

/// A repair has 18 frames, and two HEARTBEATs are in the queue before it.
TEST(EndlessRepairs, EndWithRoomForOneOfThemOrWithSmallerOnes) {
  for (const std::string cure : {"wireless.queue.max_frames=20", "dds.max_data_per_message=31",
                                 "wireless.aggregation.max_frames=1", "dds=cyclonedds-0.10"}) {
    const auto scenario = endless({cure});
    ASSERT_TRUE(scenario) << to_string(scenario.error());
    const RunResult result = simulate(*scenario);
    ASSERT_TRUE(result.completed()) << cure;
    EXPECT_LT(*result.discovery_time, Nanoseconds{4'000'000'000}) << cure;
  }
}

}  // namespace dropping_queues_test
}  // namespace stormproof::model
