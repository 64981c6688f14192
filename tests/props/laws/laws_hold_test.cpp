// Every law holds on random scenarios of both implementations that engines know; and says something
// about a fair share of them, so that none holds because it is never tried. Those that say
// something about Cyclone DDS hold there, too.
#include <algorithm>
#include <ostream>
#include <set>

#include <gtest/gtest.h>

#include "model/implementations.hpp"
#include "model/mutation.hpp"
#include "model/simulator.hpp"
#include "props/generators/dice.hpp"
#include "props/generators/on_demand.hpp"
#include "props/generators/space.hpp"
#include "tests/props/laws/law_check.hpp"

namespace stormproof::props {

/// GoogleTest prints the law of a failing test by its statement.
static void PrintTo(const Law& law, std::ostream* out) { *out << law.id << ": " << law.statement; }

namespace laws_hold_test {

std::string test_name(const testing::TestParamInfo<Law>& info) {
  std::string name{info.param.id.substr(info.param.id.find('.') + 1)};
  std::ranges::replace(name, '-', '_');
  return name;
}

class LawTest : public testing::TestWithParam<Law> {};
INSTANTIATE_TEST_SUITE_P(Every, LawTest, testing::ValuesIn(laws().begin(), laws().end()),
                         test_name);

TEST_P(LawTest, Holds) {
  const auto broken = broken_on_random_scenarios(GetParam(), correct);
  EXPECT_FALSE(broken) << *broken;
}

/// Where much is lost and late, and endpoints come late, those who watch a run object to no correct
/// one.
TEST_P(LawTest, HoldsInDisturbedRunsIfItWatchesOne) {
  if (GetParam().watch == nullptr) return;
  const Simulate beginning = [](const model::Scenario& scenario, model::Probe* probe) {
    model::RunOptions options;
    options.probe = probe;
    options.max_events = 5'000;
    return model::simulate(scenario, options);
  };
  for (const auto kind : {model::ImplementationKind::paper, model::ImplementationKind::fastdds}) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      model::Scenario scenario = draw_scenario(seed, 50,
                                               {.implementation = kind,
                                                .service = model::ServiceKind::constant_delay,
                                                .max_participants = 3,
                                                .max_endpoints = 2});
      Dice dice{seed};
      draw_disturbances(dice, scenario);
      scenario.time_limit = model::Nanoseconds{4'000'000'000};
      if (!speaks_of(GetParam(), scenario)) continue;
      const auto broken = GetParam().broken(scenario, beginning);
      ASSERT_FALSE(broken) << model::traits_of(kind).name << ", seed " << seed << ": " << *broken;
    }
  }
}

/// Clients and super clients of a Discovery Server.
model::Scenario with_server(std::uint64_t seed) {
  ScenarioSpace space{.implementation = model::implementation_with_discovery};
  space.max_participants = 4;
  space.max_endpoints = 4;
  model::Scenario scenario = draw_scenario(seed, 50, space);
  using enum model::Discovery;
  draw_discovery(seed, seed % 2 == 0 ? server : super_client, scenario);
  return scenario;
}

TEST_P(LawTest, HoldsWithAServerIfItSpeaksOfIt) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const model::Scenario scenario = with_server(seed);
    if (!speaks_of(GetParam(), scenario)) continue;
    const auto broken = GetParam().broken(scenario, correct);
    EXPECT_FALSE(broken) << "seed " << seed << ": " << *broken;
  }
}

TEST(Laws, SomeSpeakOfAServer) {
  std::set<std::string_view> ids;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    for (const Law& law : laws()) {
      if (speaks_of(law, with_server(seed))) ids.insert(law.id);
    }
  }
  EXPECT_EQ(ids.size(), 19U);
}

/// The reason why the law is broken on one of some scenarios with a server.
std::optional<std::string> broken_with_server(std::string_view id, const Simulate& simulate) {
  const Law& law = *std::ranges::find(laws(), id, &Law::id);
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const model::Scenario scenario = with_server(seed);
    if (!speaks_of(law, scenario)) continue;
    if (auto broken = law.broken(scenario, simulate)) return broken;
  }
  return std::nullopt;
}

TEST(LawsOfAServer, NoticeMistakes) {
  const auto late = [](model::EventKind kind) {
    return [kind](const model::Scenario& scenario, model::Probe* probe) {
      model::Mutation mutation;
      mutation.events.push_back(
          {kind, model::EventMutation::Change::shift, model::Nanoseconds{1}, {}});
      model::RunOptions options;
      options.probe = probe;
      options.mutation = &mutation;
      options.max_events = 50'000;
      return model::simulate(scenario, options);
    };
  };
  for (const auto kind : {model::EventKind::client_sync, model::EventKind::server_routine_again}) {
    EXPECT_TRUE(broken_with_server("law.time-scaling", late(kind))) << static_cast<int>(kind);
  }
  EXPECT_TRUE(
      broken_with_server("law.physical-bound", [](model::Scenario scenario, model::Probe* p) {
        scenario.dds.server.client_sync_period = model::Nanoseconds{1'000};
        return correct(scenario, p);
      }));
}

TEST_P(LawTest, AppliesOften) {
  int applied = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    if (GetParam().applies(draw_scenario(seed, 50))) ++applied;
  }
  EXPECT_GE(applied, 15);
}

/// The floor of a server is the tick; the routine's period may pass unused, since whatever arrives
/// wakes the routine.
TEST(LawsOfAServer, KnowNoMoreThanATick) {
  model::Scenario scenario;
  scenario.dds.implementation = model::implementation_with_discovery;
  scenario.dds.discovery = model::Discovery::server;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 20);
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = model::Nanoseconds{100'000};
  const auto took = [&](std::int64_t endpoints_done_ms) {
    for (model::Participant& p : scenario.deployment.participants) {
      p.endpoints_done = p.start + model::Nanoseconds{endpoints_done_ms * 1'000'000};
    }
    return correct(scenario, nullptr).discovery_time.value_or(scenario.time_limit);
  };
  const model::Nanoseconds tick = scenario.dds.server.client_sync_period;
  const model::Nanoseconds both = tick + scenario.dds.server.server_routine_period;
  EXPECT_GT(took(40), both);
  EXPECT_LT(took(520), both);
  EXPECT_GT(took(520), tick);
}

class CycloneLawTest : public testing::TestWithParam<Law> {};
INSTANTIATE_TEST_SUITE_P(Every, CycloneLawTest,
                         testing::ValuesIn(laws_of(model::ImplementationKind::cyclone)), test_name);

TEST_P(CycloneLawTest, Holds) {
  const auto broken = broken_on_random_scenarios(
      GetParam(), correct, {.implementation = model::ImplementationKind::cyclone});
  EXPECT_FALSE(broken) << *broken;
}

TEST(Laws, SpeakOfCycloneDds) {
  EXPECT_EQ(laws_of(model::ImplementationKind::cyclone).size(), 21U);
}

TEST(Laws, HaveUniqueIdsAndStatementsOfOneLine) {
  std::set<std::string_view> ids;
  for (const Law& law : laws()) {
    EXPECT_TRUE(ids.insert(law.id).second) << law.id;
    EXPECT_TRUE(law.id.starts_with("law."));
    EXPECT_TRUE(law.statement.ends_with('.')) << law.id;
    EXPECT_EQ(law.statement.find('\n'), std::string_view::npos) << law.id;
  }
  EXPECT_GE(ids.size(), 20U);
}

}  // namespace laws_hold_test
}  // namespace stormproof::props
