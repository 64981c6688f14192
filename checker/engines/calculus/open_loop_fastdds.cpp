// The flows of Fast DDS's rules. Which descriptors share a message depends on when they are created
// and asked for; each in a packet of its own takes at least as much airtime, so that is what
// counts. Participants of the same host are not on the channel, but what is repaired to them is: it
// is charged against the piggyback budget, and they are recognised and announced to like all
// others.
#include <algorithm>

#include "checker/engines/calculus/open_loop_parts.hpp"
#include "model/fastdds/endpoints.hpp"

namespace stormproof::calculus {

namespace {

namespace fastdds = model::fastdds;
using model::Stream;
using model::TrafficClass;

constexpr std::int64_t one_destination = fastdds::message_header_bytes + fastdds::destination_bytes;
std::int64_t largest_descriptor(const model::DdsProfile& dds) {
  return fastdds::timestamp_bytes + fastdds::largest_submessage_bytes(dds);
}
/// What one delivery adds to all that the asynchronous sender has ever sent, at most: the
/// descriptor in a message of its own, and a HEARTBEAT that opens another one.
std::int64_t largest_step(const model::DdsProfile& dds) {
  return 2 * one_destination + largest_descriptor(dds) + fastdds::heartbeat_submessage_bytes;
}
/// What a delivery is charged if it is charged with itself only.
std::int64_t largest_charge(const model::DdsProfile& dds) {
  return fastdds::message_header_bytes + largest_descriptor(dds);
}

std::int64_t alone(const model::DdsProfile& dds, Stream s, std::uint32_t d) {
  return one_destination + fastdds::timestamp_bytes + fastdds::submessage_bytes(dds, s, d);
}

class Adder {
 public:
  Adder(const model::Scenario& scenario, const Omission& omission, Flows& flows)
      : dds_{scenario.dds},
        omission_{omission},
        flows_{flows},
        to_all_{packets_to_all(scenario, omission, flows)} {}

  void add_participant(std::uint32_t i) {
    const model::Topology& topology = flows_.topology;
    const std::int64_t peers = cross_peers(topology, i);
    const std::int64_t others =
        omission_.same_host ? peers : std::int64_t{topology.participant_count()} - 1;
    flows_.add_announcements(dds_.spdp, fastdds::sizes_of(dds_).announcement, to_all_, peers,
                             others);
    std::int64_t created = 0;
    for (const Stream s : model::streams) {
      const std::uint32_t descriptors = topology.descriptor_count(i, s);
      created += descriptors;
      add_data(s, descriptors, peers);
      if (omission_.heartbeats) continue;
      add_heartbeats("HEARTBEATs of matches", "their ACKNACKs", {}, peers);
      add_heartbeats("periodic HEARTBEATs", "ACKNACKs to periodic HEARTBEATs",
                     Recurrence::every(dds_.sedp.heartbeat_period), peers);
    }
    if (dds_.sedp.initial_acknack_delay > model::Nanoseconds{0}) add_attempts(peers);
    if (omission_.piggyback) return;
    const std::int64_t exhausted = exhaustions_of_fastdds(dds_, created, times(others, created));
    flows_.traffic.exhaustions = plus(flows_.traffic.exhaustions, exhausted);
    add_heartbeats("piggyback HEARTBEATs", "ACKNACKs to piggyback HEARTBEATs", {},
                   times(exhausted, peers));
  }

  /// Liveliness, the two topics of every node, and the user topics that both sides have.
  void add_control(const model::Deployment& deployment, const model::Pair& pair) {
    if (omission_.user_control) return;
    const std::int64_t relations =
        fastdds::topic::first_user +
        std::min(deployment.participants[pair.source].publications,
                 deployment.participants[pair.destination].subscriptions);
    constexpr TrafficClass control = TrafficClass::user_control;
    flows_.add("HEARTBEATs of user endpoints", control, {}, relations, heartbeat_);
    flows_.add("their ACKNACKs", control, Recurrence{}.answered(), relations, acknack_);
    if (dds_.sedp.initial_acknack_delay == model::Nanoseconds{0}) return;
    const Recurrence attempts = Recurrence::attempts(dds_.sedp);
    flows_.add("initial ACKNACKs of user endpoints", control, attempts, relations, acknack_);
    flows_.add("their HEARTBEATs", control, attempts.answered(), relations, heartbeat_);
    flows_.add("ACKNACKs to these", control, attempts.answered().answered(), relations, acknack_);
  }

 private:
  /// With static peers a copy goes to each port of every other host that is asked.
  static Flows::ToAll packets_to_all(const model::Scenario& scenario, const Omission& omission,
                                     const Flows& flows) {
    const std::int64_t bytes = fastdds::sizes_of(scenario.dds).announcement;
    if (scenario.dds.discovery != model::Discovery::static_peers || omission.port_copies) {
      return flows.multicast(bytes);
    }
    const std::int64_t other_hosts = std::int64_t{scenario.deployment.host_count()} - 1;
    return {other_hosts * scenario.dds.peer_ports, flows.unicast(bytes)};
  }

  void add_data(Stream s, std::uint32_t descriptors, std::int64_t peers) {
    for (std::uint32_t d = 0; d < descriptors; ++d) {
      flows_.add("DATA", TrafficClass::initial_data, {}, peers,
                 alone_in_fastdds(dds_, flows_, s, d));
      const std::int64_t with_ride =
          flows_.route.fragments(alone(dds_, s, d) + fastdds::heartbeat_submessage_bytes);
      flows_.traffic.push_fragments = std::max(flows_.traffic.push_fragments, with_ride);
    }
  }

  void add_attempts(std::int64_t peers) {
    const Recurrence attempts = Recurrence::attempts(dds_.sedp);
    const std::int64_t relations = 2 * peers;
    flows_.add("initial ACKNACKs", TrafficClass::acknack, attempts, relations, acknack_);
    if (omission_.heartbeats) return;
    add_heartbeats("answers to initial ACKNACKs", "ACKNACKs to these", attempts.answered(),
                   relations);
  }

  void add_heartbeats(const char* what, const char* answers, const Recurrence& when,
                      std::int64_t count) {
    flows_.add(what, TrafficClass::heartbeat, when, count, heartbeat_);
    flows_.add(answers, TrafficClass::acknack, when.answered(), count, acknack_);
  }

  const model::DdsProfile& dds_;
  const Omission omission_;
  Flows& flows_;
  const Flows::ToAll to_all_;
  const std::int64_t heartbeat_ = flows_.unicast(fastdds::heartbeat_to_one_bytes);
  const std::int64_t acknack_ =
      flows_.unicast(fastdds::acknack_bytes + fastdds::acknack_bitmap_bytes);
};

}  // namespace

std::int64_t exhaustions_of_fastdds(const model::DdsProfile& dds, std::int64_t created,
                                    std::int64_t asked) {
  const model::SedpProfile& sedp = dds.sedp;
  if (sedp.piggyback == model::Piggyback::off) return 0;
  if (sedp.piggyback == model::Piggyback::group) return plus(created, asked);
  const bool cumulative = sedp.piggyback == model::Piggyback::cumulative;
  const std::int64_t sums = cumulative ? times(times(asked, asked + 1) / 2, largest_step(dds))
                                       : times(asked, largest_charge(dds));
  const std::int64_t charged = plus(sums, times(created, largest_charge(dds)));
  const std::int64_t most = charged / plus(sedp.piggyback_threshold_bytes.count(), 1);
  return std::min(most, plus(created, asked));
}

std::int64_t alone_in_fastdds(const model::DdsProfile& dds, const Flows& flows, Stream s,
                              std::uint32_t d) {
  const std::int64_t bytes = alone(dds, s, d);
  return flows.unicast(bytes) + rounding(flows, flows.route.fragments(bytes));
}

void add_flows_of_fastdds(const model::Scenario& scenario, const Omission& omission, Flows& flows) {
  Adder adder{scenario, omission, flows};
  for (std::uint32_t i = 0; i < flows.topology.participant_count(); ++i) adder.add_participant(i);
  for (std::uint32_t pair = 0; pair < flows.topology.pair_count(); ++pair) {
    const model::Pair& ends = flows.topology.pair(pair);
    if (ends.cross_host) adder.add_control(scenario.deployment, ends);
  }
}

}  // namespace stormproof::calculus
