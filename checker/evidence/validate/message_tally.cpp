// One message after the other.
#include "checker/evidence/validate/message_tally.hpp"

#include <algorithm>
#include <bit>

namespace stormproof::validate {

namespace {

using model::EventKind;
using model::MessageClass;
using model::PacketKind;

std::uint64_t members(const model::DescriptorSet& set) {
  std::uint64_t count = 0;
  if (set.empty()) return count;
  for (std::uint32_t k = set.first_word(); k < set.end_word(); ++k) {
    count += static_cast<std::uint64_t>(std::popcount(set.word(k)));
  }
  return count;
}

/// Why a HEARTBEAT without DATA is sent, from what the participant is doing.
Figure reason(EventKind event, std::optional<PacketKind> incoming) {
  switch (event) {
    case EventKind::heartbeat_expiry:
    case EventKind::cycle_start:
    case EventKind::cycle_end:
    case EventKind::batch_due:
      return Figure::heartbeat_periodic;
    default:
      return incoming == PacketKind::acknack ? Figure::heartbeat_reply : Figure::heartbeat_open;
  }
}

}  // namespace

void MessageTally::event_started(const model::Event& event) {
  now_ns_ = event.time.count();
  event_ = event.kind;
  incoming_.reset();
  fill_growth(now_ns_);
}

void MessageTally::event_finished(const model::Depths&) {
  if (!emitted_initial_) return;
  emitted_initial_ = false;
  at_last_initial_ = tally_;
  at_last_initial_[index_of(Figure::completion)] = static_cast<std::uint64_t>(now_ns_);
}

void MessageTally::received(const model::Packet& packet, std::uint32_t) { incoming_ = packet.kind; }

void MessageTally::emitted(const model::Packet& packet, std::uint32_t,
                           std::span<const std::uint32_t> destinations) {
  const std::uint64_t copies =
      packet.multicast() ? 1 : std::max<std::uint64_t>(packet.copies, destinations.size());
  if (packet.kind == PacketKind::user_heartbeat || packet.kind == PacketKind::user_acknack) {
    tally_[index_of(Figure::user_control)] += copies;
    return;
  }
  tally_[index_of(Figure::datagrams)] += copies;
  tally_[index_of(Figure::payload_bytes)] += copies * packet.payload_bytes;
  switch (packet.kind) {
    case PacketKind::spdp_multicast:
    case PacketKind::spdp_unicast: {
      const MessageClass one =
          packet.multicast() ? MessageClass::spdp_multicast : MessageClass::spdp_unicast;
      add(tally_, one, copies);
      sizes_[static_cast<std::size_t>(one)][packet.payload_bytes] += copies;
      break;
    }
    case PacketKind::data:
      add_data(packet);
      add_heartbeats(packet, 0);
      break;
    case PacketKind::heartbeat:
      add_heartbeats(packet, copies);
      break;
    default:
      add_acknack(packet);
      break;
  }
}

void MessageTally::add_data(const model::Packet& packet) {
  std::uint64_t initial = 0;
  packet.descriptors.for_each([&](std::uint32_t d) {
    if (!generated_.test(packet.relation(), d)) ++initial;
  });
  const std::uint64_t repairs = members(packet.descriptors) - initial;
  generated_.add(packet.relation(), packet.descriptors);
  add(tally_, MessageClass::initial_data, initial);
  add(tally_, MessageClass::repair_data, repairs);
  const bool is_pulled = event_ == EventKind::async_run || packet.from_repair;
  if (is_pulled) tally_[index_of(Figure::initial_pulled)] += initial;
  if (initial > 0) {
    emitted_initial_ = true;
    tally_[index_of(Figure::last_initial)] = static_cast<std::uint64_t>(now_ns_);
  }
  const auto note = [&](MessageClass one, std::uint64_t messages) {
    if (messages == 1) ++sizes_[static_cast<std::size_t>(one)][packet.payload_bytes];
  };
  note(MessageClass::initial_data, initial);
  note(MessageClass::repair_data, repairs);
}

/// Those that ride in a message are there because of DATA, even if the DATA went to others.
void MessageTally::add_heartbeats(const model::Packet& packet, std::uint64_t copies) {
  const std::uint64_t riding = packet.heartbeats;
  const std::uint64_t messages = std::max(copies, riding);
  if (messages == 0) return;
  add(tally_, MessageClass::heartbeat, messages);
  const Figure kind = riding > 0 ? Figure::heartbeat_piggyback : reason(event_, incoming_);
  tally_[index_of(kind)] += messages;
  if (kind == Figure::heartbeat_open) {
    tally_[index_of(Figure::last_open)] = static_cast<std::uint64_t>(now_ns_);
  }
  const std::uint64_t in_each = std::max<std::uint64_t>(riding, 1);
  if (in_each == 1) {
    sizes_[model::index_of(MessageClass::heartbeat)][packet.payload_bytes] += messages;
  }
}

void MessageTally::add_acknack(const model::Packet& packet) {
  add(tally_, MessageClass::acknack);
  // As in a capture, what decides is what it says, not which timer sent it.
  const bool is_initial = packet.initial_acknack || (acknacks_have_bases_ && packet.detail == 0);
  const Figure kind = !packet.descriptors.empty() ? Figure::acknack_negative
                      : is_initial                ? Figure::acknack_initial
                                                  : Figure::acknack_positive;
  ++tally_[index_of(kind)];
  ++sizes_[model::index_of(MessageClass::acknack)][packet.payload_bytes];
}

/// Steps that end before `until_ns` have all their messages.
void MessageTally::fill_growth(std::int64_t until_ns) {
  while (growth_.points.size() < steps_ &&
         static_cast<std::int64_t>(growth_.points.size() + 1) * growth_.step_ns < until_ns) {
    growth_.points.push_back(growth_point(tally_));
  }
}

Growth MessageTally::finish() && {
  growth_.points.resize(steps_, growth_point(tally_));
  return std::move(growth_);
}

}  // namespace stormproof::validate
