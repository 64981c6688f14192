// The rules of `implementation: fastdds` that no test vector pins down, each on a world of its own:
// the oracle has to be right about them as well, and the comparison on random scenarios says only
// that two simulators agree.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {
namespace fastdds_rules_test {

using State = DescriptorState;

model::Scenario two_participants() {
  model::Scenario scenario;
  scenario.deployment = model::Deployment::homogeneous(2, 1, 2);
  scenario.dds.implementation = model::ImplementationKind::fastdds;
  return scenario;
}

std::int64_t pending(const World& w, EventKind kind) {
  return std::count_if(w.queue.begin(), w.queue.end(),
                       [&](const auto& entry) { return entry.second.kind == kind; });
}

// A world in which participant 0 has `existing` publications, matched with participant 1.
class FastddsRules : public testing::Test {
 protected:
  void match(Id existing) {
    for (Id d = 0; d < existing; ++d) create(w_, 0, pub, d);
    open_writer(w_, 0, 1, pub);
    relation(w_, 0, 1, pub).reader_open = true;
  }

  static Packet acknack(Id base, const std::set<Id>& bitmap) {
    Packet packet;
    packet.kind = PacketKind::acknack;
    packet.source = 1;
    packet.destination = 0;
    packet.stream = pub;
    packet.base = base;
    packet.bitmap = bitmap;
    return packet;
  }

  Relation& forward() { return relation(w_, 0, 1, pub); }

  model::Scenario scenario_ = two_participants();
  World w_{scenario_};
};

TEST_F(FastddsRules, InitialAcknackStartsOver) {
  match(4);
  forward().state = {State::queued, State::acknowledged, State::suppressed, State::acknowledged};
  forward().low = 2;
  writer(w_, 0, pub).expiry_pending = false;
  writer(w_, 0, pub).budget = 1;
  const std::int64_t heartbeats = w_.outcome.heartbeat;
  Packet packet = acknack(0, {});
  packet.initial = true;
  receive(w_, packet, 0);
  const std::vector<State> expected{State::unsent, State::unsent, State::suppressed, State::unsent};
  EXPECT_EQ(forward().state, expected);
  EXPECT_EQ(forward().low, 0U);
  EXPECT_EQ(w_.outcome.heartbeat, heartbeats + 1);
  EXPECT_EQ(writer(w_, 0, pub).budget, scenario_.dds.sedp.piggyback_threshold_bytes.count());
  EXPECT_TRUE(writer(w_, 0, pub).expiry_pending);
}

TEST_F(FastddsRules, NackThatRequestsNothingNewArms) {
  match(2);
  forward().state = {State::suppressed, State::queued};
  writer(w_, 0, pub).expiry_pending = false;
  receive(w_, acknack(0, {0, 1}), 0);
  EXPECT_TRUE(writer(w_, 0, pub).expiry_pending);
  EXPECT_FALSE(writer(w_, 0, pub).response_pending);
}

TEST_F(FastddsRules, CleanAcknackDoesNotArm) {
  match(2);
  writer(w_, 0, pub).expiry_pending = false;
  receive(w_, acknack(2, {}), 0);
  EXPECT_FALSE(writer(w_, 0, pub).expiry_pending);
  EXPECT_EQ(forward().low, 2U);
}

TEST_F(FastddsRules, OneSuppressionEndPerRelation) {
  match(1);
  create(w_, 0, pub, 1);
  create(w_, 0, pub, 2);
  EXPECT_EQ(pending(w_, EventKind::suppression_end), 1);
  const std::vector<State> before{forward().state.begin(), forward().state.begin() + 3};
  EXPECT_EQ(before, (std::vector<State>{State::unsent, State::suppressed, State::suppressed}));

  writer(w_, 0, pub).expiry_pending = false;
  suppression_end(w_, 0, 1, pub);
  const std::vector<State> after{forward().state.begin(), forward().state.begin() + 3};
  EXPECT_EQ(after, (std::vector<State>(3, State::unsent)));
  EXPECT_TRUE(writer(w_, 0, pub).expiry_pending);
}

TEST_F(FastddsRules, DataRaisesWhatANackAsksFor) {
  match(0);
  Packet data;
  data.kind = PacketKind::sedp;
  data.source = 0;
  data.destination = 1;
  data.stream = pub;
  data.descriptors = {2};
  receive(w_, data, 1);
  EXPECT_EQ(forward().announced, 3U);
  EXPECT_EQ(forward().handed_over, 0U);
  generate_acknack(w_, 1, 0, pub);
  const Packet& sent = w_.packets.rbegin()->second;
  EXPECT_EQ(sent.base, 0U);
  EXPECT_EQ(sent.bitmap, (std::set<Id>{0, 1}));
  EXPECT_EQ(sent.payload, 68);
}

TEST_F(FastddsRules, ClosedReaderDropsData) {
  match(0);
  forward().reader_open = false;
  Packet data;
  data.kind = PacketKind::sedp;
  data.source = 0;
  data.destination = 1;
  data.descriptors = {0};
  data.announced = 1;
  receive(w_, data, 1);
  EXPECT_FALSE(forward().received.at(0));
  EXPECT_FALSE(forward().heartbeat_seen);
  EXPECT_EQ(pending(w_, EventKind::acknack_generation), 0);
}

}  // namespace fastdds_rules_test
}  // namespace stormproof::oracle::fastdds
