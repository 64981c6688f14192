// Every random scenario is one that a file can describe: its text, which is also what RapidCheck
// prints, reads back as an equal scenario. And its run is short.
#include <algorithm>
#include <iostream>
#include <sstream>

#include <gtest/gtest.h>

#include "model/config/knobs/effective.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/scenario_file.hpp"
#include "model/simulator.hpp"
#include "props/generators/scenarios.hpp"

namespace stormproof::props {
namespace validity_test {

using model::Scenario;

constexpr std::uint64_t draws = 500;
constexpr std::uint64_t most_events = 200'000;

/// What `simulate` would read from this text.
testing::AssertionResult reads_back(const std::string& text, const Scenario& scenario) {
  const auto read =
      model::config::parse_scenario(text, "printed", {}, model::config::SpecPath::standard());
  if (!read) return testing::AssertionFailure() << read.error().message << '\n' << text;
  if (*read != scenario) return testing::AssertionFailure() << "another scenario:\n" << text;
  return testing::AssertionSuccess();
}

std::string shown(const Scenario& scenario) {
  std::ostringstream text;
  showValue(scenario, text);
  return text.str();
}

TEST(RandomScenario, SameSeedSameScenario) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(draw_scenario(seed, 100), draw_scenario(seed, 100));
    EXPECT_NE(draw_scenario(seed, 100), draw_scenario(seed + 1, 100));
  }
}

TEST(RandomScenario, PrintsAsAFileThatReadsBack) {
  for (std::uint64_t seed = 0; seed < draws; ++seed) {
    const Scenario scenario = draw_scenario(seed, 100);
    EXPECT_TRUE(reads_back(shown(scenario), scenario)) << "seed " << seed;
    EXPECT_TRUE(model::config::is_valid(scenario)) << "seed " << seed;
  }
}

TEST(RandomScenario, ReadingBackNoticesWhatAFileCannotSay) {
  Scenario scenario = draw_scenario(1, 100);
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  scenario.dds.sedp.heartbeat_bytes += model::Bytes{1};  // a constant there
  EXPECT_FALSE(reads_back(shown(scenario), scenario));
  scenario = draw_scenario(1, 100);
  scenario.deployment.participants.front().endpoints_done = model::Nanoseconds{-1};
  EXPECT_FALSE(reads_back(shown(scenario), scenario));
}

TEST(RandomScenario, RunsAreShort) {
  std::vector<std::uint64_t> events;
  int completed = 0;
  for (std::uint64_t seed = 0; seed < draws; ++seed) {
    model::RunOptions options;
    options.max_events = most_events;
    const model::RunResult result = model::simulate(draw_scenario(seed, 100), options);
    EXPECT_NE(result.end, model::RunEnd::interrupted) << "seed " << seed;
    events.push_back(result.events);
    completed += result.completed() ? 1 : 0;
  }
  std::ranges::sort(events);
  std::cout << completed << " of " << draws << " complete; events: median " << events[draws / 2]
            << ", most " << events.back() << '\n';
  EXPECT_GT(completed, static_cast<int>(draws * 35 / 100));
  EXPECT_LT(completed, static_cast<int>(draws * 65 / 100));
}

TEST(RandomScenario, SpaceIsKept) {
  ScenarioSpace space;
  space.implementation = model::ImplementationKind::fastdds;
  space.service = model::ServiceKind::constant_delay;
  space.max_participants = 3;
  space.max_endpoints = 1;
  space.losses = false;
  space.max_time_limit = model::Nanoseconds{2'000'000};
  space.run_until = model::RunUntil::completion;
  for (std::uint64_t seed = 0; seed < draws / 4; ++seed) {
    const Scenario scenario = draw_scenario(seed, 100, space);
    EXPECT_TRUE(reads_back(shown(scenario), scenario)) << "seed " << seed;
    EXPECT_EQ(scenario.dds.implementation, model::ImplementationKind::fastdds);
    EXPECT_EQ(scenario.wireless.kind, model::ServiceKind::constant_delay);
    EXPECT_LE(scenario.deployment.size(), 3U);
    EXPECT_TRUE(scenario.wireless.lost_packets.empty());
    EXPECT_LE(scenario.time_limit, space.max_time_limit);
    EXPECT_EQ(scenario.run_until, model::RunUntil::completion);
    for (const model::Participant& p : scenario.deployment.participants) {
      EXPECT_LE(std::max(p.publications, p.subscriptions), 1U);
    }
  }
}

TEST(RandomScenario, SizesGrow) {
  for (std::uint64_t seed = 0; seed < draws; ++seed) {
    EXPECT_EQ(draw_scenario(seed, 0).deployment.size(), 2U);
  }
}

}  // namespace validity_test
}  // namespace stormproof::props
