// Deeds in words.
#include "props/monitors/deeds.hpp"

#include <array>
#include <bit>
#include <vector>

#include <fmt/format.h>

#include "model/fastdds/relayed.hpp"
#include "model/trace/event_subject.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::props {

namespace {

using model::trace::Subject;

std::string subject_text(const model::Topology& topology, Subject subject, std::uint32_t number) {
  switch (subject) {
    case Subject::relation:
      return relation_text(topology, number);
    case Subject::writer:
      return writer_text(number);
    case Subject::participant:
      return fmt::format("participant {}", number);
    case Subject::pair:
      return fmt::format("participant {} at participant {}", topology.pair(number).source,
                         topology.pair(number).destination);
    default:
      return fmt::format("control-only relation {}", number);
  }
}

std::string descriptors_text(const DescriptorList& descriptors) {
  return fmt::format("descriptor{} {}", descriptors.size() == 1 ? "" : "s",
                     fmt::join(descriptors, ", "));
}

std::string move_text(const Move& move, const model::Topology& topology) {
  DescriptorList descriptors;
  for (std::uint64_t left = move.descriptors; left != 0; left &= left - 1) {
    descriptors.push_back(64 * move.first_word +
                          static_cast<std::uint32_t>(std::countr_zero(left)));
  }
  return fmt::format(
      "{} of {}{} goes from {} to {} on {}", move.machine.machine,
      descriptors.empty() ? "" : descriptors_text(descriptors) + " of ",
      subject_text(topology, model::trace::subject_of(move.machine.kind), move.machine.subject),
      move.before, move.after, move.event);
}

/// "publication 3 of participant 2 as number 7, a HEARTBEAT for 4 to 9".
std::string relayed_text(const model::Relayed& relayed, bool asks) {
  std::vector<std::string> parts;
  if (asks) parts.push_back(fmt::format("base {}", relayed.base));
  if (relayed.has_data && relayed.is_announcement) {
    parts.push_back(fmt::format("the announcement of participant {} as number {}",
                                relayed.participant, relayed.number));
  } else if (relayed.has_data) {
    parts.push_back(fmt::format("{} descriptor {} of participant {} as number {}",
                                relayed.stream == model::Stream::pub ? "pub" : "sub",
                                relayed.descriptor, relayed.participant, relayed.number));
  }
  if (!relayed.numbers.empty()) {
    parts.push_back(fmt::format("{} {}", asks ? "a request for" : "a GAP of",
                                fmt::join(relayed.numbers, ", ")));
  }
  if (relayed.has_heartbeat) {
    parts.push_back(fmt::format("a HEARTBEAT for {} to {}", relayed.first, relayed.last));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Of a packet between the server and a client.
std::string server_message_text(const Message& message, const model::Topology& topology) {
  constexpr std::array relays{"announcements", "publications", "subscriptions"};
  const model::Pair& ends = topology.pair(message.pair);
  std::string text = fmt::format("{} between participants {} and {}{}", name_of(message.kind),
                                 ends.source, ends.destination, message.initial ? ", initial" : "");
  if (message.relayed.of != nullptr) {
    const bool asks = message.kind == model::PacketKind::relayed_acknack;
    text += fmt::format(" ({}: {})", relays.at(message.detail),
                        relayed_text(*message.relayed.of, asks));
  }
  return text + " is sent";
}

std::string message_text(const Message& message, const model::Topology& topology) {
  using enum model::PacketKind;
  std::string text = name_of(message.kind);
  switch (message.kind) {
    case spdp_multicast:
      text += fmt::format(" of participant {}", message.pair);
      break;
    case spdp_unicast:
      text +=
          fmt::format(" of participant {} to {}participant {}", topology.pair(message.pair).source,
                      message.to_nobody ? "a port that nobody has on the host of " : "",
                      topology.pair(message.pair).destination);
      break;
    case registration:
    case registration_heartbeat:
    case registration_acknack:
    case relayed:
    case relayed_acknack:
      return server_message_text(message, topology);
    case user_heartbeat:
    case user_acknack:
      text += fmt::format(" of control-only relation {}", message.detail);
      break;
    default:
      text += " of " + relation_text(topology, message.relation());
  }
  if (message.initial) text += ", initial,";
  if (message.repair) text += ", a repair,";
  if (!message.descriptors.empty()) text += " with " + descriptors_text(message.descriptors);
  if (message.carries_heartbeat) text += " and a HEARTBEAT";
  const bool announces = message.carries_heartbeat || message.kind == heartbeat;
  if (announces && message.detail > 0) text += fmt::format(" that announces {}", message.detail);
  return text + " is sent";
}

}  // namespace

bool RelayedContents::operator==(const RelayedContents& other) const {
  if (of == nullptr || other.of == nullptr) return of == other.of;
  return *of == *other.of;
}

Message message_of(const model::Packet& packet) {
  Message message;
  message.kind = packet.kind;
  const bool control = packet.kind == model::PacketKind::user_heartbeat ||
                       packet.kind == model::PacketKind::user_acknack;
  message.pair = control ? 0 : packet.pair;
  message.stream = packet.stream;
  if (!packet.descriptors.empty()) {
    packet.descriptors.for_each([&](std::uint32_t d) { message.descriptors.push_back(d); });
  }
  message.detail = packet.detail;
  message.initial = packet.initial_acknack;
  message.repair = packet.from_repair;
  message.carries_heartbeat = packet.carries_heartbeat;
  message.to_nobody = packet.to_nobody;
  message.relayed.of = packet.relayed;
  return message;
}

std::string said(const Deed& deed, const model::Topology& topology) {
  if (const Move* move = std::get_if<Move>(&deed)) return move_text(*move, topology);
  if (const Message* message = std::get_if<Message>(&deed)) return message_text(*message, topology);
  const Scheduled& event = std::get<Scheduled>(deed);
  return fmt::format("{} of {} is scheduled for {}", name_of(event.kind),
                     subject_text(topology, model::trace::subject_of(event.kind), event.subject),
                     time_text(event.time));
}

}  // namespace stormproof::props
