// From capture files to the list of events: reads, merges, orders by time, and finds out for whom
// each datagram was.
#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <string_view>

#include <fmt/core.h>

#include "checker/evidence/capture/capture_file.hpp"
#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/capture/ip_packet.hpp"
#include "checker/evidence/capture/ip_reassembly.hpp"
#include "checker/evidence/capture/link_layer.hpp"
#include "checker/evidence/capture/merge.hpp"
#include "checker/evidence/capture/message_events.hpp"
#include "checker/evidence/capture/repeated_packets.hpp"

namespace stormproof::capture {

namespace {

using model::config::InputError;
using model::config::Result;

/// Everything that was read, before captures are merged.
struct Reading {
  std::vector<CaptureInfo> captures{};
  std::deque<DatagramRecord> datagrams{};
  std::vector<Sighting> sightings{};  ///< one for each datagram, of several captures
  bool is_alone = false;              ///< one capture: nothing to merge
  Extraction extraction{};
  Igmp igmp{};
  Remarks remarks{};
  std::uint64_t packets = 0;
  std::int64_t first_ns = std::numeric_limits<std::int64_t>::max();
  std::int64_t last_ns = std::numeric_limits<std::int64_t>::min();

  /// What everything that grows with the captures takes, about, in bytes; with what `conform` keeps
  /// beside each event.
  [[nodiscard]] std::size_t memory() const {
    constexpr std::size_t beside_event = 256;
    const std::size_t kept = extraction.events.size() * (sizeof(Event) + beside_event) +
                             extraction.descriptions.size() * sizeof(Description) +
                             datagrams.size() * sizeof(DatagramRecord) +
                             sightings.size() * sizeof(Sighting);
    return kept / 10 * 11;  // lists have room to grow
  }
};

/// What may be kept of all captures together, so that 500 MB are enough for whoever looks at them.
/// The rest of a longer capture is not read: it answers as if it had ended there.
constexpr std::size_t most_memory = 400'000'000;

void add_datagram(const Datagram& datagram, Reading& reading) {
  CaptureInfo& info = reading.captures.back();
  const auto capture = static_cast<std::uint16_t>(reading.captures.size() - 1);
  const auto index = static_cast<std::uint32_t>(reading.datagrams.size());
  const std::string place = fmt::format("{}, packet {}", info.name, datagram.packet);
  const auto message = extract(datagram, index, place, reading.extraction, reading.remarks);
  if (!message) return;
  ++info.datagrams;
  ++info.sources[datagram.source.address];
  if (datagram.destination.address.is_multicast()) {
    ++info.multicast_sources[datagram.source.address];
  }
  reading.datagrams.push_back({.time_ns = datagram.time_ns,
                               .packet = datagram.packet,
                               .wire_bytes = static_cast<std::uint32_t>(datagram.wire_bytes),
                               .payload_bytes = static_cast<std::uint32_t>(datagram.payload.size()),
                               .statistics_bytes = message->statistics_bytes,
                               .user = message->user,
                               .capture = capture,
                               .frames = static_cast<std::uint16_t>(datagram.frames),
                               .vendor = message->vendor,
                               .time_to_live = datagram.time_to_live,
                               .source = datagram.source,
                               .destination = datagram.destination});
  if (reading.is_alone) return;
  reading.sightings.push_back({datagram.time_ns, capture, datagram.source, datagram.destination,
                               datagram.ip_id, datagram.payload.size(),
                               digest_of(datagram.payload)});
}

/// A packet on a port of Zenoh: TCP 7447, and UDP 7446, to which it scouts. Participants 18 of a
/// host in domain 0 have these UDP ports, too, so what is RTPS is not one.
bool is_of_zenoh(const IpPacket& packet) {
  constexpr std::uint8_t tcp = 6;
  constexpr std::uint8_t udp = 17;
  constexpr std::uint16_t links = 7447;
  constexpr std::uint16_t scouting = 7446;
  constexpr std::size_t udp_header = 8;
  constexpr std::string_view rtps = "RTPS";
  if (packet.offset > 0 || packet.payload.size() < udp_header) return false;
  const Bytes payload = packet.payload;
  const auto port = [&](std::size_t at) { return payload[at] << 8U | payload[at + 1]; };
  if (packet.protocol == tcp) return port(0) == links || port(2) == links;
  if (packet.protocol != udp || port(2) != scouting) return false;
  const Bytes content = payload.subspan(udp_header);
  return !std::equal(
      rtps.begin(), rtps.end(), content.begin(),
      content.begin() + static_cast<std::ptrdiff_t>(std::min(rtps.size(), content.size())));
}

/// The datagram that this frame completes, if it is not one that was there before.
std::optional<Datagram> datagram_in(const Packet& packet, CaptureFile& file,
                                    RepeatedPackets& repeated, IpReassembly& reassembly, Igmp& igmp,
                                    Remarks& remarks) {
  const auto ip = ip_packet(packet.bytes, file.link_type());
  if (!ip) return std::nullopt;
  const auto remark = [&](const char* what) {
    remarks.add(what, fmt::format("{}, packet {}", file.name(), packet.number));
  };
  if (repeated.was_there(packet.time_ns, packet.bytes, *ip)) {
    remark("packets that passed several of the captured interfaces, seen once");
    return std::nullopt;
  }
  if (const auto parsed = parse_ip(*ip)) {
    if (is_of_zenoh(*parsed)) remark("packets of Zenoh, which is no RTPS");
    add_igmp(*parsed, igmp);
  }
  return reassembly.add(packet, *ip);
}

/// Whether the time of a packet is far from those around it: a stamp that is damaged or forged. A
/// second one that agrees with it makes a new time of it.
class Clock {
 public:
  bool is_wrong(std::int64_t time_ns) {
    if (last_ == never || is_near(time_ns, last_) || is_near(time_ns, doubtful_)) {
      last_ = time_ns;
      doubtful_ = never;
      return false;
    }
    doubtful_ = time_ns;
    return true;
  }

 private:
  static constexpr std::int64_t never = -1;

  static bool is_near(std::int64_t time_ns, std::int64_t other) {
    constexpr std::int64_t day_ns = 86'400'000'000'000;
    return other != never && std::abs(time_ns - other) <= day_ns;
  }

  std::int64_t last_ = never;
  std::int64_t doubtful_ = never;
};

/// False if the reading was interrupted. `memory`: of everything that was read by then, at most.
bool read_packets(CaptureFile& file, Reading& reading, std::size_t memory,
                  const Progress& progress) {
  constexpr std::uint64_t packets_between_reports = 4096;
  reading.captures.push_back({.name = file.name()});
  IpReassembly reassembly{file.name(), reading.remarks};
  RepeatedPackets repeated{file.link_type()};
  Clock clock;
  bool goes_on = true;
  while (goes_on) {
    const auto packet = file.next();
    if (!packet) break;
    ++reading.captures.back().packets;
    if (clock.is_wrong(packet->time_ns)) {
      reading.remarks.add(
          "packets whose time is more than a day from that of the one before, left "
          "out",
          fmt::format("{}, packet {}", file.name(), packet->number));
      continue;
    }
    reading.first_ns = std::min(reading.first_ns, packet->time_ns);
    reading.last_ns = std::max(reading.last_ns, packet->time_ns);
    const auto datagram =
        datagram_in(*packet, file, repeated, reassembly, reading.igmp, reading.remarks);
    if (datagram) add_datagram(*datagram, reading);
    if (reading.memory() > memory) {
      reading.remarks.add("captures with more than is kept, used up to there",
                          fmt::format("{}, after packet {}", file.name(), packet->number));
      break;
    }
    if (++reading.packets % packets_between_reports == 0 && progress) {
      goes_on = progress(reading.packets);
    }
  }
  reassembly.finish();
  if (!file.damage().empty()) {
    reading.remarks.add("damaged captures, used up to the damage",
                        fmt::format("{}, after packet {}: {}", file.name(),
                                    reading.captures.back().packets, file.damage()));
  }
  return goes_on;
}

/// Datagrams that count, in time order.
std::vector<std::size_t> ordered(Reading& reading) {
  std::vector<bool> counts(reading.datagrams.size(), true);
  if (reading.captures.size() > 1) counts = merge(reading.sightings);
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k]) {
      order.push_back(k);
    } else {
      ++reading.captures[reading.datagrams[k].capture].merged;
    }
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return reading.datagrams[k].time_ns; });
  return order;
}

TopologyBuilder describe(const Reading& reading, const std::vector<std::size_t>& order) {
  TopologyBuilder builder;
  std::vector<bool> counts(reading.datagrams.size(), false);
  for (const std::size_t k : order) counts[k] = true;
  for (const Event& event : reading.extraction.events) {
    if (!counts[event.datagram]) continue;
    const DatagramRecord& datagram = reading.datagrams[event.datagram];
    builder.saw_message(event.source, datagram.vendor, datagram.source.address, event.time_ns);
  }
  for (const auto& [source, seen] : reading.extraction.user_sources) {
    for (const std::uint32_t k : {seen.first, seen.second}) {
      const DatagramRecord& datagram = reading.datagrams[k];
      builder.saw_message(source.first, datagram.vendor, source.second, datagram.time_ns);
    }
  }
  for (const Description& one : reading.extraction.descriptions) {
    if (!counts[one.datagram]) continue;
    const std::int64_t time_ns = reading.datagrams[one.datagram].time_ns;
    const Content& content = reading.extraction.contents[one.content];
    if (const auto* participant = std::get_if<ParticipantData>(&content)) {
      builder.saw_participant(one.source, *participant, time_ns);
    } else {
      builder.saw_endpoint(one.source, one.writer, one.sequence_number,
                           std::get<EndpointData>(content), time_ns);
    }
  }
  return builder;
}

/// Takes the datagrams that count, and their events, in the order of time. If they are in order and
/// all count, nothing is copied: a large capture is in memory once.
void fill(Conversation& conversation, Reading& reading, const std::vector<std::size_t>& order) {
  std::deque<Event>& events = reading.extraction.events;
  conversation.lookups = std::move(reading.extraction.lookups);
  const bool is_all = order.size() == reading.datagrams.size();
  if (is_all && std::ranges::is_sorted(order)) {
    conversation.datagrams = std::move(reading.datagrams);
    conversation.events = std::move(events);
    return;
  }
  std::vector<std::size_t> first_event(reading.datagrams.size() + 1, 0);
  for (const Event& event : events) ++first_event[event.datagram + 1];
  std::partial_sum(first_event.begin(), first_event.end(), first_event.begin());
  for (const std::size_t k : order) {
    const auto number = static_cast<std::uint32_t>(conversation.datagrams.size());
    conversation.datagrams.push_back(reading.datagrams[k]);
    for (std::size_t e = first_event[k]; e < first_event[k + 1]; ++e) {
      conversation.events.push_back(std::move(events[e]));
      conversation.events.back().datagram = number;
    }
  }
}

/// Finds out for whom each event is, and whether that stays on one host.
void address(Conversation& conversation, const TopologyBuilder& builder) {
  std::map<GuidPrefix, std::size_t> host;
  for (const Participant& one : conversation.topology.participants) host[one.prefix] = one.host;
  for (Event& event : conversation.events) {
    const DatagramRecord& datagram = conversation.datagrams[event.datagram];
    if (!event.destination && !event.is_multicast) {
      event.destination = builder.receiver(datagram.destination, datagram.time_ns);
    }
    if (event.destination && conversation.topology.hosts > 1) {
      const auto from = host.find(event.source);
      const auto to = host.find(*event.destination);
      event.is_same_host = from != host.end() && to != host.end() && from->second == to->second;
    }
  }
}

Result<Conversation> converse(Reading reading) {
  if (reading.datagrams.empty()) {
    std::string message = "no RTPS message in it";
    for (const Remark& remark : reading.remarks.list()) {
      message += fmt::format("; {} × {} ({})", remark.count, remark.what, remark.first);
    }
    return InputError{reading.captures.empty() ? "captures" : reading.captures.front().name,
                      message};
  }
  Conversation conversation;
  const std::vector<std::size_t> order = ordered(reading);
  const TopologyBuilder builder = describe(reading, order);
  conversation.topology = builder.build();
  fill(conversation, reading, order);
  address(conversation, builder);
  conversation.captures = std::move(reading.captures);
  conversation.igmp = std::move(reading.igmp);
  conversation.remarks = reading.remarks.list();
  conversation.first_ns = reading.first_ns;
  conversation.last_ns = reading.last_ns;
  return conversation;
}

}  // namespace

Result<Conversation> read_conversation(std::span<const std::string> files,
                                       const Progress& progress) {
  Reading reading;
  reading.is_alone = files.size() == 1;
  for (const std::string& path : files) {
    auto file = CaptureFile::open(path);
    if (!file) return file.error();
    // None takes what the others need.
    const std::size_t memory = most_memory / files.size() * (reading.captures.size() + 1);
    if (!read_packets(*file, reading, memory, progress)) break;
  }
  return converse(std::move(reading));
}

Result<Conversation> read_conversation(std::span<const MemoryCapture> captures) {
  Reading reading;
  reading.is_alone = captures.size() == 1;
  for (const MemoryCapture& capture : captures) {
    auto file = CaptureFile::from_memory(capture.name, capture.content, capture.unpack_limit);
    if (!file) return file.error();
    read_packets(*file, reading, capture.most_kept.value_or(most_memory), {});
  }
  return converse(std::move(reading));
}

}  // namespace stormproof::capture
