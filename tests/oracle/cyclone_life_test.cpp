// The oracle of Cyclone DDS with a life: against the test vectors that it knows, and the product
// against it on random scenarios with leases, outages, deaths and successors.
#include <iostream>
#include <string>

#include <gtest/gtest.h>

#include "model/simulator.hpp"
#include "props/generators/on_demand.hpp"
#include "tests/oracle/cyclone_oracle.hpp"
#include "tests/oracle/random_scenario.hpp"
#include "tests/vectors/cyclone_life_vectors.hpp"

namespace stormproof::oracle {
namespace cyclone_life_test {

using model::Nanoseconds;
using model::Scenario;

std::string text(const CycloneOutcome& o) {
  std::string text;
  for (const std::int64_t number :
       {o.completed ? o.t_disc_ns : -1, o.forgotten, o.initial_data, o.repair_data, o.heartbeat,
        o.acknack, o.spdp_multicast, o.spdp_unicast, o.user_control}) {
    text += std::to_string(number) + " ";
  }
  return text;
}

CycloneOutcome outcome_of(const model::RunResult& result) {
  const model::SentUntil& sent = result.until_discovery.value();
  const auto number = [](std::uint64_t value) { return static_cast<std::int64_t>(value); };
  CycloneOutcome o;
  o.completed = result.completed();
  o.t_disc_ns = result.discovery_time.value_or(Nanoseconds{-1}).count();
  o.forgotten = number(sent.forgotten);
  o.initial_data = number(sent.counts.initial_data);
  o.repair_data = number(sent.counts.repair_data);
  o.heartbeat = number(sent.counts.heartbeat);
  o.acknack = number(sent.counts.acknack);
  o.spdp_multicast = number(sent.counts.spdp_multicast);
  o.spdp_unicast = number(sent.counts.spdp_unicast);
  o.user_control = number(sent.user_control);
  return o;
}

/// Nobody says goodbye there, endpoints stay, and there are no peers.
bool is_known(const Scenario& scenario) {
  const model::Life& life = scenario.deployment.life.value();
  const bool says_goodbye =
      !life.leaves.empty() ||
      (!life.restarts.empty() && life.restarts.front().goodbye == model::Goodbye::yes);
  return !says_goodbye && life.deletions.empty() && life.endpoints.empty() &&
         scenario.dds.peers == 0;
}

TEST(CycloneLifeOracle, AgreesWithTheVectors) {
  std::size_t known = 0;
  for (const vectors::LifeVector& vector : vectors::cyclone_life_vectors()) {
    if (!is_known(vector.scenario) || vector.scenario.deployment.size() > 4) continue;
    ++known;
    const vectors::LifeExpected& e = vector.expected;
    CycloneOutcome expected;
    expected.completed = e.t_disc_ns.has_value();
    expected.t_disc_ns = e.t_disc_ns.value_or(-1);
    expected.forgotten = e.forgotten;
    expected.initial_data = e.initial_data;
    expected.repair_data = e.repair_data;
    expected.heartbeat = e.heartbeat;
    expected.acknack = e.acknack;
    expected.spdp_multicast = e.spdp_multicast;
    expected.spdp_unicast = e.spdp_unicast;
    expected.user_control = e.user_control;
    EXPECT_EQ(text(run_cyclone(vector.scenario)), text(expected)) << vector.name;
  }
  EXPECT_EQ(known, 8U);
}

model::Life random_life(props::Dice& dice, std::uint32_t participants) {
  constexpr std::int64_t ms = 1'000'000;
  model::Life life;
  using enum model::Reach;
  for (std::uint32_t k = dice.count(1, 2); k > 0; --k) {
    const Nanoseconds start{dice.among({0, 50, 4'000, 9'000}) * ms + dice.between(0, ms)};
    const Nanoseconds end = start + Nanoseconds{dice.among({100, 3'000, 12'000}) * ms};
    const bool both = dice.chance(60);
    life.outages.push_back({0, dice.count(0, 1), start, end, all, host});
    if (both) life.outages.push_back({life.outages.back().to, 0, start, end, host, all});
  }
  if (dice.chance(30)) life.lease = Nanoseconds{dice.among({6'000, 12'000}) * ms};
  if (dice.chance(40)) {
    life.leases.push_back(
        {dice.count(0, participants - 1), Nanoseconds{dice.among({5'000, 10'000, 14'000}) * ms}});
  }
  const std::uint32_t one = dice.count(0, participants - 1);
  const Nanoseconds stop{dice.among({700, 8'000, 11'000}) * ms + dice.between(0, ms)};
  if (dice.chance(25)) life.mute.push_back({one, stop});
  if (life.mute.empty() && dice.chance(40)) {
    life.restarts.push_back(
        {one, stop, stop + Nanoseconds{2'000 * ms}, model::Identity::fresh, model::Goodbye::no});
  }
  return life;
}

TEST(CycloneLifeOracle, AgreesWithTheProductOnRandomLives) {
  std::size_t compared = 0;
  std::size_t forgotten = 0;
  std::size_t recovered = 0;
  for (std::uint64_t seed = 0; compared < 60; ++seed) {
    Scenario scenario = random_cyclone_scenario(seed);
    const std::uint32_t count = scenario.deployment.size();
    if (count > 4 || scenario.deployment.host_count() < 2) continue;
    props::Dice dice{seed};
    scenario.deployment.life = random_life(dice, count);
    for (const model::Mute& mute : scenario.deployment.life->mute) {
      scenario.deployment.participants[mute.participant].start = {};
    }
    scenario.time_limit = Nanoseconds{36'000'000'000};
    scenario.run_until = model::RunUntil::time_limit;
    for (model::Participant& p : scenario.deployment.participants) {
      p.open.reset();
      p.ready.reset();
      p.start = Nanoseconds{p.start.count() % 300'000'000};
      p.endpoints_done = p.start + Nanoseconds{p.endpoints_done.count() % 200'000'000};
    }
    model::RunOptions options;
    options.max_events = 40'000;
    const model::RunResult product = model::simulate(scenario, options);
    if (product.end == model::RunEnd::interrupted) continue;
    ++compared;
    const CycloneOutcome oracle = run_cyclone(scenario);
    forgotten += oracle.forgotten > 0 ? 1U : 0U;
    recovered += oracle.completed && oracle.forgotten > 0 ? 1U : 0U;
    EXPECT_EQ(text(outcome_of(product)), text(oracle)) << "seed " << seed;
  }
  std::cout << forgotten << " of " << compared << " forget, " << recovered << " recover\n";
  EXPECT_GT(forgotten, 15U);
  EXPECT_GT(recovered, 8U);
}

}  // namespace cyclone_life_test
}  // namespace stormproof::oracle
