// The flows of the paper's rules, with pushed DATA and both sides opening at once. What a
// participant pushes does not depend on when: at its q-th opening the same descriptors go out with
// the same bytes sent before, so the HEARTBEATs that DATA causes are counted exactly.
#include <map>
#include <tuple>

#include "checker/engines/calculus/open_loop_parts.hpp"
#include "model/descriptor_sizes.hpp"

namespace stormproof::calculus {

namespace {

using model::Stream;
using model::TrafficClass;

/// What one participant pushes to all its peers.
struct Pushed {
  std::int64_t packets = 0;
  std::int64_t airtime = 0;         ///< of the DATA
  std::int64_t most_fragments = 0;  ///< of a packet
  std::int64_t exhaustions = 0;
  std::array<std::int64_t, 2> rides{};       ///< HEARTBEATs inside of DATA, by stream
  std::array<std::int64_t, 2> heartbeats{};  ///< those of their own
};

/// Fills packets as the writer does (`Generate` in fsm/composition/paper.hpp), without sending.
class Pusher {
 public:
  Pusher(const model::DdsProfile& dds, const model::RouteAirtime& route, bool charges)
      : sedp_{dds.sedp},
        sizes_{dds.descriptors},
        route_{route},
        charges_{charges && sedp_.piggyback != model::Piggyback::off} {}

  Pushed push(std::int64_t peers, const std::array<std::uint32_t, 2>& descriptors) {
    pushed_ = {};
    sent_ = 0;
    for (std::int64_t open = 1; open <= peers; ++open) {
      for (const Stream s : model::streams) push_one(s, descriptors[index_of(s)], open);
    }
    return pushed_;
  }

 private:
  /// The HEARTBEAT of the opening before has filled the budget.
  void push_one(Stream s, std::uint32_t count, std::int64_t open) {
    const std::int64_t shared = sedp_.shared_header_bytes.count();
    budget_ = sedp_.piggyback_threshold_bytes.count();
    payload_ = 0;
    members_ = 0;
    for (std::uint32_t d = 0; d < count; ++d) {
      const std::int64_t bytes = sizes_.bytes(s, d);
      if (members_ > 0 && packet_is_full(sedp_, payload_, bytes - shared)) flush();
      const std::int64_t added = members_ == 0 ? bytes : bytes - shared;
      payload_ += added;
      ++members_;
      if (charges_) charge(s, added, open);
    }
    if (members_ > 0) flush();
  }

  void charge(Stream s, std::int64_t added, std::int64_t open) {
    sent_ += added;
    budget_ -= sedp_.piggyback == model::Piggyback::cumulative ? sent_ : added;
    if (budget_ >= 0) return;
    budget_ = sedp_.piggyback_threshold_bytes.count();
    ++pushed_.exhaustions;
    if (open == 1) {
      const std::int64_t bytes = sedp_.piggyback_heartbeat_bytes.count();
      payload_ += bytes;
      sent_ += bytes;
      ++pushed_.rides[index_of(s)];
      return;
    }
    flush();
    sent_ += sedp_.heartbeat_bytes.count();
    pushed_.heartbeats[index_of(s)] += open;
  }

  void flush() {
    ++pushed_.packets;
    pushed_.airtime += route_.packet_ns(payload_, false);
    pushed_.most_fragments = std::max(pushed_.most_fragments, route_.fragments(payload_));
    payload_ = 0;
    members_ = 0;
  }

  const model::SedpProfile& sedp_;
  const model::DescriptorSizes sizes_;
  const model::RouteAirtime& route_;
  const bool charges_;
  Pushed pushed_;
  std::int64_t sent_ = 0;
  std::int64_t budget_ = 0;
  std::int64_t payload_ = 0;
  std::uint32_t members_ = 0;
};

/// `count` HEARTBEATs, and the ACKNACKs that answer them. `rides`: inside of DATA.
void add_heartbeats(const char* what, const char* answers, const Recurrence& when,
                    std::int64_t count, std::int64_t heartbeat_ns, std::int64_t acknack_ns,
                    Flows& flows) {
  flows.add(what, TrafficClass::heartbeat, when, count, heartbeat_ns);
  flows.add(answers, TrafficClass::acknack, when.answered(), count, acknack_ns);
}

void add_writer(const model::SedpProfile& sedp, std::int64_t peers, std::uint32_t descriptors,
                Flows& flows, const Pushed& pushed, Stream s, const Omission& omission) {
  const std::int64_t heartbeat = flows.unicast(sedp.heartbeat_bytes.count());
  const std::int64_t acknack =
      flows.unicast(sedp.acknack_bytes.count() + 4 * ((std::int64_t{descriptors} + 31) / 32));
  if (!omission.heartbeats) {
    add_heartbeats("HEARTBEATs of openings", "their ACKNACKs", {}, peers, heartbeat, acknack,
                   flows);
    add_heartbeats("periodic HEARTBEATs", "ACKNACKs to periodic HEARTBEATs",
                   Recurrence::every(sedp.heartbeat_period), peers, heartbeat, acknack, flows);
  }
  constexpr const char* answers = "ACKNACKs to piggyback HEARTBEATs";
  add_heartbeats("piggyback HEARTBEATs", answers, {}, pushed.heartbeats[index_of(s)], heartbeat,
                 acknack, flows);
  add_heartbeats("HEARTBEATs inside of DATA", answers, {}, pushed.rides[index_of(s)], 0, acknack,
                 flows);
  if (sedp.initial_acknack_delay == model::Nanoseconds{0}) return;
  const Recurrence unheard = Recurrence::unheard(sedp);
  flows.add("initial ACKNACKs", TrafficClass::acknack, unheard, peers,
            flows.unicast(sedp.acknack_bytes.count()));
  if (sedp.initial_acknack == model::InitialAckNackReply::heartbeat && !omission.heartbeats) {
    add_heartbeats("answers to initial ACKNACKs", "ACKNACKs to these", unheard, peers, heartbeat,
                   acknack, flows);
  }
}

}  // namespace

Generation generation_of_the_paper(const model::Scenario& scenario, const Flows& flows, Stream s,
                                   std::uint32_t descriptors) {
  std::array<std::uint32_t, 2> counts{};
  counts[index_of(s)] = descriptors;
  const Pushed pushed = Pusher{scenario.dds, flows.route, false}.push(1, counts);
  return {pushed.packets, pushed.airtime};
}

void add_flows_of_the_paper(const model::Scenario& scenario, const Omission& omission,
                            Flows& flows) {
  const model::SedpProfile& sedp = scenario.dds.sedp;
  Pusher pusher{scenario.dds, flows.route, !omission.piggyback};
  using Kind = std::tuple<std::int64_t, std::uint32_t, std::uint32_t>;
  std::map<Kind, Pushed> known;
  for (std::uint32_t i = 0; i < flows.topology.participant_count(); ++i) {
    const std::int64_t peers = cross_peers(flows.topology, i);
    const std::array<std::uint32_t, 2> descriptors{flows.topology.descriptor_count(i, Stream::pub),
                                                   flows.topology.descriptor_count(i, Stream::sub)};
    const auto [entry, is_new] = known.try_emplace({peers, descriptors[0], descriptors[1]});
    if (is_new) entry->second = pusher.push(peers, descriptors);
    const Pushed& pushed = entry->second;
    flows.traffic.exhaustions += pushed.exhaustions;
    flows.traffic.push_fragments = std::max(flows.traffic.push_fragments, pushed.most_fragments);
    const std::int64_t bytes = scenario.dds.spdp.payload_bytes.count();
    flows.add_announcements(scenario.dds.spdp, bytes, flows.multicast(bytes), peers, peers);
    flows.add("DATA", TrafficClass::initial_data, {}, 1, pushed.airtime);
    for (const Stream s : model::streams) {
      add_writer(sedp, peers, descriptors[index_of(s)], flows, pushed, s, omission);
    }
  }
}

}  // namespace stormproof::calculus
