// Comparison of every packet of a run with its datagram. Sequence numbers, entity ids and addresses
// are written out here once more, not taken from the writer.
#include <algorithm>

#include "checker/evidence/capture/write/capture_probe.hpp"
#include "model/fastdds/relay.hpp"
#include "tests/checker/evidence/capture/write_comparison.hpp"
#include "tests/checker/evidence/capture/written_scenario.hpp"

namespace stormproof::capture::testing {

namespace {

using model::PacketKind;
using model::Stream;

/// How the datagram's message should look.
class Expectation {
 public:
  Expectation(const model::Scenario& scenario, const Emission& emission,
              const std::vector<write::Identity>& names, bool is_user)
      : scenario_{scenario}, emission_{emission}, names_{names}, is_user_{is_user} {}

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
    return is_control() && is_user_ ? to.user : to.metatraffic;
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
  const bool is_user_;
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
    const bool is_user = !events.empty() && events.front()->traffic() == Traffic::user;
    const Expectation expectation{scenario, emissions[k], names, is_user};
    const std::string what = expectation.difference(conversation.datagrams[k], events);
    if (!what.empty()) return "datagram " + std::to_string(k) + ": " + what;
  }
  return "";
}

}  // namespace stormproof::capture::testing
