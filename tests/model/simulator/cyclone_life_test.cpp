// Cyclone DDS whose participants have a life, against the table of test vectors: when discovery was
// complete for the last time, and what had been sent by then.
#include <gtest/gtest.h>

#include "model/life.hpp"
#include "model/simulator.hpp"
#include "tests/vectors/cyclone_life_vectors.hpp"

namespace stormproof {
namespace cyclone_life_test {

std::optional<std::int64_t> ns(const std::optional<model::Nanoseconds>& time) {
  if (!time) return {};
  return time->count();
}

vectors::LifeExpected outcome(const model::RunResult& result) {
  const model::SentUntil& sent = result.until_discovery.value();
  const auto number = [](std::uint64_t value) { return static_cast<std::int64_t>(value); };
  vectors::LifeExpected actual{ns(result.discovery_time),
                               ns(result.recovery_time),
                               number(sent.forgotten),
                               number(sent.counts.initial_data),
                               number(sent.counts.repair_data),
                               number(sent.counts.heartbeat),
                               number(sent.counts.acknack),
                               number(sent.counts.gap),
                               number(sent.counts.spdp_multicast),
                               number(sent.counts.spdp_unicast),
                               number(sent.user_control)};
  if (result.discovery_time) actual.since_last_failure = number(sent.since_last_failure);
  return actual;
}

void PrintTo(const vectors::LifeExpected& e, std::ostream* out) {
  *out << "t " << e.t_disc_ns.value_or(-1) << " recovery " << e.recovery_ns.value_or(-1)
       << " forgotten " << e.forgotten << " initial " << e.initial_data << " repair "
       << e.repair_data << " heartbeat " << e.heartbeat << " acknack " << e.acknack << " gap "
       << e.gap << " spdp " << e.spdp_multicast << " + " << e.spdp_unicast << " user_control "
       << e.user_control << " since " << e.since_last_failure.value_or(-1);
}

class CycloneLife : public testing::TestWithParam<vectors::LifeVector> {};

TEST_P(CycloneLife, AgreesExactly) {
  const vectors::LifeExpected actual = outcome(model::simulate(GetParam().scenario));
  EXPECT_TRUE(actual == GetParam().expected)
      << "is       " << testing::PrintToString(actual) << "\nexpected "
      << testing::PrintToString(GetParam().expected);
}

const auto name = [](const auto& tested) { return tested.param.name; };
INSTANTIATE_TEST_SUITE_P(Vectors, CycloneLife, testing::ValuesIn(vectors::cyclone_life_vectors()),
                         name);

// Without delays, so that one can do it by hand (specs/guide/cyclone-life.md).

constexpr std::int64_t ms = 1'000'000;

model::Scenario without_delays(model::Scenario scenario) {
  scenario.wireless = {};
  scenario.wireless.kind = model::ServiceKind::constant_delay;
  scenario.wireless.one_way = model::Nanoseconds{0};
  scenario.deployment.loopback_delay = model::Nanoseconds{0};
  scenario.deployment.send_time = model::Nanoseconds{0};
  return scenario;
}
model::Scenario cut(model::Scenario scenario, std::int64_t start_s, std::int64_t end_s) {
  scenario.deployment.life->outages.push_back({0, 0, model::Nanoseconds{start_s * 1'000 * ms},
                                               model::Nanoseconds{end_s * 1'000 * ms},
                                               model::Reach::all, model::Reach::all});
  return scenario;
}
model::Scenario peers_of_11() {
  model::Scenario scenario = without_delays(vectors::pruning(vectors::two_peers(100)));
  scenario.deployment.participants[1].start = model::Nanoseconds{19 * ms};
  scenario.deployment.participants[1].endpoints_done = model::Nanoseconds{24 * ms};
  return scenario;
}
std::optional<std::int64_t> complete_at_ms(const model::Scenario& scenario) {
  const auto time = model::simulate(scenario).discovery_time;
  if (!time) return {};
  return time->count() / ms;
}

TEST(CycloneLifeByHand, AnOutageEndsWithTheNextAnnouncement) {
  const auto two = without_delays(vectors::two_lives(model::AllowMulticast::always));
  // Forgotten at 18.108 and 18.208; the announcement of 32.1 is a first one, HEARTBEATs 1 ms later.
  EXPECT_EQ(complete_at_ms(cut(two, 12, 27)), 32'101);
  // From 17.8 to 18.6 nobody sends a HEARTBEAT, so leases end after the outage has.
  EXPECT_EQ(complete_at_ms(cut(two, 12, 18)), 24'101);
  EXPECT_EQ(ns(model::simulate(cut(two, 12, 14)).recovery_time), 0);
}

TEST(CycloneLifeByHand, ALateEndpointWaitsForTheNextHeartbeat) {
  auto two = without_delays(vectors::two_lives(model::AllowMulticast::always));
  two.deployment.life->endpoints.push_back({0, 1, 0, model::Nanoseconds{13'000 * ms}});
  EXPECT_EQ(complete_at_ms(cut(two, 12, 17)), 18'100);
}

/// Its topic has no writer anywhere.
TEST(CycloneLifeByHand, ASubscriptionThatNobodyPublishesForIsDeleted) {
  auto two = without_delays(vectors::two_lives(model::AllowMulticast::always));
  for (model::Participant& one : two.deployment.participants) one.publications = 0;
  two.deployment.participants[0].subscriptions = 5;
  two.deployment.life->deletions.push_back(
      {.participant = 0, .subscription = 4, .at = model::Nanoseconds{13'000 * ms}});
  EXPECT_EQ(complete_at_ms(two), 13'000);
}

TEST(CycloneLifeByHand, ElevenWithoutMulticastForgetsAddresses) {
  EXPECT_EQ(complete_at_ms(cut(peers_of_11(), 12, 37)), 48'101);
  EXPECT_EQ(complete_at_ms(cut(peers_of_11(), 12, 57)), std::nullopt);
}

TEST(CycloneLifeByHand, AnIntervalOrALongerDelayCuresThat) {
  auto hasty = cut(peers_of_11(), 12, 57);
  hasty.dds.spdp.period = model::Nanoseconds{5'000 * ms};
  EXPECT_EQ(complete_at_ms(hasty), 60'101);
  auto patient = cut(peers_of_11(), 12, 67);
  patient.dds.spdp.initial_prune_delay = model::Nanoseconds{1'000'000 * 1'000 * ms};
  patient.dds.spdp.discovered_prune_delay = patient.dds.spdp.initial_prune_delay;
  EXPECT_EQ(complete_at_ms(patient), 78'101);
  auto ten = cut(peers_of_11(), 12, 57);
  ten.dds.spdp.initial_prune_delay.reset();
  ten.dds.spdp.discovered_prune_delay.reset();
  EXPECT_EQ(complete_at_ms(ten), 64'101);  // 0.10 drops no address
}

}  // namespace cyclone_life_test
}  // namespace stormproof
