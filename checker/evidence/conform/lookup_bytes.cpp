// Adds up the messages of the TypeLookup writers, copies once.
#include "checker/evidence/conform/lookup_bytes.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <tuple>

#include "checker/evidence/conform/messages.hpp"

namespace stormproof::conform {

namespace {

using capture::Event;
using capture::Traffic;

bool is_sample(const Event& event) {
  return event.traffic() == Traffic::type_lookup && event.data() != nullptr;
}

/// Whether some participant's types can be looked up.
bool has_type_information(const capture::Topology& topology) {
  return std::ranges::any_of(topology.participants, [](const capture::Participant& one) {
    return std::ranges::any_of(
        one.endpoints, [](const auto& endpoint) { return endpoint.second.has_type_information; });
  });
}

/// Whether a participant's samples are numbered as if all are there, as far as it has announced.
bool are_all_shown(const capture::Conversation& conversation, const capture::GuidPrefix& self) {
  std::map<capture::EntityId, std::set<std::int64_t>> shown;
  std::map<capture::EntityId, std::int64_t> last;
  for (const Event& event : conversation.events) {
    if (event.source != self || event.traffic() != Traffic::type_lookup) continue;
    if (const auto* data = event.data()) {
      shown[event.writer].insert(data->sequence_number);
      last[event.writer] = std::max(last[event.writer], data->sequence_number);
    } else if (const auto* heartbeat = event.heartbeat()) {
      last[event.writer] = std::max(last[event.writer], heartbeat->last);
    }
  }
  return std::ranges::all_of(last, [&](const auto& one) {
    return one.second <= static_cast<std::int64_t>(shown[one.first].size());
  });
}

}  // namespace

LookupBytes::LookupBytes(const Dialogue& dialogue, std::size_t participant) {
  const capture::Conversation& conversation = dialogue.conversation;
  const capture::GuidPrefix& self = conversation.topology.participants[participant].prefix;
  is_known_ = std::ranges::any_of(conversation.events, is_sample)
                  ? are_all_shown(conversation, self)
                  : !has_type_information(conversation.topology);
  // A message: its writer, the number of its first sample, its size; and its last copy's capture.
  std::map<std::tuple<capture::EntityId, std::int64_t, std::uint32_t>, std::int64_t> known;
  std::optional<std::uint32_t> datagram;
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < conversation.events.size(); ++k) {
    const Event& event = conversation.events[k];
    if (event.source != self || !is_sample(event) || datagram == event.datagram) continue;
    datagram = event.datagram;
    const std::uint32_t bytes = conversation.datagrams[event.datagram].payload_bytes;
    const auto [last, is_new] =
        known.try_emplace({event.writer, event.data()->sequence_number, bytes}, event.time_ns);
    const bool is_copy = !is_new && event.time_ns - last->second <= copies_within_ns;
    last->second = event.time_ns;
    if (!is_copy) sums_[k] = sum += bytes;
  }
}

std::optional<std::int64_t> LookupBytes::most_before(std::size_t event) const {
  if (!is_known_) return std::nullopt;
  const auto after = sums_.lower_bound(event);
  return after == sums_.begin() ? 0 : std::prev(after)->second;
}

}  // namespace stormproof::conform
