// From packets of the model to RTPS messages.
#include "checker/evidence/capture/write/capture_probe.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "checker/evidence/capture/write/control_topics.hpp"
#include "checker/evidence/capture/write/cyclone_messages.hpp"
#include "checker/evidence/capture/write/descriptions.hpp"
#include "checker/evidence/capture/write/fan_out.hpp"
#include "checker/evidence/capture/write/packet_layout.hpp"
#include "checker/evidence/capture/write/pcap_writer.hpp"
#include "checker/evidence/capture/write/server_messages.hpp"
#include "model/engine/profiles.hpp"
#include "model/fastdds/endpoints.hpp"
#include "model/implementations.hpp"

namespace stormproof::capture {

namespace {

using model::PacketKind;
using model::Stream;

VendorId vendor_of(const model::Scenario& scenario) {
  return model::traits_of(scenario.dds).vendor.value_or(simulated_vendor);
}

/// Each of its own version.
std::vector<write::Identity> identities_of(const model::Scenario& scenario, VendorId vendor) {
  const bool has_server = model::traits_of(scenario.dds).has_server;
  std::vector<write::Identity> all = write::identities(
      scenario.deployment, vendor, has_server ? scenario.dds.discovery : model::Discovery::simple,
      scenario.dds.version.sizes);
  for (std::uint32_t i = 0; i < all.size() && is_mixed(scenario); ++i) {
    all[i].version = write::announced_version(dds_of(scenario, i).version.sizes);
  }
  return all;
}

}  // namespace

class CaptureProbe::Implementation {
 public:
  Implementation(Sink sink, const model::Scenario& scenario)
      : scenario_{scenario},
        traits_{model::traits_of(scenario.dds)},
        vendor_{vendor_of(scenario)},
        profiles_{scenario},
        identities_{identities_of(scenario, vendor_)},
        cyclone_{scenario, vendor_, identities_},
        of_server_{scenario, vendor_, identities_},
        pcap_{std::move(sink)} {
    for (const model::DdsProfile& dds : profiles_.different()) {
      layouts_.emplace_back(model::fastdds::deployed_profile(scenario, dds));
    }
  }

  void start(const model::Topology& topology) {
    topology_ = &topology;
    if (traits_.has_control_relations) control_.emplace(topology, scenario_);
  }

  /// A process counts from 1, also if it takes the GUID of the one before it.
  void start_anew(std::uint32_t participant) {
    std::erase_if(counts_, [&](const auto& count) { return count.first.first == participant; });
    of_server_.start_anew(participant);
  }

  void announce(const model::Packet& packet, std::uint32_t source) {
    announce(packet, source, write::discovery_group());
  }

  void send(const model::Packet& packet, std::uint32_t source, std::uint32_t destination) {
    switch (packet.kind) {
      case PacketKind::spdp_multicast:
      case PacketKind::spdp_unicast:
        return announce(packet, source, identities_[destination].metatraffic);
      case PacketKind::data:
      case PacketKind::heartbeat:
        return describe(packet, source, destination);
      case PacketKind::acknack:
        return acknowledge(packet, source, destination);
      case PacketKind::user_heartbeat:
      case PacketKind::user_acknack:
        return control(packet, source, destination);
      case PacketKind::lookup:
        return look_up(packet, source, destination);
      case PacketKind::rtps_message:
        return send_message(packet, source, destination);
      case PacketKind::registration:
      case PacketKind::registration_heartbeat:
      case PacketKind::registration_acknack:
      case PacketKind::relayed:
      case PacketKind::relayed_acknack:
        return put(packet, source, identities_[destination].metatraffic,
                   of_server_.message(packet, source, destination, time_of(packet)));
    }
  }

  /// Announcements to the group count nothing, and Cyclone DDS's messages say their counts
  /// themselves.
  void send_on_host(const model::Packet& packet, std::uint32_t receiver) {
    if (packet.multicast() || packet.kind == PacketKind::rtps_message) return;
    send(packet, topology_->pair(packet.pair).source, receiver);
  }

  /// An announcement to one of the ports of a host that nobody has, one after the other.
  void announce_to_nobody(const model::Packet& packet, std::uint32_t source) {
    const std::uint32_t somebody_there = topology_->pair(packet.pair).destination;
    UdpEnd to = identities_[somebody_there].metatraffic;
    const auto is_there = [&](const write::Identity& one) {
      return one.metatraffic.address == to.address;
    };
    const auto there = static_cast<std::uint32_t>(std::ranges::count_if(identities_, is_there));
    const std::uint32_t round = profiles_.of(source).peer_ports - there;
    const std::uint32_t port = there + unheard_[{source, to.address}]++ % round;
    to.port = write::metatraffic_port(port);
    announce(packet, source, to);
  }

  /// A message of Cyclone DDS, to the group if there is no destination.
  void send_message(const model::Packet& packet, std::uint32_t source,
                    std::optional<std::uint32_t> destination) {
    const auto datagram = cyclone_.datagram(packet, source, destination, time_of(packet));
    put(packet, source, datagram.to, datagram.payload);
  }

 private:
  [[nodiscard]] const write::PacketLayout& layout_of(std::uint32_t source) const {
    return layouts_[profiles_.number_of(source)];
  }
  [[nodiscard]] write::MessageWriter message(std::uint32_t source) const {
    return write::MessageWriter{vendor_, identities_[source].prefix};
  }

  void finish(write::MessageWriter& out, const model::Packet& packet, std::uint32_t source,
              const UdpEnd& to) {
    out.fill(std::min<std::size_t>(packet.payload_bytes, write::largest_payload));
    emit(out, packet, source, to);
  }

  /// What stays on a host is made, so that it is counted, but not written.
  void put(const model::Packet& packet, std::uint32_t source, const UdpEnd& to, Bytes payload) {
    const UdpEnd& from = identities_[source].metatraffic;
    if (from.address != to.address) pcap_.datagram(time_of(packet), from, to, payload);
  }

  void emit(const write::MessageWriter& out, const model::Packet& packet, std::uint32_t source,
            const UdpEnd& to) {
    put(packet, source, to, out.buffer());
  }

  [[nodiscard]] static std::int64_t time_of(const model::Packet& packet) {
    return simulated_epoch_ns + packet.emitted.count();
  }

  /// SPDP. An announcement goes to the group and to everybody known, so it names no destination;
  /// all are one sample.
  void announce(const model::Packet& packet, std::uint32_t source, const UdpEnd& to) {
    write::MessageWriter out = message(source);
    out.info_ts(time_of(packet));
    const std::size_t room = std::min<std::size_t>(packet.payload_bytes, write::largest_payload);
    const write::ParameterWriter parameters =
        write::participant_parameters(identities_[source], vendor_);
    out.data(entity::spdp_reader, entity::spdp_writer, 1, parameters,
             room > out.size() ? room - out.size() : 0);
    finish(out, packet, source, to);
  }

  /// SEDP DATA and HEARTBEATs. What does not fit in one datagram goes on in another.
  void describe(const model::Packet& packet, std::uint32_t source, std::uint32_t destination) {
    const write::PacketLayout& layout = layout_of(source);
    const bool is_directed = layout.names_destination(packet);
    const EntityId reader = is_directed ? write::sedp_reader(packet.stream) : 0;
    const EntityId writer = write::sedp_writer(packet.stream);
    const UdpEnd& to = identities_[destination].metatraffic;
    const auto begin = [&] {
      write::MessageWriter out = message(source);
      if (is_directed) out.info_dst(identities_[destination].prefix);
      return out;
    };
    write::MessageWriter out = begin();
    const std::size_t header = out.size();
    std::size_t sent = 0;  // in datagrams before this one
    const auto make_room = [&](std::size_t bytes) {
      if (out.size() + bytes <= write::largest_payload) return;
      sent += out.size();
      emit(out, packet, source, to);
      out = begin();
    };
    const std::uint32_t heartbeats = write::PacketLayout::heartbeats_in(packet);
    const std::size_t tail = heartbeats * write::MessageWriter::heartbeat_size;
    layout.for_each_data(packet, header, tail, [&](std::uint32_t d, std::size_t end) {
      const write::ParameterWriter parameters = write::endpoint_parameters(
          identities_[source], vendor_, packet.stream, d, name_of(packet.stream, d, source));
      make_room(write::MessageWriter::info_ts_size + write::smallest_data(parameters));
      out.info_ts(time_of(packet));
      const std::size_t at = sent + out.size();
      std::size_t room = write::largest_payload - out.size();
      if (room > tail) room -= tail;
      out.data(reader, writer, d + std::uint64_t{1}, parameters,
               std::min(end > at ? end - at : 0, room));
    });
    std::uint32_t count = first_count(packet, source, destination, is_directed, heartbeats);
    for (std::uint32_t k = 0; k < heartbeats; ++k) {
      make_room(write::MessageWriter::heartbeat_size);
      out.heartbeat(reader, writer, announced(packet), count++);
    }
    if (sent == 0) return finish(out, packet, source, to);
    emit(out, packet, source, to);
  }

  [[nodiscard]] write::TopicName name_of(Stream stream, std::uint32_t d,
                                         std::uint32_t source) const {
    const model::DescriptorProfile& descriptors = scenario_.dds.descriptors;
    const std::uint32_t defaults = stream == Stream::pub ? descriptors.default_publications
                                                         : descriptors.default_subscriptions;
    return write::topic_name(stream, d, defaults, identities_[source].name);
  }

  /// If all descriptors exist from the start, a HEARTBEAT does not say how many.
  [[nodiscard]] std::uint64_t announced(const model::Packet& packet) const {
    return traits_.creates_endpoints_over_time ? packet.detail
                                               : topology_->descriptor_count(packet.relation());
  }

  /// Of the HEARTBEATs in a packet; the copies of one message have the same.
  std::uint32_t first_count(const model::Packet& packet, std::uint32_t source,
                            std::uint32_t destination, bool is_directed, std::uint32_t heartbeats) {
    std::uint32_t& last = counts_[{source, write::sedp_writer(packet.stream)}];
    const bool is_copy = !is_directed && fan_out_.is_copy(packet, source, destination);
    if (!is_copy) last += heartbeats;
    return last - heartbeats + 1;
  }

  void acknowledge(const model::Packet& packet, std::uint32_t source, std::uint32_t destination) {
    const std::uint32_t all = topology_->descriptor_count(packet.relation());
    SequenceNumberSet missing;
    if (!packet.initial_acknack) {
      missing.base = 1 + std::int64_t{traits_.acknacks_have_bases
                                          ? packet.detail
                                          : std::min(packet.descriptors.lowest(), all)};
      packet.descriptors.for_each([&](std::uint32_t d) { write::ask(missing, d); });
    }
    const EntityId reader = write::sedp_reader(packet.stream);
    write::MessageWriter out = message(source);
    out.info_dst(identities_[destination].prefix);
    out.acknack(reader, write::sedp_writer(packet.stream), missing, ++counts_[{source, reader}],
                missing.num_bits == 0 && !packet.initial_acknack);
    finish(out, packet, source, identities_[destination].metatraffic);
  }

  /// Liveliness, user endpoints, and what looks up types. No sample of the former is modelled, so
  /// nothing has been written there; nobody asks for anything again.
  void control(const model::Packet& packet, std::uint32_t source, std::uint32_t destination) {
    const write::ControlTopics::Ends ends = control_->ends(packet);
    const write::Identity& to = identities_[destination];
    write::MessageWriter out = message(source);
    if (packet.kind == PacketKind::user_heartbeat) {
      const bool is_directed = packet.payload_bytes >= layout_of(source).heartbeat_bytes();
      if (is_directed) out.info_dst(to.prefix);
      out.heartbeat(is_directed ? ends.reader : 0, ends.writer, packet.last_sample(),
                    ++counts_[{source, ends.writer}]);
    } else {
      out.info_dst(to.prefix);
      SequenceNumberSet missing;
      missing.base = packet.initial_acknack ? 0 : 1 + std::int64_t{packet.last_sample()};
      out.acknack(ends.reader, ends.writer, missing, ++counts_[{source, ends.reader}],
                  !packet.initial_acknack);
    }
    finish(out, packet, source, ends.is_builtin ? to.metatraffic : to.user);
  }

  /// Questions about types, and answers. What they say is not modelled, so their DATA are empty and
  /// share the bytes of the message; it names its destination if there is no other participant.
  void look_up(const model::Packet& packet, std::uint32_t source, std::uint32_t destination) {
    const write::ControlTopics::Ends ends = control_->ends(packet);
    const write::Identity& to = identities_[destination];
    const bool is_directed = topology_->peer_count(source) == 1;
    const EntityId reader = is_directed ? ends.reader : 0;
    write::MessageWriter out = message(source);
    if (is_directed) out.info_dst(to.prefix);
    const std::size_t tail = packet.heartbeats * write::MessageWriter::heartbeat_size;
    const write::ParameterWriter nothing;
    for (std::uint32_t left = packet.samples(); left > 0; --left) {
      const std::size_t room = packet.payload_bytes - out.size() - tail;
      out.info_ts(time_of(packet));
      out.data(reader, ends.writer, packet.last_sample() + std::uint64_t{1} - left, nothing,
               room / left / 4 * 4 - write::MessageWriter::info_ts_size);
    }
    for (std::uint32_t k = 0; k < packet.heartbeats; ++k) {
      out.heartbeat(reader, ends.writer, packet.last_sample(), ++counts_[{source, ends.writer}]);
    }
    finish(out, packet, source, to.metatraffic);
  }

  const model::Scenario& scenario_;
  const model::ImplementationTraits& traits_;
  const VendorId vendor_;
  const model::Profiles profiles_;
  std::vector<write::PacketLayout> layouts_;  ///< by number of the profile
  const std::vector<write::Identity> identities_;
  const write::CycloneMessages cyclone_;
  write::ServerMessages of_server_;
  write::PcapWriter pcap_;
  const model::Topology* topology_ = nullptr;
  std::optional<write::ControlTopics> control_;
  write::FanOut fan_out_;
  /// Announcements to ports that nobody has, by participant and host.
  std::map<std::pair<std::uint32_t, Address>, std::uint32_t> unheard_;
  /// Of HEARTBEATs by writer, of ACKNACKs by reader: the last one sent.
  std::map<std::pair<std::uint32_t, EntityId>, std::uint32_t> counts_;
};

CaptureProbe::CaptureProbe(Sink sink, const model::Scenario& scenario)
    : implementation_{std::make_unique<Implementation>(std::move(sink), scenario)} {}

CaptureProbe::~CaptureProbe() = default;

void CaptureProbe::run_started(const model::Topology& topology) {
  implementation_->start(topology);
}

void CaptureProbe::event_started(const model::Event& event) {
  if (event.kind == model::EventKind::participant_start) implementation_->start_anew(event.subject);
}

void CaptureProbe::emitted(const model::Packet& packet, std::uint32_t source,
                           std::span<const std::uint32_t> destinations) {
  if (packet.to_group) return implementation_->send_message(packet, source, std::nullopt);
  if (packet.multicast()) implementation_->announce(packet, source);
  if (packet.to_nobody) implementation_->announce_to_nobody(packet, source);
  for (const std::uint32_t destination : destinations) {
    implementation_->send(packet, source, destination);
  }
}

void CaptureProbe::looped_back(const model::Packet& packet, std::uint32_t receiver) {
  implementation_->send_on_host(packet, receiver);
}

}  // namespace stormproof::capture
