// The rules that all implementations share, each as its machine decides it.
#include "model/engine/discovery_base.hpp"

namespace stormproof::model {

namespace reader = fsm::discovery_reader;

DiscoveryBase::DiscoveryBase(RunState& run, Network& network, Multicast multicast,
                             bool accepts_unmatched)
    : run_{run},
      network_{network},
      spdp_{run.scenario.dds.spdp},
      sedp_{run.scenario.dds.sedp},
      heartbeats_{run, *this},
      announcements_{run},
      multicast_{multicast},
      accepts_unmatched_{accepts_unmatched},
      initial_attempts_{run, MachineRef::Kind::relation, EventKind::initial_acknack_due},
      reader_driver_{run, MachineRef::Kind::relation} {}

void DiscoveryBase::handle(const Event& event) {
  switch (event.kind) {
    case EventKind::announcement_due:
      announcements_.due(event.subject, [&] { send_spdp(event.subject); });
      break;
    case EventKind::acknack_generation:
      acknack_generation(event.subject);
      break;
    case EventKind::initial_acknack_due:
      initial_acknack_due(event.subject);
      break;
    default:
      heartbeats_.handle(event);
      break;
  }
}

void DiscoveryBase::send_spdp(std::uint32_t i) {
  if (multicast_ == Multicast::first) send_spdp_multicast(i);
  send_spdp_to_known(i);
  if (multicast_ == Multicast::last) send_spdp_multicast(i);
}

void DiscoveryBase::resend(std::uint32_t reverse_pair) {
  const std::uint32_t j = run_.topology.pair(reverse_pair).source;
  switch (spdp_.resend) {
    case SpdpResend::all_known:
      send_spdp(j);
      break;
    case SpdpResend::new_and_multicast:
      if (multicast_ == Multicast::first) send_spdp_multicast(j);
      send_spdp_copy(reverse_pair);
      if (multicast_ == Multicast::last) send_spdp_multicast(j);
      break;
    case SpdpResend::new_only:
      send_spdp_copy(reverse_pair);
      break;
    case SpdpResend::none:
      break;
  }
}

template <class ReaderEvent>
Driver<fsm::DiscoveryReader>::Output DiscoveryBase::step(std::uint32_t relation, ReaderSide& side,
                                                         std::uint32_t missing_after) {
  return reader_driver_.step<ReaderEvent>(
      run_, side.reader, {.accepts_unmatched = accepts_unmatched_, .missing_after = missing_after},
      relation);
}

void DiscoveryBase::open_reader(std::uint32_t relation) {
  ReaderSide& side = reader_side(relation);
  const auto output = step<reader::AnnouncementReceived>(relation, side, side.missing);
  if (output.opened) initial_attempts_.open(side.initial, relation);
}

bool DiscoveryBase::takes_data(std::uint32_t relation, std::uint32_t missing_after) {
  return step<reader::DataReceived>(relation, reader_side(relation), missing_after).take_data;
}

bool DiscoveryBase::sees_heartbeat(std::uint32_t relation) {
  ReaderSide& side = reader_side(relation);
  const auto output = step<reader::HeartbeatReceived>(relation, side, side.missing);
  if (output.schedule_acknack) side.heartbeat_seen = true;
  return output.schedule_acknack;
}

void DiscoveryBase::acknack_generation(std::uint32_t relation) {
  ReaderSide& side = reader_side(relation);
  const auto output = step<reader::AckNackDue>(relation, side, side.missing);
  if (output.send_acknack) emit_acknack(relation, false);
}

void DiscoveryBase::initial_acknack_due(std::uint32_t relation) {
  ReaderSide& side = reader_side(relation);
  initial_attempts_.attempt(side.initial, side.heartbeat_seen, relation, [&] {
    const auto output = step<reader::InitialAckNackDue>(relation, side, side.missing);
    if (output.send_initial) emit_acknack(relation, true);
  });
}

void DiscoveryBase::note_last_delivery(std::uint32_t relation, std::uint32_t descriptor) {
  run_.last_delivered = {ParticipantId{ends(relation).source},
                         ParticipantId{ends(relation).destination}, stream_of(relation),
                         DescriptorId{descriptor}};
}

Packet DiscoveryBase::packet_of(PacketKind kind, std::uint32_t pair, std::int64_t payload_bytes) {
  Packet packet;
  packet.kind = kind;
  packet.pair = pair;
  packet.payload_bytes = static_cast<std::uint32_t>(payload_bytes);
  return packet;
}

Packet DiscoveryBase::packet_on(PacketKind kind, std::uint32_t relation,
                                std::int64_t payload_bytes) {
  Packet packet = packet_of(kind, relation / 2, payload_bytes);
  packet.stream = stream_of(relation);
  return packet;
}

}  // namespace stormproof::model
