// What a counterexample has, it needs: without any one of its participants, endpoints, losses and
// late packets the property does not break as early.
#include "checker/verification/counterexample/minimal.hpp"

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include "checker/engines/smt/claims.hpp"
#include "checker/verification/check/check.hpp"
#include "checker/verification/counterexample/observe.hpp"
#include "checker/verification/counterexample/write.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "tests/checker/verification/counterexample/examples.hpp"

namespace stormproof::counterexample {
namespace minimal_test {

using model::Nanoseconds;
using model::Scenario;

std::size_t endpoints_of(const Scenario& scenario) {
  std::size_t count = 0;
  for (const model::Participant& one : scenario.deployment.participants) {
    count += one.publications + one.subscriptions;
  }
  return count;
}

bool breaks_as_early(const Scenario& scenario, const props::Counterexample& than) {
  if (!model::config::is_valid(scenario)) return false;
  const auto monitor = props::make_monitor(than.property, scenario);
  const auto violation = observe(scenario, *monitor, nullptr, than.event + 1);
  return violation && violation->event <= than.event;
}

void expect_minimal(const props::Counterexample& counterexample) {
  EXPECT_EQ(refuted(counterexample), std::nullopt) << counterexample.property;
  const Scenario& whole = counterexample.scenario;
  const auto expect_needed = [&](const char* what, std::size_t which,
                                 const std::function<void(Scenario&)>& remove) {
    Scenario less = whole;
    less.deployment.schedule.reset();
    remove(less);
    EXPECT_FALSE(breaks_as_early(less, counterexample))
        << counterexample.property << " does not need " << what << " " << which;
  };
  for (std::size_t k = 0; k < whole.wireless.packet_delays.size(); ++k) {
    expect_needed("packet delay", k, [k](Scenario& s) {
      s.wireless.packet_delays.erase(s.wireless.packet_delays.begin() +
                                     static_cast<std::ptrdiff_t>(k));
    });
  }
  for (std::size_t k = 0; k < whole.wireless.lost_packets.size(); ++k) {
    expect_needed("loss", k, [k](Scenario& s) {
      s.wireless.lost_packets.erase(s.wireless.lost_packets.begin() +
                                    static_cast<std::ptrdiff_t>(k));
    });
  }
  for (std::size_t k = 0; k < whole.deployment.participants.size(); ++k) {
    const model::Participant& one = whole.deployment.participants[k];
    if (whole.deployment.participants.size() > 2) {
      expect_needed("participant", k, [k](Scenario& s) {
        s.deployment.participants.erase(s.deployment.participants.begin() +
                                        static_cast<std::ptrdiff_t>(k));
      });
    }
    if (one.publications > 0) {
      expect_needed("a publication of participant", k,
                    [k](Scenario& s) { --s.deployment.participants[k].publications; });
    }
    if (one.subscriptions > 0) {
      expect_needed("a subscription of participant", k,
                    [k](Scenario& s) { --s.deployment.participants[k].subscriptions; });
    }
  }
}

TEST(Minimal, WhatIsAddedToACounterexampleIsTakenAway) {
  props::Counterexample padded = delayed();
  const props::Counterexample plain = minimal(delayed());
  expect_minimal(plain);
  padded.scenario = plain.scenario;
  for (model::Participant& one : padded.scenario.deployment.participants) ++one.subscriptions;
  for (std::uint64_t packet = 30'000; packet < 30'004; ++packet) {
    padded.scenario.wireless.packet_delays.push_back(
        {packet, Nanoseconds{0}, padded.scenario.wireless.one_way});
  }
  padded.scenario.wireless.lost_packets.push_back(40'000);
  const auto monitor = props::make_monitor(padded.property, padded.scenario);
  const auto violation = observe(padded.scenario, *monitor);
  ASSERT_TRUE(violation);
  padded.event = violation->event;
  const props::Counterexample again = minimal(padded);
  expect_minimal(again);
  EXPECT_LE(endpoints_of(again.scenario), endpoints_of(plain.scenario));
  EXPECT_LE(again.scenario.wireless.packet_delays.size(),
            plain.scenario.wireless.packet_delays.size());
  EXPECT_TRUE(again.scenario.wireless.lost_packets.empty());
}

TEST(Minimal, KeepsRulesAndProperty) {
  for (const Example& example : examples()) {
    if (example.name == "lossy" || example.name == "storm") continue;
    const props::Counterexample less = minimal(example.counterexample);
    const model::WirelessProfile& before = example.counterexample.scenario.wireless;
    for (const model::PacketDelay& delay : less.scenario.wireless.packet_delays) {
      EXPECT_EQ(std::ranges::count(before.packet_delays, delay), 1) << example.name;
    }
    EXPECT_EQ(less.property, example.counterexample.property);
    EXPECT_EQ(less.scenario.dds, example.counterexample.scenario.dds) << example.name;
    EXPECT_LE(less.event, example.counterexample.event) << example.name;
    expect_minimal(less);
  }
}

TEST(Minimal, NobodyWhoWantsNoMoreWaits) {
  const props::Counterexample same = minimal(delayed(), [] { return false; });
  EXPECT_EQ(same.scenario, delayed().scenario);
}

/// Those of all engines: of the timelines, the explorer and runs.
TEST(Minimal, IsWhatAChecksCounterexamplesAre) {
  smt::Claims claims{{.second_solver = false}};
  std::size_t found = 0;
  for (const char* name : {"smallest", "wired-5x20-fastdds"}) {
    const Scenario scenario = scenario_named(name);
    const checker::CheckReport report =
        checker::check({"storm.single-copy", "storm.free-threshold", "live.quiescence",
                        "storm.join-cost", "timer.suppression-honoured", "storm.piggyback-rate"},
                       {scenario, claims, nullptr, 0, 12, {}});
    for (const checker::PropertyResult& result : report.results) {
      if (result.counterexample() == nullptr) continue;
      ++found;
      expect_minimal(*result.counterexample());
    }
  }
  EXPECT_GE(found, 4U);
}

}  // namespace minimal_test
}  // namespace stormproof::counterexample
