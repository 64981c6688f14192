// Takes datagrams together that are copies of one message.
#include "checker/evidence/conform/messages.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "checker/evidence/conform/requests.hpp"
#include "checker/evidence/conform/words.hpp"

namespace stormproof::conform {

namespace {

/// A datagram as a message of one copy.
Message copy_of(const Dialogue& dialogue, std::size_t relation, const Submessage& first) {
  const auto& conversation = dialogue.conversation;
  Message copy;
  copy.writer = dialogue.relations[relation].place.writer;
  copy.time_ns = first.time_ns;
  copy.payload_bytes = conversation.datagrams[first.datagram].payload_bytes;
  copy.is_named = conversation.events[first.event].has_info_dst;
  copy.relations = {relation};
  copy.first_event = {first.event};
  return copy;
}

void collect(const Dialogue& dialogue, std::size_t relation, std::vector<Message>& copies) {
  const Relation& from = dialogue.relations[relation];
  const std::vector<Transmission> transmissions = transmissions_of(from);
  auto next = transmissions.begin();
  std::optional<std::uint32_t> datagram;
  for (const Submessage& one : from.sent) {
    if (datagram != one.datagram) copies.push_back(copy_of(dialogue, relation, one));
    datagram = one.datagram;
    Message& copy = copies.back();
    if (one.descriptor) copy.is_pushed |= (next++)->is_pushed;
    copy.parts.push_back({one.event, one.descriptor, one.heartbeat ? one.heartbeat->count : 0,
                          dialogue.conversation.events[one.event].bytes});
  }
}

bool same_content(const Message& a, const Message& b) {
  return a.payload_bytes == b.payload_bytes &&
         std::ranges::equal(a.parts, b.parts, [](const MessagePart& x, const MessagePart& y) {
           return x.descriptor == y.descriptor && x.count == y.count;
         });
}

bool is_asked_for(const Message& message) { return message.has_data() && !message.is_pushed; }

bool can_be_copy(const Message& message, const Message& copy) {
  return !message.is_named && !copy.is_named &&
         std::ranges::find(message.relations, copy.relations.front()) == message.relations.end() &&
         same_content(message, copy);
}

}  // namespace

bool Message::has_data() const {
  return std::ranges::any_of(parts,
                             [](const MessagePart& part) { return part.descriptor.has_value(); });
}

std::vector<Message> messages_of(const Dialogue& dialogue, std::size_t participant,
                                 const Bounds& bounds) {
  std::vector<Message> copies;
  for (std::size_t r = 0; r < dialogue.relations.size(); ++r) {
    const Place& place = dialogue.relations[r].place;
    if (place.source != participant) continue;
    if (kind_of(dialogue, place) == RelationKind::descriptors) collect(dialogue, r, copies);
  }
  std::ranges::sort(copies, {}, [](const Message& one) { return one.first_event.front(); });
  const std::int64_t same_instant = capture_resolution_ns - 1;
  const std::int64_t within = std::min(copies_within_ns, bounds.most_send_lag_ns + same_instant);
  std::vector<Message> messages;
  /// By writer: its last message, and when its last copy was captured.
  std::map<capture::EntityId, std::pair<std::size_t, std::int64_t>> last;
  for (Message& copy : copies) {
    const auto known = last.find(copy.writer);
    copy.may_be_copy = known != last.end() && can_be_copy(messages[known->second.first], copy);
    if (copy.may_be_copy && copy.time_ns - known->second.second <= within) {
      Message& message = messages[known->second.first];
      // What was just created is pushed once; what is asked for may be sent twice.
      const bool is_once = !is_asked_for(copy) || !is_asked_for(message);
      if (!is_once && copy.time_ns - known->second.second > same_instant) ++message.most;
      message.relations.push_back(copy.relations.front());
      message.first_event.push_back(copy.first_event.front());
      message.is_pushed |= copy.is_pushed;
      known->second.second = copy.time_ns;
      continue;
    }
    last[copy.writer] = {messages.size(), copy.time_ns};
    messages.push_back(std::move(copy));
  }
  return messages;
}

}  // namespace stormproof::conform
