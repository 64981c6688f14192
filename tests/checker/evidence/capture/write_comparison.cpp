// Comparison of a run with its capture. Sequence numbers, entity ids and addresses are written out
// here once more, not taken from the writer.
#include "tests/checker/evidence/capture/write_comparison.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "checker/evidence/capture/counting.hpp"
#include "checker/evidence/capture/write/capture_probe.hpp"
#include "checker/evidence/capture/write/identities.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/topology.hpp"
#include "model/fastdds/matching.hpp"
#include "model/fastdds/relay.hpp"

namespace stormproof::capture::testing {

namespace {

using model::PacketKind;
using model::Stream;

bool is_fastdds(const model::Scenario& scenario) {
  return scenario.dds.implementation == model::ImplementationKind::fastdds;
}

bool has_server(const model::Scenario& scenario) {
  return is_fastdds(scenario) && (scenario.dds.discovery == model::Discovery::server ||
                                  scenario.dds.discovery == model::Discovery::super_client);
}

std::vector<write::Identity> identities(const model::Scenario& scenario) {
  return write::identities(
      scenario.deployment, is_fastdds(scenario) ? fastdds_vendor : simulated_vendor,
      has_server(scenario) ? scenario.dds.discovery : model::Discovery::simple);
}

std::uint32_t descriptors_of(const model::Scenario& scenario, std::uint32_t i, Stream stream) {
  const model::Participant& participant = scenario.deployment.participants[i];
  const model::DescriptorProfile& profile = scenario.dds.descriptors;
  return stream == Stream::pub ? profile.default_publications + participant.publications
                               : profile.default_subscriptions + participant.subscriptions;
}

std::string text(const model::Counts& counts) {
  std::ostringstream out;
  out << counts.initial_data << ' ' << counts.repair_data << ' ' << counts.heartbeat << ' '
      << counts.acknack << ' ' << counts.spdp_multicast << '+' << counts.spdp_unicast << ' '
      << counts.pdp_data << ' ' << counts.pdp_heartbeat << ' ' << counts.pdp_acknack << ' '
      << counts.gap;
  return out.str();
}

std::string control_difference(const model::RunResult& run, const Counting& counting) {
  std::uint64_t control = 0;
  for (const Traffic traffic : {Traffic::liveliness, Traffic::user}) {
    const TrafficFigures& figures = counting.traffic[static_cast<std::size_t>(traffic)];
    if (figures.data > 0 || figures.gap > 0) return "DATA of user endpoints";
    control += figures.heartbeat + figures.acknack;
  }
  return control == run.user_control ? "" : "control traffic " + std::to_string(control);
}

std::string topology_difference(const model::Scenario& scenario, const model::RunResult& run,
                                const Topology& topology) {
  const auto names = identities(scenario);
  std::map<std::size_t, std::uint32_t> host;  // of the capture, in the deployment
  std::set<std::uint32_t> hosts;
  const bool has_others = std::ranges::any_of(scenario.deployment.participants,
                                              [](const auto& one) { return one.host.value != 0; });
  for (std::uint32_t i = 0; i < names.size(); ++i) {
    const Participant* found = topology.find(names[i].prefix);
    if (i == scenario.deployment.size()) {
      if (run.completed() && (found == nullptr || found != topology.server())) return "no server";
      if (found != nullptr) hosts.insert(0);
      continue;
    }
    const model::Participant& participant = scenario.deployment.participants[i];
    const bool is_local = has_server(scenario) && participant.host.value == 0;
    // The server tells others of it, if there are any.
    if (found == nullptr && is_local && !(run.completed() && has_others)) continue;
    if (found == nullptr) {
      if (run.completed() || participant.start < run.end_time) return names[i].name + " is missing";
      continue;
    }
    const auto [entry, is_new] = host.emplace(found->host, participant.host.value);
    hosts.insert(participant.host.value);
    if (entry->second != participant.host.value) return names[i].name + ": wrong host";
    const bool is_untold = is_local && found->name.empty() && !run.completed();
    if (found->name != names[i].name && !is_untold)
      return names[i].name + ": wrong name " + found->name;
    for (const Stream stream : model::streams) {
      const std::size_t announced = found->announced(
          stream == Stream::pub ? entity::publications_writer : entity::subscriptions_writer);
      const std::uint32_t all = descriptors_of(scenario, i, stream);
      // Of a client on the server's host only what somebody else needs is told.
      const bool fits = run.completed() && !is_local ? announced == all : announced <= all;
      if (!fits) return names[i].name + ": " + std::to_string(announced) + " endpoints";
    }
  }
  return hosts.size() == topology.hosts ? "" : std::to_string(topology.hosts) + " hosts";
}

/// How many descriptors somebody needs whose way is over the link: from clients to the server, and
/// from the server to each client that needs them.
std::uint64_t required_over_link(const model::Scenario& scenario) {
  const model::Topology topology = model::topology_of(scenario);
  const auto& participants = scenario.deployment.participants;
  std::uint64_t required = 0;
  for (std::uint32_t i = 0; i < participants.size(); ++i) {
    for (const Stream stream : model::streams) {
      for (std::uint32_t d = 0; d < descriptors_of(scenario, i, stream); ++d) {
        bool needed = false;
        for (std::uint32_t j = 0; j < participants.size(); ++j) {
          if (j == i || !model::fastdds::has_other_side(topology, j, stream, d)) continue;
          needed = true;
          if (participants[j].host.value != 0) ++required;
        }
        if (needed && participants[i].host.value != 0) ++required;
      }
    }
  }
  return required;
}

/// How the datagram's message should look.
class Expectation {
 public:
  Expectation(const model::Scenario& scenario, const Emission& emission,
              const std::vector<write::Identity>& names, bool is_liveliness)
      : scenario_{scenario}, emission_{emission}, names_{names}, is_liveliness_{is_liveliness} {}

  [[nodiscard]] std::string difference(const DatagramRecord& datagram,
                                       const std::vector<const Event*>& events) const {
    if (datagram.time_ns != simulated_epoch_ns + emission_.time_ns) return "time";
    if (!has_size(datagram.payload_bytes)) return "payload size";
    if (datagram.frames != (datagram.payload_bytes + 8 + 1479) / 1480) return "fragments";
    if (datagram.source.address != names_[emission_.source].metatraffic.address) return "source";
    if (emission_.to_nobody) return to_nobody(datagram, events);
    if (datagram.destination != destination()) return "destination";
    if (events.size() != emission_.descriptors.size() * (is_data() ? 1 : 0) + others()) {
      return "number of submessages";
    }
    for (std::size_t k = 0; k < events.size(); ++k) {
      if (const char* what = event_difference(*events[k], k); what != nullptr) return what;
    }
    return "";
  }

 private:
  [[nodiscard]] bool is_data() const { return emission_.kind == PacketKind::data; }
  [[nodiscard]] bool is_control() const {
    return emission_.kind == PacketKind::user_heartbeat ||
           emission_.kind == PacketKind::user_acknack;
  }

  /// The model's GAPs have no bitmap, and its ACKNACKs one word at most.
  [[nodiscard]] bool has_size(std::uint32_t bytes) const {
    const bool is_gap =
        emission_.kind == PacketKind::relayed && !emission_.relayed->numbers.empty();
    const bool has_bitmap = is_gap || emission_.kind == PacketKind::acknack;
    return has_bitmap ? bytes >= emission_.payload_bytes : bytes == emission_.payload_bytes;
  }

  [[nodiscard]] std::size_t others() const {
    if (emission_.kind == PacketKind::relayed) {
      const model::Relayed& relayed = *emission_.relayed;
      return (relayed.has_data ? 1U : 0U) + (relayed.has_heartbeat ? 1U : 0U) +
             (relayed.numbers.empty() ? 0U : 1U);
    }
    return is_data() ? emission_.heartbeats : std::max<std::size_t>(emission_.heartbeats, 1);
  }

  [[nodiscard]] UdpEnd destination() const {
    if (emission_.kind == PacketKind::spdp_multicast) return write::discovery_group();
    const write::Identity& to = names_[emission_.destination];
    const bool is_user = is_control() && !is_liveliness_;
    return is_user ? to.user : to.metatraffic;
  }

  /// An announcement to a port of another host that no participant has.
  [[nodiscard]] std::string to_nobody(const DatagramRecord& datagram,
                                      const std::vector<const Event*>& events) const {
    const auto is_there = [&](const write::Identity& one) {
      return one.metatraffic == datagram.destination;
    };
    if (std::ranges::any_of(names_, is_there)) return "somebody has the port";
    if (datagram.destination.address == names_[emission_.source].metatraffic.address) return "host";
    const bool fits = events.size() == 1 && events[0]->traffic() == Traffic::spdp &&
                      events[0]->data() != nullptr && !events[0]->destination;
    return fits ? "" : "announcement to nobody";
  }

  [[nodiscard]] const char* event_difference(const Event& event, std::size_t k) const {
    if (event.source != names_[emission_.source].prefix) return "source GUID";
    if (emission_.relayed) return relayed_difference(event, *emission_.relayed);
    const bool is_announcement = event.traffic() == Traffic::spdp;
    if (is_registration()) return registration_difference(event);
    if (is_announcement) return event.data()->sequence_number == 1 ? nullptr : "SPDP number";
    if (event.destination != names_[emission_.destination].prefix) return "destination GUID";
    if (!is_control() && event.writer != (emission_.stream == Stream::pub ? 0x3c2U : 0x4c2U)) {
      return "writer";
    }
    if (const DataEvent* data = event.data()) {
      return data->sequence_number == emission_.descriptors[k] + 1 ? nullptr : "sequence number";
    }
    if (const HeartbeatEvent* heartbeat = event.heartbeat()) return in(*heartbeat);
    if (const AcknackEvent* acknack = event.acknack()) return in(*acknack);
    return "unexpected submessage";
  }

  [[nodiscard]] bool is_registration() const {
    return emission_.kind == PacketKind::registration ||
           emission_.kind == PacketKind::registration_heartbeat ||
           emission_.kind == PacketKind::registration_acknack;
  }

  [[nodiscard]] const char* registration_difference(const Event& event) const {
    if (event.destination != names_[emission_.destination].prefix) return "destination GUID";
    if (event.writer != 0x100c2U) return "writer";
    if (const DataEvent* data = event.data()) {
      return data->sequence_number == 1 && emission_.kind == PacketKind::registration ? nullptr
                                                                                      : "DATA(p)";
    }
    if (const HeartbeatEvent* heartbeat = event.heartbeat()) {
      return heartbeat->first == 1 && heartbeat->last <= 1 &&
                     emission_.kind == PacketKind::registration_heartbeat
                 ? nullptr
                 : "HEARTBEAT(p)";
    }
    const AcknackEvent* acknack = event.acknack();
    const bool fits = acknack != nullptr && emission_.kind == PacketKind::registration_acknack &&
                      acknack->missing.base == (emission_.initial_acknack ? 0 : 2) &&
                      acknack->is_final != emission_.initial_acknack;
    return fits ? nullptr : "ACKNACK(p)";
  }

  [[nodiscard]] const char* relayed_difference(const Event& event,
                                               const model::Relayed& relayed) const {
    if (event.destination != names_[emission_.destination].prefix) return "destination GUID";
    const bool is_of_announcements = emission_.detail == model::fastdds::relay::announcements;
    const EntityId sedp = emission_.stream == Stream::pub ? 0x3c2U : 0x4c2U;
    if (event.writer != (is_of_announcements ? 0x100c2U : sedp)) return "writer";
    if (const DataEvent* data = event.data()) {
      const bool fits = relayed.has_data && data->sequence_number == relayed.number &&
                        (relayed.is_announcement ||
                         (data->endpoint->prefix == names_[relayed.participant].prefix &&
                          data->endpoint->entity >> 8U == relayed.descriptor + 1));
      return fits ? nullptr : "relayed DATA";
    }
    if (const HeartbeatEvent* heartbeat = event.heartbeat()) {
      return relayed.has_heartbeat && heartbeat->first == relayed.first &&
                     heartbeat->last == relayed.last
                 ? nullptr
                 : "relay's HEARTBEAT";
    }
    std::vector<std::int64_t> numbers;
    const auto add = [&](const SequenceNumberSet& set) {
      for (std::uint32_t k = 0; k < set.num_bits; ++k) {
        if (set.has(k)) numbers.push_back(set.base + k);
      }
    };
    if (const GapEvent* gap = event.gap()) {
      for (std::int64_t k = gap->start; k < gap->list.base; ++k) numbers.push_back(k);
      add(gap->list);
    } else {
      const AcknackEvent& acknack = *event.acknack();
      if (acknack.missing.base != (emission_.initial_acknack ? 0 : relayed.base)) return "base";
      if (acknack.is_final == (emission_.initial_acknack || !relayed.numbers.empty())) {
        return "final flag";
      }
      add(acknack.missing);
    }
    // A bitmap does not reach farther.
    const auto most = std::min<std::ptrdiff_t>(std::ssize(relayed.numbers), 256);
    const bool fits = std::ssize(numbers) >= std::min<std::ptrdiff_t>(most, 1) &&
                      std::equal(numbers.begin(), numbers.end(), relayed.numbers.begin(),
                                 relayed.numbers.begin() + std::ssize(numbers));
    return fits ? nullptr : "numbers";
  }

  [[nodiscard]] const char* in(const HeartbeatEvent& heartbeat) const {
    const std::uint32_t last = is_control() ? 0
                               : is_fastdds(scenario_)
                                   ? emission_.detail
                                   : descriptors_of(scenario_, emission_.source, emission_.stream);
    return heartbeat.first == 1 && heartbeat.last == last && !heartbeat.is_final ? nullptr
                                                                                 : "HEARTBEAT";
  }

  [[nodiscard]] const char* in(const AcknackEvent& acknack) const {
    if (emission_.initial_acknack) {
      return acknack.missing.base == 0 && acknack.is_initial() && !acknack.is_final
                 ? nullptr
                 : "initial ACKNACK";
    }
    std::int64_t base = is_control() ? 1 : emission_.detail + 1;
    if (!is_fastdds(scenario_)) {
      base =
          1 + std::int64_t{emission_.descriptors.empty()
                               ? descriptors_of(scenario_, emission_.destination, emission_.stream)
                               : emission_.descriptors.front()};
    }
    std::vector<std::uint32_t> asked;
    for (std::uint32_t k = 0; k < acknack.missing.num_bits; ++k) {
      if (acknack.missing.has(k)) asked.push_back(static_cast<std::uint32_t>(base) - 1 + k);
    }
    if (acknack.is_final != asked.empty()) return "final flag";
    return acknack.missing.base == base && asked == emission_.descriptors ? nullptr : "ACKNACK";
  }

  const model::Scenario& scenario_;
  const Emission& emission_;
  const std::vector<write::Identity>& names_;
  const bool is_liveliness_;
};

}  // namespace

void EmissionRecorder::emitted(const model::Packet& packet, std::uint32_t source,
                               std::span<const std::uint32_t> destinations) {
  Emission one{.kind = packet.kind,
               .stream = packet.stream,
               .time_ns = packet.emitted.count(),
               .payload_bytes = packet.payload_bytes,
               .source = source,
               .detail = packet.detail,
               .heartbeats = packet.heartbeats,
               .initial_acknack = packet.initial_acknack,
               .to_nobody = packet.to_nobody,
               .relayed = packet.relayed};
  packet.descriptors.for_each([&](std::uint32_t d) { one.descriptors.push_back(d); });
  if (packet.multicast() || packet.to_nobody) emissions_.push_back(one);
  for (const std::uint32_t destination : destinations) {
    one.destination = destination;
    emissions_.push_back(one);
  }
}

Conversation conversation_of(const SimulatedCapture& capture) {
  constexpr std::size_t unpack_limit = std::size_t{1} << 30U;
  const std::vector<MemoryCapture> files{{"simulated.pcap", capture.pcap, unpack_limit}};
  auto conversation = read_conversation(files);
  if (!conversation) {
    ADD_FAILURE() << to_string(conversation.error());
    return {};
  }
  return std::move(*conversation);
}

std::string difference(const model::Scenario& scenario, const model::RunResult& run,
                       const Conversation& conversation) {
  const Counting counting = count(conversation, std::numeric_limits<std::int64_t>::max());
  if (counting.counts != run.counts) {
    return "counts " + text(counting.counts) + " instead of " + text(run.counts);
  }
  if (counting.same_host.total() > 0) return "same-host messages";
  // With static peers announcements go to ports that nobody has, too.
  const bool is_static = scenario.dds.discovery == model::Discovery::static_peers;
  if (counting.unknown_destination > 0 && !is_static) return "unknown destinations";
  if (!conversation.remarks.empty()) return conversation.remarks.front().what;
  const std::uint64_t required =
      has_server(scenario) ? required_over_link(scenario) : counting.counts.initial_data;
  if (run.completed() &&
      (counting.missing_count > 0 || counting.required == 0 || counting.required != required)) {
    return "required keys: " + std::to_string(counting.required) + " instead of " +
           std::to_string(required) + ", missing " + std::to_string(counting.missing_count);
  }
  if (std::string what = control_difference(run, counting); !what.empty()) return what;
  return topology_difference(scenario, run, conversation.topology);
}

std::string difference(const model::Scenario& scenario, const std::vector<Emission>& emissions,
                       const Conversation& conversation) {
  const auto names = identities(scenario);
  if (conversation.datagrams.size() != emissions.size()) return "number of datagrams";
  auto event = conversation.events.begin();
  for (std::size_t k = 0; k < emissions.size(); ++k) {
    std::vector<const Event*> events;
    for (; event != conversation.events.end() && event->datagram == k; ++event) {
      events.push_back(&*event);
    }
    const bool is_liveliness = !events.empty() && events.front()->traffic() == Traffic::liveliness;
    const Expectation expectation{scenario, emissions[k], names, is_liveliness};
    const std::string what = expectation.difference(conversation.datagrams[k], events);
    if (!what.empty()) return "datagram " + std::to_string(k) + ": " + what;
  }
  return "";
}

}  // namespace stormproof::capture::testing
