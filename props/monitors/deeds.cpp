// Deeds in words.
#include "props/monitors/deeds.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "model/cyclone/endpoints.hpp"
#include "model/fastdds/endpoints.hpp"
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
    case Subject::endpoint_writer: {
      const std::uint32_t stride = model::cyclone::writers_per_participant(topology);
      return fmt::format("participant {}'s writer of {}", number / stride,
                         model::cyclone::name_of_writer(number % stride));
    }
    case Subject::endpoint_relation: {
      const std::uint32_t stride = model::cyclone::writers_per_participant(topology);
      const model::Pair& ends = topology.pair(number / stride);
      return fmt::format("participant {}'s {} at participant {}", ends.source,
                         model::cyclone::name_of_writer(number % stride), ends.destination);
    }
    case Subject::control_writer:
      return fmt::format(
          "participant {}'s writer of {}", number / model::fastdds::control_writers,
          model::fastdds::control_writer_names[number % model::fastdds::control_writers]);
    default:
      return fmt::format("control-only relation {}", number);
  }
}

std::string descriptors_text(const Descriptors& descriptors) {
  return fmt::format("descriptor{} {}", descriptors.size() == 1 ? "" : "s",
                     fmt::join(descriptors.list(), ", "));
}

const char* name_of(model::Submessage::Kind kind) {
  switch (kind) {
    case model::Submessage::Kind::spdp:
      return "announcement";
    case model::Submessage::Kind::data:
      return "DATA";
    case model::Submessage::Kind::heartbeat:
      return "HEARTBEAT";
    case model::Submessage::Kind::acknack:
      return "ACKNACK";
    case model::Submessage::Kind::gap:
      return "GAP";
  }
  return "";
}

/// Samples that it carries, lists or says are gone.
Descriptors samples_in(const model::Submessage& content) {
  using Kind = model::Submessage::Kind;
  Descriptors samples{content.bitmap};
  if (content.kind == Kind::data) samples.add(content.sample);
  for (std::uint32_t d = 0; d < content.first; ++d) samples.add(d);
  return samples;
}

/// "HEARTBEAT 3 of publications, directed, that announces 9"; an ACKNACK is about the receiver's.
std::string content_text(const model::Submessage& content) {
  using Kind = model::Submessage::Kind;
  if (content.kind == Kind::spdp) {
    return content.directed ? "a directed announcement" : "an announcement";
  }
  std::string text = name_of(content.kind);
  const bool is_counted = content.kind == Kind::heartbeat || content.kind == Kind::acknack;
  if (is_counted) text += fmt::format(" {}", content.count);
  text += " of " + model::cyclone::name_of_writer(content.writer);
  if (content.initial) text += ", pre-emptive,";
  if (content.directed) text += ", directed,";
  if (content.kind == Kind::heartbeat) text += fmt::format(" that announces {}", content.sample);
  if (content.kind == Kind::acknack) text += fmt::format(" that confirms {}", content.sample);
  const Descriptors samples = samples_in(content);
  if (samples.empty()) return text;
  return text + (content.kind == Kind::acknack ? " and asks for " : " with ") +
         descriptors_text(samples);
}

std::string contents_text(const Message& message, const model::Topology& topology) {
  std::string text =
      fmt::format("a message of {} bytes of participant {} to ", message.bytes,
                  message.to_group ? message.pair : topology.pair(message.pair).source);
  text += message.to_group ? std::string{"the group"}
                           : fmt::format("participant {}", topology.pair(message.pair).destination);
  if (message.loops_to != UINT32_MAX) text += fmt::format(" at participant {}", message.loops_to);
  const char* separator = " with ";
  for (const model::Submessage& content : *message.contents.of) {
    text += std::exchange(separator, "; ") + content_text(content);
  }
  return text + " is sent";
}

/// "publication 3 of participant 2 as number 7, a HEARTBEAT for 4 to 9".
std::string relayed_text(const model::Relayed& relayed, bool asks) {
  std::vector<std::string> parts;
  if (asks) parts.push_back(fmt::format("base {}", relayed.base));
  if (relayed.has_data && relayed.is_announcement) {
    parts.push_back(fmt::format("the {} of participant {} as number {}",
                                relayed.is_goodbye ? "goodbye" : "announcement",
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

}  // namespace

std::string said(const Message& message, const model::Topology& topology) {
  if (message.contents.of != nullptr) return contents_text(message, topology);
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
    case lookup:
      text += fmt::format(" of control-only relation {}", message.detail);
      if (message.samples > 0) text += fmt::format(" with {} samples", message.samples);
      if (message.last_sample > 0) text += fmt::format(" up to number {}", message.last_sample);
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

namespace {

bool is_of_control(model::PacketKind kind) {
  return kind == model::PacketKind::user_heartbeat || kind == model::PacketKind::user_acknack ||
         kind == model::PacketKind::lookup;
}
/// A HEARTBEAT rides in it.
bool carries_heartbeat(const model::Packet& packet) {
  return packet.carries_heartbeat ||
         (packet.kind == model::PacketKind::lookup && packet.heartbeats > 0);
}

bool is_same(const model::Submessage& one, const model::Submessage& other) {
  return one.kind == other.kind && one.directed == other.directed && one.initial == other.initial &&
         one.participant == other.participant && one.writer == other.writer &&
         one.sample == other.sample && one.first == other.first && one.goodbye == other.goodbye &&
         one.count == other.count && Descriptors{one.bitmap}.are(other.bitmap);
}

}  // namespace

bool Message::is_of_control() const { return props::is_of_control(kind); }

bool Message::says_what(const Message& other) const {
  return kind == other.kind && stream == other.stream && detail == other.detail &&
         initial == other.initial && repair == other.repair &&
         carries_heartbeat == other.carries_heartbeat && to_nobody == other.to_nobody &&
         to_group == other.to_group && loops_to == other.loops_to && bytes == other.bytes &&
         samples == other.samples && last_sample == other.last_sample &&
         descriptors == other.descriptors && contents == other.contents && relayed == other.relayed;
}

bool Message::says_what(const model::Packet& packet) const {
  return kind == packet.kind && stream == packet.stream && detail == packet.detail &&
         initial == packet.initial_acknack && repair == packet.from_repair &&
         carries_heartbeat == props::carries_heartbeat(packet) && to_nobody == packet.to_nobody &&
         (!is_of_control() ||
          (samples == packet.samples() && last_sample == packet.last_sample())) &&
         !packet.multicast() && packet.submessages == nullptr && packet.relayed == nullptr &&
         descriptors.are(packet.descriptors);
}

bool SentContents::operator==(const SentContents& other) const {
  if (of == nullptr || other.of == nullptr || of == other.of) return of == other.of;
  return std::ranges::equal(*of, *other.of, is_same);
}

bool RelayedContents::operator==(const RelayedContents& other) const {
  if (of == nullptr || other.of == nullptr) return of == other.of;
  return *of == *other.of;
}

Message message_of(const model::Packet& packet) {
  Message message;
  message.kind = packet.kind;
  if (message.is_of_control()) {
    message.samples = packet.samples();
    message.last_sample = packet.last_sample();
  } else {
    message.pair = packet.pair;
  }
  message.stream = packet.stream;
  message.descriptors = Descriptors{packet.descriptors};
  message.detail = packet.detail;
  message.initial = packet.initial_acknack;
  message.repair = packet.from_repair;
  message.carries_heartbeat = carries_heartbeat(packet);
  message.to_nobody = packet.to_nobody;
  message.to_group = packet.to_group;
  if (packet.submessages != nullptr) {
    message.bytes = packet.payload_bytes;
    message.contents.of = packet.submessages;
  }
  message.relayed.of = packet.relayed;
  return message;
}

std::string said(const Move& move, const model::Topology& topology) {
  Descriptors descriptors;
  descriptors.add(move.first_word, move.descriptors);
  return fmt::format(
      "{} of {}{} goes from {} to {} on {}", move.machine.machine,
      descriptors.empty() ? "" : descriptors_text(descriptors) + " of ",
      subject_text(topology, model::trace::subject_of(move.machine.kind), move.machine.subject),
      move.before, move.after, move.event);
}

std::string said(const Scheduled& event, const model::Topology& topology) {
  return fmt::format("{} of {} is scheduled for {}", name_of(event.kind),
                     subject_text(topology, model::trace::subject_of(event.kind), event.subject),
                     time_text(event.time));
}

void Deeds::add(const model::Packet& packet, std::uint32_t pair, std::uint32_t loops_to) {
  if (is_of_control(packet.kind)) pair = 0;
  auto& messages = list_of<Message>();
  const bool goes_on =
      !order_.empty() && order_.back().tag == Tag::message && messages.back().says_what(packet);
  if (!goes_on) {
    const auto number = static_cast<std::uint32_t>(messages.size());
    order_.push_back({Tag::message, number, static_cast<std::uint32_t>(pairs_.size())});
    Message& message = messages.emplace_back(message_of(packet));
    message.pair = pair;
    message.loops_to = loops_to;
  }
  add_copy(pair);
}

std::size_t Deeds::pass(Position& from, const Message& message,
                        std::span<const std::uint32_t> pairs) const {
  const Message* sent = nullptr;
  std::span<const std::uint32_t> to;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (sent == nullptr) {
      sent = at<Message>(from.deed);
      if (sent == nullptr || !sent->says_what(message)) return k;
      to = pairs_of(from.deed);
    }
    const bool in_order = from.crossing <= from.taken && from.looped <= from.taken;
    if (in_order && to[from.taken] == pairs[k]) {
      from.crossing = from.looped = from.taken + 1;
    } else {
      const bool crosses_hosts = crosses(message, pairs[k]);
      std::uint32_t& behind = crosses_hosts ? from.crossing : from.looped;
      while (behind < to.size() && crosses(message, to[behind]) != crosses_hosts) ++behind;
      if (behind == to.size() || to[behind] != pairs[k]) return k;
      ++behind;
    }
    if (++from.taken < to.size()) continue;
    from = {from.deed + 1};
    sent = nullptr;
  }
  return pairs.size();
}

std::string Deeds::next_in_words() const {
  if (const Move* move = next<Move>()) return said(*move, topology_);
  if (const Scheduled* event = next<Scheduled>()) return said(*event, topology_);
  if (empty()) return "nothing more happens";
  Message message = *next<Message>();
  const auto pairs = pairs_of(next_.deed);
  const auto is_behind = [&](std::size_t k) {
    return k < (crosses(message, pairs[k]) ? next_.crossing : next_.looped);
  };
  std::size_t first = 0;
  while (is_behind(first)) ++first;
  message.pair = pairs[first];
  return said(message, topology_);
}

}  // namespace stormproof::props
