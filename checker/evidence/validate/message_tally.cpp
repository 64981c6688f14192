// One message after the other.
#include "checker/evidence/validate/message_tally.hpp"

#include <algorithm>
#include <bit>

#include "model/cyclone/endpoints.hpp"

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
  if (packet.kind == PacketKind::rtps_message) return add_message(packet);
  const std::uint64_t copies =
      packet.multicast() ? 1 : std::max<std::uint64_t>(packet.copies, destinations.size());
  if (packet.kind == PacketKind::user_heartbeat || packet.kind == PacketKind::user_acknack) {
    tally_[index_of(Figure::user_control)] += copies;
    return;
  }
  if (packet.kind == PacketKind::lookup) {
    if (packet.heartbeats > 0) tally_[index_of(Figure::user_control)] += copies;
    return;
  }
  if (add_of_server(packet)) return;
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
    if (is_needed(packet)) emitted_initial_ = true;
    note_initial();
  }
  const auto note = [&](MessageClass one, std::uint64_t messages) {
    if (messages == 1) ++sizes_[static_cast<std::size_t>(one)][packet.payload_bytes];
  };
  note(MessageClass::initial_data, initial);
  note(MessageClass::repair_data, repairs);
}

void MessageTally::note_initial() {
  tally_[index_of(Figure::last_initial)] = static_cast<std::uint64_t>(now_ns_);
}

/// One copy of a message of Cyclone DDS: each submessage counts by itself. Why a HEARTBEAT is sent
/// is not told apart.
void MessageTally::add_message(const model::Packet& packet) {
  std::array<std::uint32_t, model::message_class_count> in_it{};
  for (const model::Submessage& m : *packet.submessages) {
    const auto one = add_submessage(m, packet);
    if (!one) continue;
    add(tally_, *one);
    ++in_it[model::index_of(*one)];
  }
  if (std::ranges::count(in_it, 0U) == std::ssize(in_it)) return;
  ++tally_[index_of(Figure::datagrams)];
  tally_[index_of(Figure::payload_bytes)] += packet.payload_bytes;
  for (std::size_t k = 0; k < in_it.size(); ++k) {
    if (in_it[k] == 1) ++sizes_[k][packet.payload_bytes];
  }
}

/// The class of a submessage, if it has one of the six.
std::optional<MessageClass> MessageTally::add_submessage(const model::Submessage& m,
                                                         const model::Packet& packet) {
  using Kind = model::Submessage::Kind;
  namespace writer = model::cyclone::writer;
  if (m.kind == Kind::spdp) {
    return packet.multicast() ? MessageClass::spdp_multicast : MessageClass::spdp_unicast;
  }
  if (m.writer > writer::subscriptions) {
    if (m.kind != Kind::data) ++tally_[index_of(Figure::user_control)];
    return std::nullopt;
  }
  if (m.kind == Kind::gap) return std::nullopt;
  if (m.kind == Kind::heartbeat) return MessageClass::heartbeat;
  if (m.kind == Kind::data) return add_sample(m, packet);
  const std::uint32_t from_writer = topology_->pair(packet.pair).reverse;
  m.bitmap.for_each([&](std::uint32_t d) { requested_.insert({from_writer, m.writer, d}); });
  ++tally_[index_of(!m.bitmap.empty() ? Figure::acknack_negative
                    : m.sample == 0   ? Figure::acknack_initial
                                      : Figure::acknack_positive)];
  return MessageClass::acknack;
}

MessageClass MessageTally::add_sample(const model::Submessage& m, const model::Packet& packet) {
  const Key key{packet.pair, m.writer, m.sample};
  const auto reaches = [&](std::uint32_t pair) {
    if (reached_.insert({pair, m.writer, m.sample}).second) emitted_initial_ = true;
  };
  if (packet.multicast()) {
    const std::uint32_t end = topology_->first_pair(m.participant + 1);
    for (std::uint32_t pair = topology_->first_pair(m.participant); pair < end; ++pair) {
      if (topology_->pair(pair).cross_host) reaches(pair);
    }
  } else {
    reaches(packet.pair);
  }
  auto& sent = packet.multicast() ? sent_to_group_ : sent_to_one_;
  if (!sent.insert(key).second) return MessageClass::repair_data;
  if (!packet.multicast() && requested_.contains(key)) {
    ++tally_[index_of(Figure::initial_pulled)];
  }
  note_initial();
  return MessageClass::initial_data;
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
  // As in a capture, what decides is what it says, not which timer sent it.
  const bool is_initial = packet.initial_acknack || (acknacks_have_bases_ && packet.detail == 0);
  add_acknack(packet, !packet.descriptors.empty(), is_initial);
}

void MessageTally::add_acknack(const model::Packet& packet, bool asks, bool is_initial) {
  add(tally_, MessageClass::acknack);
  const Figure kind = asks         ? Figure::acknack_negative
                      : is_initial ? Figure::acknack_initial
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
