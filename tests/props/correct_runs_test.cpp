// All monitors on correct runs: the shipped scenarios, and random ones of both implementations that
// use every knob. What they find there is true, so the test says for which scenarios a property may
// be violated, and that all others never are.

#include <algorithm>

#include <gtest/gtest.h>

#include "model/airtime.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/fastdds/peer_ports.hpp"
#include "model/implementations.hpp"
#include "props/applicability.hpp"
#include "props/generators/on_demand.hpp"
#include "props/generators/space.hpp"
#include "tests/oracle/random_scenario.hpp"
#include "tests/oracle/sharp_scenario.hpp"
#include "tests/props/monitored_run.hpp"

namespace stormproof::props {
namespace correct_runs_test {

using model::Scenario;

bool is_fastdds(const Scenario& scenario) {
  return scenario.dds.implementation == model::ImplementationKind::fastdds;
}

/// A packet may arrive at the very instant of its emission.
bool has_link_without_delay(const Scenario& scenario) {
  const bool loops_back = model::traits_of(scenario.dds).discovers_same_host;
  if (loops_back && scenario.deployment.loopback_delay.count() == 0) return true;
  if (scenario.wireless.kind == model::ServiceKind::constant_delay) {
    const auto& delays = scenario.wireless.packet_delays;
    return scenario.wireless.one_way.count() == 0 ||
           std::ranges::any_of(delays, [](const auto& d) { return d.one_way.count() == 0; });
  }
  const model::WirelessProfile& w = scenario.wireless;
  if (w.service == model::ServedBy::unit && w.aggregation.overhead.count() == 0 &&
      model::ServiceRate{0, w.rate_unicast.count()}.airtime_ns(2) == 0) {
    return true;
  }
  return std::ranges::any_of(scenario.wireless.stages, [&](const model::Stage& stage) {
    return model::service_rate(scenario.wireless, stage, false).airtime_ns(1) == 0 ||
           model::service_rate(scenario.wireless, stage, true).airtime_ns(1) == 0;
  });
}

/// A HEARTBEAT may get lost: on its way, or at a reader side that is not open yet.
bool may_lose_heartbeats(const Scenario& scenario) {
  return !scenario.wireless.lost_packets.empty() ||
         (!is_fastdds(scenario) &&
          scenario.dds.sedp.relation_opening == model::RelationOpening::each_side);
}

/// Whether a correct run of the scenario may violate the property.
bool may_violate(const Scenario& scenario, std::string_view property) {
  if (!applicability_of(property, scenario).applies()) return true;
  // Amended rules have the defects that these properties are about.
  if (scenario.dds.amendments && property != "safety.conservation" &&
      property != "order.reception-first") {
    return true;
  }
  if (property == "order.reception-first") return has_link_without_delay(scenario);
  if (property == "timer.single-heartbeat") {
    return !is_fastdds(scenario) &&
           scenario.dds.sedp.heartbeat_timer == model::HeartbeatTimerKind::additive &&
           scenario.dds.sedp.heartbeat_policy == model::HeartbeatPolicy::periodic;
  }
  if (property == "live.no-stall" || property == "live.completion") {
    return !model::fastdds::announcements_reach_all(scenario);
  }
  // An initial ACKNACK that another one overtakes looks like one of a reader that forgot (E16).
  if (property == "safety.ack-stable") return !scenario.wireless.packet_delays.empty();
  if (property == "live.quiescence") {
    return !is_fastdds(scenario) && may_lose_heartbeats(scenario);
  }
  return property == "timer.suppression-honoured" || property == "storm.single-copy" ||
         property == "storm.free-threshold" || property == "storm.cannot-start" ||
         property == "storm.join-cost" || property == "storm.piggyback-rate";
}

void expect_only_true_findings(const Scenario& scenario, const std::string& name,
                               const model::RunOptions& options = {}) {
  const MonitoredRun run = run_monitored(scenario, scenario, options);
  for (const auto& monitor : run.monitors) {
    if (!monitor->violation() || may_violate(scenario, monitor->property())) continue;
    ADD_FAILURE() << name << ": " << monitor->property() << " at event "
                  << monitor->violation()->event << ": " << monitor->violation()->reason;
  }
}

class ShippedScenarios : public testing::TestWithParam<const char*> {};

TEST_P(ShippedScenarios, HaveTrueFindingsOnly) {
  expect_only_true_findings(shipped(GetParam()), GetParam());
}

INSTANTIATE_TEST_SUITE_P(All, ShippedScenarios,
                         testing::Values("smallest", "staggered-joins", "three-hosts", "wired-5x20",
                                         "wifi-5x20", "live-5x20"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(CorrectRuns, ConstantDelayHasNothingToObjectTo) {
  const MonitoredRun run = run_monitored(shipped(
      "wifi-5x20", {"wireless={kind: constant_delay, one_way: 100us}", "dds.sedp.piggyback=off",
                    "dds.spdp.resend=new_only", "run_until=time_limit"}));
  EXPECT_EQ(run.violated(), "");
  EXPECT_EQ(run.result.counts.repair_data, 0U);
}

class RandomRuns : public testing::TestWithParam<int> {
 protected:
  /// Runs the scenarios that this part of the seeds draws.
  template <class Draw>
  static void each(std::string_view what, const model::RunOptions& options, const Draw& draw) {
    constexpr int runs_each = 40;
    for (int k = 0; k < runs_each; ++k) {
      const auto seed = static_cast<std::uint64_t>(runs_each * GetParam() + k);
      const std::string name = std::string{what} + ", seed " + std::to_string(seed);
      SCOPED_TRACE(name);
      expect_only_true_findings(draw(seed), name, options);
    }
  }
  static model::RunOptions short_runs() {
    model::RunOptions options;
    options.max_events = 3'000;
    return options;
  }
};

TEST_P(RandomRuns, OfThePapersProtocolHaveTrueFindingsOnly) {
  each("paper", {}, [](std::uint64_t seed) {
    Scenario scenario = oracle::random_scenario(seed);
    if (seed % 2 == 1) scenario.run_until = model::RunUntil::time_limit;
    return scenario;
  });
}

TEST_P(RandomRuns, OfFastDdsHaveTrueFindingsOnly) {
  each("fastdds", {}, [](std::uint64_t seed) {
    Scenario scenario = oracle::random_fastdds_scenario(seed);
    scenario.dds.implementation = model::ImplementationKind::fastdds;
    if (seed % 2 == 1) scenario.run_until = model::RunUntil::time_limit;
    return scenario;
  });
}

TEST_P(RandomRuns, OfCycloneDdsHaveTrueFindingsOnly) {
  each("cyclone", short_runs(), oracle::varied_cyclone_scenario);
}

TEST_P(RandomRuns, WithStaticPeersHaveTrueFindingsOnly) {
  each("static peers", short_runs(), [](std::uint64_t seed) {
    Scenario scenario = oracle::random_fastdds_scenario(seed);
    draw_discovery(seed, model::Discovery::static_peers, scenario);
    if (seed % 2 == 1) scenario.run_until = model::RunUntil::time_limit;
    return scenario;
  });
}

TEST_P(RandomRuns, WithAServerHaveTrueFindingsOnly) {
  each("server", short_runs(), [](std::uint64_t seed) {
    Scenario scenario = oracle::random_fastdds_scenario(seed);
    using enum model::Discovery;
    draw_discovery(seed, seed % 3 == 0 ? super_client : server, scenario);
    if (seed % 2 == 1) scenario.run_until = model::RunUntil::time_limit;
    return scenario;
  });
}

TEST_P(RandomRuns, OfLaterVersionsHaveTrueFindingsOnly) {
  each("versions", short_runs(), [](std::uint64_t seed) {
    Scenario scenario = oracle::random_version_scenario(seed);
    if (seed % 2 == 1) scenario.run_until = model::RunUntil::time_limit;
    return scenario;
  });
}

TEST_P(RandomRuns, WithTypesHaveTrueFindingsOnly) {
  each("types", short_runs(), oracle::random_lookup_scenario);
}

/// Two hosts; who is at no port that is asked is found if it hears of somebody who then answers.
Scenario with_one_port(const std::string& participants) {
  return shipped("wifi-5x20-fastdds",
                 {"dds=fastdds-static-2.6.11", "dds.peer_ports=1", "run_until=time_limit",
                  "time_limit=30s", "deployment={participants: " + participants + "}"});
}

TEST(CorrectRuns, StaticPeersThatAreNeverAskedStall) {
  EXPECT_EQ(applicability_of("live.completion", shipped("smallest", {"dds=fastdds-static-2.6.11"}))
                .why_not_provable,
            "");
  const std::string one = "{host: 0, publications: 1, subscriptions: 1}";
  const std::string other = "{host: 1, publications: 1, subscriptions: 1}";
  const Scenario answered = with_one_port("[" + one + ", " + other + ", " + other + "]");
  EXPECT_NE(applicability_of("live.completion", answered).why_not_provable, "");
  const MonitoredRun found = run_monitored(answered);
  EXPECT_TRUE(found.result.discovery_time);
  EXPECT_EQ(found.violation("live.no-stall"), nullptr);
  EXPECT_EQ(found.violation("live.completion"), nullptr);
  const MonitoredRun never =
      run_monitored(with_one_port("[" + one + ", " + one + ", " + other + ", " + other + "]"));
  EXPECT_FALSE(never.result.discovery_time);
  EXPECT_NE(never.violation("live.no-stall"), nullptr);
  EXPECT_NE(never.violation("live.completion"), nullptr);
}

TEST_P(RandomRuns, OverUnitsAndWithSendersThatStallHaveTrueFindingsOnly) {
  each("Wi-Fi", short_runs(), oracle::varied_wifi_scenario);
}

TEST_P(RandomRuns, OverListedHostsLossesAndProcessorsHaveTrueFindingsOnly) {
  each("fleet", short_runs(), oracle::varied_fleet_scenario);
}

TEST_P(RandomRuns, OverQueuesThatDropHaveTrueFindingsOnly) {
  each("queue", short_runs(), oracle::varied_queue_scenario);
}

/// Rules and lives of the museum: valid as drawn, and the network keeps its own rules whatever
/// writers and readers do over it.
TEST_P(RandomRuns, OfAmendedRulesHaveTrueFindingsOnly) {
  each("amended", short_runs(), [](std::uint64_t seed) {
    Scenario amended =
        draw_scenario(seed, 100, {.implementation = model::ImplementationKind::paper});
    Dice dice{seed};
    draw_amendments(dice, amended);
    EXPECT_TRUE(model::config::is_valid(amended));
    return amended;
  });
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomRuns, testing::Range(0, 6));

}  // namespace correct_runs_test
}  // namespace stormproof::props
