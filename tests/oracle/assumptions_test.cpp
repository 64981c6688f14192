// Whoever takes a proof at its word looks at its printed assumptions, and at nothing else. So runs
// are drawn in which all of them are true, and anything else that the generators have: whatever is
// proved of a scenario holds in them, by the monitors of the simulator, and the naive simulators
// run event by event alike. STORMPROOF_ASSUMPTION_RUNS=N draws N runs of each proof, and as many
// more random scenarios to prove something of.
#include <array>
#include <cstdlib>
#include <iostream>
#include <map>
#include <span>

#include <gtest/gtest.h>

#include "checker/engines/bounds/resting.hpp"
#include "checker/engines/calculus/calculus.hpp"
#include "checker/engines/smt/claims.hpp"
#include "checker/engines/tables/tables.hpp"
#include "checker/engines/timeline/timeline.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/scenario_file.hpp"
#include "model/simulator.hpp"
#include "model/trace/replay.hpp"
#include "props/applicability.hpp"
#include "props/generators/draw.hpp"
#include "props/monitor.hpp"
#include "tests/oracle/admitted.hpp"
#include "tests/oracle/comparison.hpp"
#include "tests/oracle/random_scenario.hpp"
#include "tests/oracle/sharp_scenario.hpp"

namespace stormproof::oracle {
namespace assumptions_test {

using model::Nanoseconds;
using model::Scenario;
using props::Dice;
using props::Engine;
using props::Finding;

std::uint64_t runs_of_each() {
  const char* const wanted = std::getenv("STORMPROOF_ASSUMPTION_RUNS");
  return wanted == nullptr ? 25 : std::strtoull(wanted, nullptr, 10);
}

struct Proof {
  std::string_view property;
  Finding finding;
};

/// What engines prove of the scenario and a run can show.
std::vector<Proof> proofs_of(const Scenario& scenario, checker::FoundOfRules& shared) {
  smt::Claims claims{{.second_solver = false}};
  const checker::CheckRequest request{
      .scenario = scenario, .claims = claims, .on_progress = {}, .of_rules = &shared};
  std::vector<Proof> list;
  using Check =
      checker::Findings (*)(std::span<const std::string_view>, const checker::CheckRequest&);
  constexpr std::array<std::pair<Engine, Check>, 3> engines{{{Engine::tables, tables::check},
                                                             {Engine::timelines, timeline::check},
                                                             {Engine::calculus, calculus::check}}};
  for (const auto& [engine, check] : engines) {
    std::vector<std::string_view> ids;
    for (const std::string_view id : props::monitored_properties(scenario)) {
      if (!id.starts_with("composition.") &&
          props::applicability_of(id, scenario).is_decided_by(engine)) {
        ids.push_back(id);
      }
    }
    for (auto& [id, finding] : check(ids, request)) {
      if (finding.kind == props::VerdictKind::proved) list.push_back({id, std::move(finding)});
    }
  }
  return list;
}

/// Starts and creations of endpoints at any times, ties among them.
void draw_times(Dice& dice, Scenario& scenario) {
  scenario.deployment.schedule.reset();
  Nanoseconds latest{0};
  for (model::Participant& one : scenario.deployment.participants) {
    const Nanoseconds creation = one.endpoints_done - one.start;
    one.start = Nanoseconds{dice.among(
        {0, 0, 1, dice.between(0, 10'000'000), 70'000'000, dice.between(0, 2'000'000'000)})};
    one.endpoints_done = one.start + creation;
    latest = std::max(latest, one.endpoints_done);
  }
  scenario.run_until = model::RunUntil::time_limit;
  scenario.time_limit = latest + Nanoseconds{4'000'000'000};
}

/// Another deployment, over a network that does whatever is admitted.
void draw_surroundings(Dice& dice, const Admitted& admitted, Scenario& scenario) {
  props::draw_participants(
      dice, {.max_participants = admitted.has_pairs_only ? 2U : 4U, .max_endpoints = 3}, 100,
      scenario);
  if (model::traits_of(scenario.dds).creates_endpoints_over_time) {
    for (model::Participant& one : scenario.deployment.participants) {
      one.endpoints_done = one.start + Nanoseconds{dice.among({0, 0, 10, 300, 1'000}) * 1'000'000};
    }
  }
  const std::int64_t longest =
      admitted.longest.value_or(Nanoseconds{dice.among({1'000, 1'000'000, 200'000'000})}).count();
  const auto delay = [&] {
    return Nanoseconds{std::clamp<std::int64_t>(
        dice.among({0, 1, longest, longest, longest - 1, dice.between(0, longest)}),
        admitted.shortest.count(), longest)};
  };
  model::WirelessProfile wireless;
  wireless.kind = model::ServiceKind::constant_delay;
  wireless.one_way = delay();
  const int late = admitted.may_differ ? static_cast<int>(dice.among({0, 20, 80})) : 0;
  const int lost = admitted.may_lose ? static_cast<int>(dice.among({0, 0, 5, 20})) : 0;
  for (std::uint64_t packet = 0; packet < 120; ++packet) {
    if (dice.chance(lost)) {
      wireless.lost_packets.push_back(packet);
    } else if (dice.chance(late)) {
      const Nanoseconds one_way = delay();
      const Nanoseconds leaves{admitted.may_wait_in_source ? dice.between(0, one_way.count()) : 0};
      wireless.packet_delays.push_back({packet, leaves, one_way});
    }
  }
  scenario.wireless = wireless;
}

Scenario drawn(std::uint64_t seed, const Scenario& base, const Admitted& admitted) {
  Dice dice{seed};
  Scenario scenario = base;
  if (!admitted.is_of_deployment) draw_surroundings(dice, admitted, scenario);
  if (!admitted.may_lose) scenario.wireless.lost_packets.clear();
  draw_times(dice, scenario);
  return scenario;
}

/// What the monitor of the property says against the run; nothing if it keeps it.
std::optional<std::string> objection(std::string_view property, const Scenario& scenario) {
  const auto monitor = props::make_monitor(property, scenario);
  if (!monitor) return std::nullopt;
  model::RunOptions options;
  options.probe = monitor.get();
  options.max_events = most_compared_events;
  const model::RunResult result = model::simulate(scenario, options);
  if (result.end != model::RunEnd::interrupted) {
    monitor->finish(model::trace::known_until(result, scenario));
  }
  if (!monitor->violation()) return std::nullopt;
  return monitor->violation()->reason;
}

/// The first of the runs that break what is proved.
std::optional<std::string> search(std::string_view property, const Scenario& base,
                                  const Admitted& admitted, std::uint64_t runs) {
  for (std::uint64_t seed = 1; seed <= runs; ++seed) {
    const Scenario scenario = drawn(seed, base, admitted);
    if (!model::config::is_valid(scenario)) continue;
    if (auto found = objection(property, scenario))
      return "seed " + std::to_string(seed) + ": " + *found;
  }
  return std::nullopt;
}

Scenario pair_over(const std::string& dds, const std::vector<std::string>& overrides,
                   bool is_wireless) {
  std::vector<std::string> all{"dds=" + dds};
  if (!is_wireless) all.emplace_back("wireless={kind: constant_delay, one_way: 1ms}");
  all.insert(all.end(), overrides.begin(), overrides.end());
  const auto scenario =
      model::config::read_scenario("smallest", all, model::config::SpecPath::standard());
  EXPECT_TRUE(scenario);
  return *scenario;
}

/// The profiles of which most is proved.
std::map<std::string, Scenario> bases() {
  const std::string a = "dds.sedp.heartbeat_response_delay=";
  const std::string n = "dds.sedp.nack_response_delay=";
  return {{"the paper's, equal delays", pair_over("paper", {n + "100ms"}, false)},
          {"the paper's, patient",
           pair_over("paper", {a + "30ms", "dds.sedp.initial_acknack_delay=1s"}, true)},
          {"the paper's, silent",
           pair_over("paper", {a + "1s", "dds.sedp.initial_acknack=heartbeat"}, true)},
          {"the paper's, pull", pair_over("paper", {"dds.sedp.initial_data=pull"}, false)},
          {"Fast DDS", pair_over("fastdds-2.6.11", {}, true)},
          {"Fast DDS, patient", pair_over("fastdds-2.6.11", {a + "2100us", n + "100us"}, false)},
          {"Cyclone DDS", pair_over("cyclonedds-0.10", {}, false)},
          {"Cyclone DDS, over Wi-Fi", pair_over("cyclonedds-11", {}, true)},
          {"a Discovery Server", pair_over("fastdds-server-2.6.11", {}, false)},
          {"a Discovery Server, super clients",
           pair_over("fastdds-server-2.6.11", {"dds.discovery=super_client"}, true)}};
}

/// Scenarios of any kind: one for ten runs of each proof.
std::map<std::string, Scenario> random_bases() {
  std::map<std::string, Scenario> list;
  for (std::uint64_t seed = 1; seed <= runs_of_each() / 10; ++seed) {
    Scenario scenario = props::draw_scenario(seed, 20, {.max_participants = 3, .max_endpoints = 2});
    if (model::config::is_valid(scenario)) list["seed " + std::to_string(seed)] = scenario;
    list["Cyclone DDS, seed " + std::to_string(seed)] = varied_cyclone_scenario(seed);
    list["a Discovery Server, seed " + std::to_string(seed)] = varied_server_scenario(seed);
  }
  return list;
}

TEST(Assumptions, WhatIsProvedHoldsInAllRunsThatTheyAdmit) {
  checker::FoundOfRules shared;
  std::map<std::string_view, std::size_t> tried;
  std::map<model::ImplementationKind, std::size_t> of_kind;
  std::map<std::string, Scenario> all = bases();
  all.merge(random_bases());
  for (const auto& [name, base] : all) {
    for (const Proof& proof : proofs_of(base, shared)) {
      const Admitted admitted = admitted_by(proof.finding, base);
      for (const std::string& sentence : admitted.unknown) {
        ADD_FAILURE() << proof.property << ", " << name << ": nobody knows what is admitted by '"
                      << sentence << "'";
      }
      const auto found = search(proof.property, base, admitted, runs_of_each());
      EXPECT_FALSE(found) << proof.property << ", " << name << ", by " << proof.finding.engine
                          << ": " << found.value_or("");
      ++tried[proof.property];
      ++of_kind[model::kind_of(base.dds)];
    }
  }
  for (const model::ImplementationKind kind :
       {model::ImplementationKind::cyclone, model::ImplementationKind::fastdds_server}) {
    EXPECT_GT(of_kind[kind], 4U) << model::traits_of(kind).name;
  }
  for (const auto& [property, count] : tried) std::cout << property << ": " << count << '\n';
  for (const char* property :
       {"safety.ack-implies-received", "safety.repair-only-if-asked", "safety.snapshot",
        "timer.single-heartbeat", "live.no-stall", "live.completion", "live.quiescence",
        "storm.single-copy", "storm.free-threshold", "storm.cannot-start"}) {
    EXPECT_GT(tried[property], 0U) << property << " was proved of nothing";
  }
}

/// The runs are those of the rules, not only of the simulator.
TEST(Assumptions, NaiveSimulatorsRunAlikeInThem) {
  for (const auto& [name, base] : bases()) {
    for (std::uint64_t seed = 1; seed <= runs_of_each(); ++seed) {
      Admitted admitted;
      admitted.is_of_deployment = seed % 4 == 0;
      admitted.longest = Nanoseconds{seed % 3 == 0 ? 30'000'000 : 300'000};
      const Scenario scenario = drawn(seed, base, admitted);
      const auto found = difference(scenario);
      ASSERT_FALSE(found) << name << ", seed " << seed << ": " << *found;
    }
  }
}

/// The search would find what is assumed in silence.
TEST(Assumptions, AreMissedWhereOneIsLeftOut) {
  checker::FoundOfRules shared;
  const Scenario base = bases().at("the paper's, equal delays");
  std::size_t found = 0;
  for (Proof proof : proofs_of(base, shared)) {
    if (!proof.property.starts_with("storm.s") && !proof.property.starts_with("storm.f")) continue;
    EXPECT_FALSE(search(proof.property, base, admitted_by(proof.finding, base), 300));
    for (const char* words : {"packet takes longer than", "takes the same time"}) {
      Finding silent = proof.finding;
      std::erase_if(silent.assumptions, [&](const std::string& sentence) {
        return sentence.find(words) != std::string::npos;
      });
      EXPECT_LT(silent.assumptions.size(), proof.finding.assumptions.size()) << words;
      EXPECT_TRUE(search(proof.property, base, admitted_by(silent, base), 300)) << words;
      ++found;
    }
  }
  EXPECT_EQ(found, 4U);
}

}  // namespace assumptions_test
}  // namespace stormproof::oracle
