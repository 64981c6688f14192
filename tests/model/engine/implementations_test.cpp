// What model/implementations.hpp says of each implementation is what its runs do.
#include "model/implementations.hpp"

#include <set>
#include <string_view>

#include <gtest/gtest.h>

#include "model/composition_of.hpp"
#include "model/cyclone/protocol.hpp"
#include "model/engine/network.hpp"
#include "model/engine/run_state.hpp"
#include "model/fastdds/protocol.hpp"
#include "model/fastdds/server_protocol.hpp"
#include "model/packet_sizes.hpp"
#include "model/paper/amended_protocol.hpp"
#include "model/paper/protocol.hpp"
#include "model/reference.hpp"
#include "model/simulator.hpp"
#include "tests/oracle/random_scenario.hpp"

namespace stormproof::model {
namespace implementations_test {

class Implementations : public testing::TestWithParam<ImplementationKind> {
 protected:
  static const ImplementationTraits& traits() { return traits_of(GetParam()); }
  /// Two participants on one host and one on another, with user endpoints on a topic of both.
  static Scenario three() {
    Scenario scenario;
    scenario.dds.implementation = GetParam();
    for (const std::uint32_t host : {0U, 0U, 1U}) {
      scenario.deployment.participants.push_back({HostId{host}, 1, 1, {}, Nanoseconds{50'000'000}});
    }
    scenario.time_limit = Nanoseconds{10'000'000'000};
    scenario.run_until = RunUntil::time_limit;
    return scenario;
  }
};

template <class Protocol>
bool has_separate_receptions(const Scenario& scenario) {
  RunState run{scenario, nullptr, nullptr, same_host_pairs(scenario.dds)};
  Network network{run};
  return Protocol{run, network}.receives_separately();
}
bool receives_separately(Of<comp::paper::Paper>, const Scenario& scenario) {
  return has_separate_receptions<paper::Protocol>(scenario);
}
bool receives_separately(Of<comp::amended::Amended>, Scenario scenario) {
  scenario.dds.amendments.emplace();
  return has_separate_receptions<paper::AmendedProtocol>(scenario);
}
bool receives_separately(Of<comp::fastdds::FastDds>, const Scenario& scenario) {
  return has_separate_receptions<fastdds::Protocol>(scenario);
}
bool receives_separately(Of<comp::server::FastDdsServer>, const Scenario& scenario) {
  return has_separate_receptions<fastdds::ServerProtocol>(scenario);
}
bool receives_separately(Of<comp::cyclone::Cyclone>, const Scenario& scenario) {
  return has_separate_receptions<cyclone::Protocol>(scenario);
}

TEST_P(Implementations, HaveTheNamesOfTheirCompositions) {
  EXPECT_EQ(composition_of(GetParam()).name, traits().name);
  const auto name_of_visited = []<class Composition>(Of<Composition>) { return Composition::name; };
  EXPECT_EQ(visit_composition(GetParam(), name_of_visited), traits().name);
}

TEST(AmendedPaper, IsAKindOfItsOwnThatNoEngineKnows) {
  DdsProfile dds;
  EXPECT_EQ(kind_of(dds), ImplementationKind::paper);
  dds.amendments.emplace();
  EXPECT_EQ(kind_of(dds), ImplementationKind::paper_amended);
  EXPECT_EQ(implementation_of(kind_of(dds)), ImplementationKind::paper);
  EXPECT_EQ(composition_of(dds).name, "paper-amended");
  EXPECT_FALSE(traits_of(dds).is_known_to_engines);
}

TEST_P(Implementations, LeaveRulesToTheProfileOrNot) {
  DdsProfile dds;
  dds.implementation = GetParam();
  const RelationRules before = rules_of(dds);
  dds.sedp.relation_opening = before.relation_opening == RelationOpening::receiver
                                  ? RelationOpening::each_side
                                  : RelationOpening::receiver;
  dds.sedp.unmatched = Unmatched::accept;
  dds.sedp.initial_acknack = InitialAckNackReply::none;
  dds.sedp.heartbeat_timer = HeartbeatTimerKind::additive;
  const RelationRules after = rules_of(dds);
  const bool fixed = traits().fixed_rules.has_value();
  EXPECT_EQ(after.relation_opening == before.relation_opening, fixed);
  EXPECT_EQ(after.unmatched == before.unmatched, fixed);
  EXPECT_EQ(after.initial_acknack == before.initial_acknack, fixed);
  EXPECT_EQ(after.heartbeat_timer == before.heartbeat_timer, fixed);
}

TEST_P(Implementations, HaveWhatScenariosCanSayOfThem) {
  Scenario scenario = three();
  EXPECT_EQ(open_loop_airtime(scenario).has_value(), traits().has_open_loop);
  scenario.dds.spdp.resend = SpdpResend::all_known;
  const Counts to_all = failure_free_reference(scenario);
  scenario.dds.spdp.resend = SpdpResend::new_only;
  EXPECT_EQ(failure_free_reference(scenario) == to_all, traits().answers_newcomers);
  scenario.deployment.life.emplace();
  EXPECT_EQ(&composition_of(scenario) != &composition_of(scenario.dds),
            traits().has_living_composition);
  scenario.dds.amendments.emplace();
  EXPECT_EQ(kind_of(scenario.dds) != GetParam(), traits().can_be_amended);
}

TEST_P(Implementations, ReceiveAsTheirHostsDo) {
  const Scenario scenario = three();
  const bool found = visit_composition(
      scenario.dds, [&](auto composition) { return receives_separately(composition, scenario); });
  EXPECT_EQ(found, traits().receives_separately);
}

/// What the packets of a run show.
struct Seen : Probe {
  void run_started(const Topology& topology) override { pairs = topology.pair_count(); }
  void event_started(const Event& event) override {
    creations += event.kind == EventKind::endpoint_creation ? 1U : 0U;
    threads += event.kind == EventKind::thread_run ? 1U : 0U;
  }
  void looped_back(const Packet&, std::uint32_t) override { ++loops; }
  void emitted(const Packet& packet, std::uint32_t, std::span<const std::uint32_t>) override {
    if (packet.kind == PacketKind::acknack && packet.detail > 0) ++bases;
    if (packet.submessages == nullptr) return;
    for (const Submessage& m : *packet.submessages) {
      if (m.kind == Submessage::Kind::acknack && m.sample > 0) ++bases;
    }
  }

  std::uint32_t pairs = 0;
  std::uint64_t creations = 0;
  std::uint64_t threads = 0;
  std::uint64_t loops = 0;
  std::uint64_t bases = 0;
};

TEST_P(Implementations, RunAsTheyAreSaidTo) {
  const Scenario scenario = three();
  Seen seen;
  RunOptions options;
  options.probe = &seen;
  const RunResult result = simulate(scenario, options);
  EXPECT_TRUE(result.completed());
  EXPECT_EQ(seen.creations > 0, traits().creates_endpoints_over_time);
  EXPECT_EQ(seen.threads > 0, traits().has_event_thread);
  EXPECT_EQ(seen.pairs, traits().discovers_same_host ? 6U : 4U);
  EXPECT_EQ(topology_of(scenario).pair_count(), seen.pairs);
  EXPECT_EQ(seen.loops > 0, traits().discovers_same_host);
  EXPECT_EQ(result.user_control > 0, traits().has_control_relations);
  EXPECT_EQ(seen.bases > 0, traits().acknacks_have_bases);
}

/// Holds every packet against the sizes.
struct Weighed : Probe {
  explicit Weighed(const DdsProfile& dds) : sizes{packet_sizes(dds)} {}
  void emitted(const Packet& packet, std::uint32_t, std::span<const std::uint32_t>) override {
    const std::int64_t payload = packet.payload_bytes;
    if (packet.kind == PacketKind::spdp_multicast || packet.kind == PacketKind::spdp_unicast) {
      ++announcements;
      EXPECT_EQ(payload, sizes.announcement);
    } else if (packet.kind == PacketKind::data) {
      ++data;
      std::int64_t sum = sizes.header + packet.heartbeats * sizes.heartbeat_in_data;
      packet.descriptors.for_each(
          [&](std::uint32_t d) { sum += sizes.descriptor(packet.stream, d); });
      EXPECT_TRUE(payload == sum || payload == sum + sizes.destination) << payload << ", " << sum;
    } else if (packet.kind == PacketKind::heartbeat && packet.copies == 1) {
      ++heartbeats;
      EXPECT_LE(payload, sizes.heartbeat);
    } else if (packet.kind == PacketKind::rtps_message && packet.submessages->size() == 1) {
      weigh(packet.submessages->front(), payload);
    }
  }
  void weigh(const Submessage& m, std::int64_t payload) {
    const auto is = [&](std::int64_t sum) {
      return payload == sum || payload == sum + sizes.destination;
    };
    if (m.kind == Submessage::Kind::spdp) {
      ++announcements;
      EXPECT_TRUE(is(sizes.announcement)) << payload;
    } else if (m.kind == Submessage::Kind::data && m.writer <= cyclone::writer::subscriptions) {
      ++data;
      const Stream stream = m.writer == cyclone::writer::publications ? Stream::pub : Stream::sub;
      EXPECT_TRUE(is(sizes.header + sizes.descriptor(stream, m.sample))) << payload;
    } else if (m.kind == Submessage::Kind::heartbeat) {
      ++heartbeats;
      EXPECT_LE(payload, sizes.heartbeat);
    }
  }

  PacketSizes sizes;
  std::uint64_t announcements = 0;
  std::uint64_t data = 0;
  std::uint64_t heartbeats = 0;
};

TEST_P(Implementations, SendPacketsOfTheirSizes) {
  Weighed weighed{{}};
  RunOptions options;
  options.probe = &weighed;
  options.max_events = 20'000;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Scenario scenario = oracle::random_scenario(seed, GetParam());
    weighed.sizes = packet_sizes(scenario.dds);
    (void)simulate(scenario, options);
  }
  EXPECT_GT(weighed.announcements, 100U);
  EXPECT_GT(weighed.data, 100U);
  EXPECT_GT(weighed.heartbeats, 100U);
}

INSTANTIATE_TEST_SUITE_P(All, Implementations, testing::ValuesIn(implementations),
                         [](const auto& test) { return std::string{traits_of(test.param).name}; });

TEST(Implementations, HaveDifferentNames) {
  std::set<std::string_view> names;
  for (const ImplementationTraits& one : implementation_traits) names.insert(one.name);
  EXPECT_EQ(names.size(), implementations.size());
  EXPECT_EQ(traits_of(default_implementation).name, "paper");
}

}  // namespace implementations_test
}  // namespace stormproof::model
