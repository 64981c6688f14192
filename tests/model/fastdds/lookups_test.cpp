// Lookups of types where no vector tells what happens: what a closed reader drops, in which order
// an answer lets descriptors go, what rides in a message that takes no more, and which types there
// are.
#include "model/fastdds/lookups.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "model/fastdds/protocol.hpp"
#include "tests/model/fastdds/one_writer.hpp"
#include "tests/model/run_log.hpp"

namespace stormproof::model::fastdds {
namespace lookups_test {

Scenario with_types(Scenario scenario, std::uint32_t unknown) {
  scenario.dds.version.type_lookup = Whether::yes;
  scenario.deployment.types = EndpointTypes{unknown};
  return scenario;
}

/// Of the pair (1, 0): liveliness, two topics, and then these.
constexpr std::uint32_t questions_of_1 = 8;

/// Packets are handed to participant 0, which has all its endpoints.
class Asked : public testing::Test, private Probe {
 protected:
  Asked()
      : run_{scenario_, this, nullptr, SameHostPairs::included},
        network_{run_},
        protocol_{run_, network_} {
    network_.attach(protocol_);
    for (std::uint32_t k = 0; k < 17; ++k) handle(EventKind::endpoint_creation, 0, k);
  }

  void recognise() {
    Packet announcement;
    announcement.kind = PacketKind::spdp_multicast;
    announcement.pair = 1;
    protocol_.received(announcement, 0);
  }
  void handle(EventKind kind, std::uint32_t subject, std::uint32_t detail = 0) {
    Event event;
    event.kind = kind;
    event.subject = subject;
    event.detail = detail;
    protocol_.handle(event);
  }
  void receive(PacketKind kind, std::uint32_t samples, std::uint32_t last) {
    Packet packet;
    packet.kind = kind;
    packet.pair = run_.topology.pair_between(1, 0);
    packet.detail = questions_of_1;
    packet.set_samples(samples, last);
    protocol_.received(packet, 0);
  }
  /// What 0 acknowledges when its answer is due.
  std::uint32_t acknowledged() {
    acknowledged_ = UINT32_MAX;
    handle(EventKind::control_reply_due, questions_of_1);
    return acknowledged_;
  }

  void emitted(const Packet& packet, std::uint32_t, std::span<const std::uint32_t>) override {
    if (packet.kind != PacketKind::user_acknack || packet.detail != questions_of_1) return;
    acknowledged_ = packet.last_sample();
  }

  Scenario scenario_ = with_types(one_writer(), 1);
  RunState run_;
  Network network_;
  Protocol protocol_;
  std::uint32_t acknowledged_ = UINT32_MAX;
};

TEST_F(Asked, WhatAClosedReaderDropsIsGotWithTheNextHeartbeat) {
  receive(PacketKind::lookup, 1, 1);  // nobody takes it, nor looks at it
  recognise();
  receive(PacketKind::user_heartbeat, 0, 0);
  EXPECT_EQ(acknowledged(), 0U);
  receive(PacketKind::user_heartbeat, 0, 1);
  EXPECT_EQ(acknowledged(), 1U);
  receive(PacketKind::user_heartbeat, 0, 0);  // an old one
  EXPECT_EQ(acknowledged(), 1U);
}

/// Participant 1 creates its only user endpoints after it has asked for their types, and before it
/// has the answer.
Scenario late_user_endpoints() {
  Scenario scenario = with_types(one_writer(), 0);
  scenario.deployment = Deployment::homogeneous(2, 1, 2);
  scenario.deployment.types = EndpointTypes{0};
  scenario.deployment.participants[1].endpoints_done = Nanoseconds{8 * ms};
  scenario.time_limit = Nanoseconds{20 * ms};
  return scenario;
}

TEST(FastddsLookups, PublicationsAreNotifiedBeforeSubscriptions) {
  const RunLog log = run_and_log(late_user_endpoints());
  // User topic 0 of the pairs (0, 1) and (1, 0).
  const auto place_of = [&](std::string_view opened) {
    const auto found = std::ranges::find_if(
        log.transitions, [&](const std::string& move) { return move.starts_with(opened); });
    EXPECT_NE(found, log.transitions.end()) << opened;
    return found - log.transitions.begin();
  };
  EXPECT_LT(place_of("ControlReader 3: Closed"), place_of("ControlWriter 9: Closed"));
}

/// Its HEARTBEAT opens the message that the next sample joins.
TEST(FastddsLookups, AMessageThatTakesNoMoreGoesBeforeItsHeartbeat) {
  Scenario scenario = late_user_endpoints();
  scenario.dds.version.max_data_per_message = 1;
  scenario.dds.sedp.piggyback = Piggyback::cumulative;
  scenario.dds.sedp.piggyback_threshold_bytes = Bytes{0};
  const RunLog log = run_and_log(scenario);
  const auto first = std::ranges::find(log.sent, PacketKind::lookup, &Sent::kind);
  ASSERT_NE(first, log.sent.end());
  EXPECT_EQ(first->payload_bytes, 20 + 16 + 12 + 156);
  const auto next = std::next(first);
  ASSERT_NE(next, log.sent.end());
  EXPECT_EQ(next->kind, PacketKind::lookup);
  EXPECT_EQ(next->time_ns, first->time_ns);
  EXPECT_EQ(next->payload_bytes, 20 + 16 + 32 + 12 + 156);
}

TEST(FastddsLookups, AChainHasFourSamples) {
  const RunLog log = run_and_log(late_user_endpoints());
  std::vector<std::int64_t> bytes;
  for (const Sent& sent : log.sent) {
    if (sent.kind == PacketKind::lookup) bytes.push_back(sent.payload_bytes);
  }
  // One chain for each type that 1 lacks; those of one instant share a message.
  ASSERT_GE(bytes.size(), 4U);
  const std::int64_t chains = (bytes.front() - 36) / (12 + 156);
  EXPECT_EQ(bytes.front(), 36 + chains * (12 + 156));
  EXPECT_GT(log.result.counts.lookup, 0U);
  EXPECT_EQ(log.result.counts.lookup % 4, 0U);
}

TEST(FastddsLookups, TypesAreCommonButForTheFirstOnesOfTheList) {
  Deployment deployment = Deployment::homogeneous(2, 1, 5);
  deployment.types = EndpointTypes{13};  // all of services, and the first user publication
  const Types types{deployment};
  EXPECT_EQ(types.of(0, Stream::pub, 0), types.of(1, Stream::sub, 0));
  EXPECT_EQ(types.of(0, Stream::pub, 8), types.of(1, Stream::sub, 7));
  EXPECT_EQ(types.of(0, Stream::pub, 1), types.of(1, Stream::pub, 1));
  EXPECT_NE(types.of(0, Stream::pub, 0), types.of(0, Stream::pub, 1));
  EXPECT_EQ(types.of(0, Stream::pub, 10), types.of(1, Stream::sub, 8));
  std::set<std::uint32_t> own;
  for (const std::uint32_t i : {0U, 1U}) {
    for (std::uint32_t k = 0; k < 6; ++k) {
      own.insert(types.of(i, Stream::sub, 1 + k));
      own.insert(types.of(i, Stream::pub, 2 + k));
    }
    own.insert(types.of(i, Stream::pub, 9));
  }
  EXPECT_EQ(own.size(), 2 * 13U);
  EXPECT_FALSE(own.contains(types.of(0, Stream::pub, 10)));
  EXPECT_FALSE(own.contains(types.of(0, Stream::pub, 0)));
}

/// Two hosts with two participants each that begin at once, know each other before they ask, and
/// have `unknown` types each that the others lack.
Scenario all_at_once(std::uint32_t unknown) {
  Scenario scenario = one_writer();
  scenario.deployment = Deployment::homogeneous(2, 2, 3);
  scenario.dds.version.type_lookup = Whether::yes;
  scenario.deployment.types = EndpointTypes{unknown};
  scenario.time_limit = Nanoseconds{2'000 * ms};
  scenario.run_until = RunUntil::time_limit;
  return scenario;
}
std::uint64_t lookups(Scenario scenario, LookupFilter filter, LookupUnit unit) {
  scenario.dds.version.typelookup_filter = filter;
  scenario.dds.version.typelookup_unit = unit;
  const RunResult result = simulate(scenario);
  EXPECT_TRUE(result.completed());
  return result.counts.lookup;
}

/// Of N participants, N_P of each host, with U such types.
TEST(FastddsLookups, AFilterSendsASampleToWhomItIsFor) {
  constexpr std::uint64_t n = 4;
  constexpr std::uint64_t n_p = 2;
  for (const std::uint32_t u : {1U, 3U}) {
    const std::uint64_t questions_to_all = 2 * n * (n - 1) * u * n_p;
    const std::uint64_t answers_across = 2 * u * 2 * n_p * n_p;
    constexpr LookupUnit each = LookupUnit::type_and_stream;
    EXPECT_EQ(lookups(all_at_once(u), LookupFilter::none, each), 2 * questions_to_all);
    EXPECT_EQ(lookups(all_at_once(u), LookupFilter::answers, each),
              questions_to_all + answers_across);
    EXPECT_EQ(lookups(all_at_once(u), LookupFilter::all, each), 2 * answers_across);
  }
}

/// Publications and subscriptions come apart, so there are up to two questions for a participant:
/// the second one waits until the first is answered.
TEST(FastddsLookups, OneQuestionIsForAllTypesThatWait) {
  constexpr LookupUnit all = LookupUnit::participant;
  const std::uint64_t one_chain = lookups(all_at_once(1), LookupFilter::none, all);
  EXPECT_EQ(one_chain, 4 * 4 * 3 * 2U);
  for (const std::uint32_t u : {2U, 12U}) {
    const std::uint64_t asked = lookups(all_at_once(u), LookupFilter::none, all);
    EXPECT_GE(asked, one_chain) << u;
    EXPECT_LE(asked, 2 * one_chain) << u;
  }
}

/// One participant asks once the other has announced all of its endpoints.
TEST(FastddsLookups, AQuestionForSeveralTypesIsLarger) {
  Scenario scenario = late_user_endpoints();
  scenario.deployment.types = EndpointTypes{11};  // sub1 to sub6, pub2 to pub6
  scenario.dds.version.typelookup_unit = LookupUnit::participant;
  scenario.time_limit = Nanoseconds{200 * ms};
  const RunLog log = run_and_log(scenario);
  std::vector<std::int64_t> bytes;
  for (const Sent& sent : log.sent) {
    if (sent.kind == PacketKind::lookup) bytes.push_back(sent.payload_bytes);
  }
  const auto sent = [&](std::int64_t size) {
    return std::ranges::find(bytes, size) != bytes.end();
  };
  EXPECT_TRUE(sent(20 + 16 + 12 + 156 + 16 * 5)) << testing::PrintToString(bytes);
  EXPECT_TRUE(sent(20 + 16 + 12 + 148 + 16 * 5)) << testing::PrintToString(bytes);
  EXPECT_TRUE(sent(20 + 16 + 12 + 300 + 204 * 5)) << testing::PrintToString(bytes);
}

TEST(FastddsLookups, ATypeOfBothStreamsIsAskedForOnceIfThatIsTheUnit) {
  Scenario scenario = late_user_endpoints();
  scenario.time_limit = Nanoseconds{200 * ms};
  scenario.run_until = RunUntil::time_limit;
  const std::uint64_t of_streams =
      lookups(scenario, LookupFilter::none, LookupUnit::type_and_stream);
  const std::uint64_t of_types = lookups(scenario, LookupFilter::none, LookupUnit::type);
  EXPECT_EQ(of_streams - of_types, 2 * 4U);  // parameter_events and user topics
}

TEST(FastddsLookups, SwitchedOffEveryTypeIsKnown) {
  Scenario scenario = late_user_endpoints();
  scenario.dds.version.type_lookup = Whether::no;
  scenario.deployment.types = EndpointTypes{12};
  const RunResult result = simulate(scenario);
  EXPECT_EQ(result.counts.lookup, 0U);
  EXPECT_TRUE(result.completed());
}

TEST(FastddsLookups, WhatWaitsForItsTypeIsMissing) {
  Scenario scenario = with_types(late_user_endpoints(), 1);
  scenario.time_limit = Nanoseconds{6 * ms};  // everything has arrived at 1, no answer has
  const RunResult result = simulate(scenario);
  EXPECT_FALSE(result.completed());
  const auto is_at_1 = [](const MissingDescriptor& missing) {
    return missing.destination.value == 1 && missing.stream == Stream::sub &&
           missing.descriptor.value == 1;
  };
  EXPECT_TRUE(std::ranges::any_of(result.missing, is_at_1));
}

}  // namespace lookups_test
}  // namespace stormproof::model::fastdds
