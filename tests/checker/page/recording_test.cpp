// What the page shows of a run is what the run did: pictures and moments agree with its result, and
// with each other, for each implementation.
#include "checker/page/recording.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

#include <gtest/gtest.h>

#include "checker/page/knowledge.hpp"
#include "checker/page/moment.hpp"
#include "model/config/scenario_file.hpp"
#include "model/engine/topology.hpp"
#include "model/simulator.hpp"

namespace stormproof::page {
namespace recording_test {

model::Scenario scenario_with(const std::string& dds) {
  const auto specs = model::config::SpecPath::standard();
  auto read = model::config::parse_scenario(
      "{deployment: {hosts: 2, participants_per_host: 2, endpoints_per_participant: 6},"
      " wireless: wifi-80211n-paper, time_limit: 20s, dds: " +
          dds + "}",
      "scenario", {}, specs);
  EXPECT_TRUE(read) << read.error().where << read.error().message;
  return *read;
}

class Recordings : public testing::TestWithParam<const char*> {};

TEST_P(Recordings, EndAsTheRunDoes) {
  const model::Scenario scenario = scenario_with(GetParam());
  const model::RunResult result = model::simulate(scenario);
  const Recording recording = record(scenario, 40);
  ASSERT_EQ(recording.pictures.size(), 40U);
  EXPECT_EQ(recording.result.discovery_time, result.discovery_time);
  ASSERT_TRUE(result.completed());
  const Picture& last = recording.pictures.back();
  EXPECT_EQ(last.time, result.end_time);
  EXPECT_EQ(last.events, result.events);
  EXPECT_EQ(last.missing, 0U);
  std::uint64_t events = 0;
  std::uint64_t missing = UINT64_MAX;
  for (const Picture& picture : recording.pictures) {
    EXPECT_GE(picture.events, events);
    EXPECT_LE(picture.missing, missing);
    events = picture.events;
    missing = picture.missing;
  }
  EXPECT_GT(recording.pictures.front().missing, 0U);
  // Everybody knows everybody on another host at the end, and nobody at the beginning.
  const std::size_t size = scenario.deployment.size();
  ASSERT_EQ(recording.known.size(), 40 * size * size);
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) {
      const auto& all = scenario.deployment.participants;
      if (all[i].host == all[j].host) continue;
      EXPECT_EQ(recording.known[i * size + j], 0) << i << " " << j;
      EXPECT_EQ(recording.known[(39 * size + i) * size + j], 255) << i << " " << j;
    }
  }
}

TEST_P(Recordings, StopAtEachEvent) {
  const model::Scenario scenario = scenario_with(GetParam());
  const std::uint64_t events = model::simulate(scenario).events;
  std::uint64_t stepped = 0;
  for (std::uint64_t event = 0; event <= events; event += 1 + events / 50) {
    const Moment moment = moment_of(scenario, event, 1);
    EXPECT_EQ(moment.event, event);
    stepped += moment.steps.size();
    const model::Topology topology = model::topology_of(scenario);
    for (const ReaderStates& states : moment.readers) {
      EXPECT_EQ(std::accumulate(states.counts.begin(), states.counts.end(), 0U),
                topology.descriptor_count(1, states.stream));
    }
  }
  EXPECT_GT(stepped, 0U);
  EXPECT_EQ(moment_of(scenario, events + 7, 1).event, events);
}

/// After each event, what is not known of pairs that count is what the run says is missing.
class MissingKnowledge final : public model::Probe {
 public:
  explicit MissingKnowledge(const model::Scenario& scenario)
      : scenario_{scenario}, knowledge_{scenario} {}

  void run_started(const model::Topology& topology) override {
    topology_ = &topology;
    knowledge_.run_started(topology);
  }
  void transition(const model::Transition& fired) override { knowledge_.transition(fired); }
  void received(const model::Packet& packet, std::uint32_t) override {
    knowledge_.received(packet);
  }
  void event_finished(const model::Depths& depths) override {
    std::uint64_t missing = 0;
    const std::size_t clients = scenario_.deployment.size();
    const bool of_one_host = clients < topology_->participant_count();  // with a server
    for (std::uint32_t pair = 0; pair < topology_->pair_count(); ++pair) {
      const model::Pair& ends = topology_->pair(pair);
      if (std::max(ends.source, ends.destination) >= clients) continue;
      if (ends.cross_host || of_one_host) missing += knowledge_.all(pair) - knowledge_.known(pair);
    }
    differences += missing != depths.missing;
    ++events;
  }

  std::uint64_t events = 0;
  std::uint64_t differences = 0;

 private:
  const model::Scenario& scenario_;
  const model::Topology* topology_ = nullptr;
  Knowledge knowledge_;
};

TEST_P(Recordings, KnowWhatIsMissingAfterEachEvent) {
  model::Scenario scenario = scenario_with(GetParam());
  scenario.wireless.lost_packets = {12, 40, 41, 90};
  MissingKnowledge probe{scenario};
  model::RunOptions options;
  options.probe = &probe;
  (void)model::simulate(scenario, options);
  EXPECT_GT(probe.events, 100U);
  EXPECT_EQ(probe.differences, 0U);
}

TEST_P(Recordings, FindTheParticipantsOwnSteps) {
  const model::Scenario scenario = scenario_with(GetParam());
  const std::uint64_t events = model::simulate(scenario).events;
  const auto next = next_step_of(scenario, events / 2, 1);
  ASSERT_TRUE(next);
  EXPECT_GT(*next, events / 2);
  const Moment there = moment_of(scenario, *next, 1);
  EXPECT_TRUE(std::ranges::any_of(there.steps, &Step::mine));
  const auto before = step_before_of(scenario, *next, 1);
  ASSERT_TRUE(before);
  EXPECT_LE(*before, events / 2);
  EXPECT_FALSE(next_step_of(scenario, events, 1));
  EXPECT_FALSE(step_before_of(scenario, 1, 1));
}

INSTANTIATE_TEST_SUITE_P(All, Recordings,
                         testing::Values("paper", "fastdds-2.6.11", "fastdds-3.6",
                                         "cyclonedds-0.10", "fastdds-server-2.6.11"),
                         [](const auto& one) {
                           std::string name = one.param;
                           std::erase_if(name, [](char c) { return !std::isalnum(c); });
                           return name;
                         });

TEST(Moment, NamesTheRulesOfAnEvent) {
  const model::Scenario scenario = scenario_with("fastdds-2.6.11");
  Moment moment = moment_of(scenario, 1, 0);
  for (std::uint64_t event = 2; moment.what != "announcement" && event < 200; ++event) {
    moment = moment_of(scenario, event, 0);
  }
  ASSERT_FALSE(moment.effects.empty());
  const std::string& effect = moment.effects.front();
  EXPECT_EQ(effect.substr(0, effect.find('.')), "AnnouncementIsDue");
  EXPECT_FALSE(moment.packets.empty());
}

}  // namespace recording_test
}  // namespace stormproof::page
