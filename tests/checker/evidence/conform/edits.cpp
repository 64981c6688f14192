// Events stay in time order; whoever changes one gets to know where it is afterwards.
#include "tests/checker/evidence/conform/edits.hpp"

#include <algorithm>
#include <stdexcept>

namespace stormproof::conform::testing {

namespace {

std::size_t index_of(const Conversation& conversation, const capture::GuidPrefix& prefix) {
  const auto& topology = conversation.topology;
  const capture::Participant* participant = topology.find(prefix);
  return participant == nullptr ? SIZE_MAX : topology.index_of(*participant);
}

}  // namespace

std::size_t source_of(const Conversation& conversation, const Event& event) {
  return index_of(conversation, event.source);
}

std::size_t destination_of(const Conversation& conversation, const Event& event) {
  return event.destination ? index_of(conversation, *event.destination) : SIZE_MAX;
}

std::size_t find(const Conversation& conversation, const Matches& matches, std::size_t nth) {
  for (std::size_t k = 0; k < conversation.events.size(); ++k) {
    if (matches(conversation.events[k]) && nth-- == 0) return k;
  }
  throw std::runtime_error{"the capture has no such event"};
}

std::size_t find_last(const Conversation& conversation, const Matches& matches) {
  const auto count = std::count_if(conversation.events.begin(), conversation.events.end(), matches);
  return find(conversation, matches,
              static_cast<std::size_t>(std::max<std::ptrdiff_t>(count, 1) - 1));
}

void drop(Conversation& conversation, const Matches& matches) {
  std::erase_if(conversation.events, matches);
}

void drop(Conversation& conversation, std::size_t event) {
  conversation.events.erase(conversation.events.begin() + static_cast<std::ptrdiff_t>(event));
}

std::size_t move(Conversation& conversation, std::size_t event, std::int64_t time_ns) {
  const Event moved = conversation.events[event];
  drop(conversation, event);
  return add(conversation, moved, time_ns);
}

std::size_t add(Conversation& conversation, Event event, std::int64_t time_ns) {
  capture::DatagramRecord record = conversation.datagrams[event.datagram];
  record.time_ns = time_ns;
  event.time_ns = time_ns;
  event.datagram = static_cast<std::uint32_t>(conversation.datagrams.size());
  conversation.datagrams.push_back(record);
  const auto at =
      std::upper_bound(conversation.events.begin(), conversation.events.end(), time_ns,
                       [](std::int64_t time, const Event& other) { return time < other.time_ns; });
  const auto added = conversation.events.insert(at, std::move(event));
  return static_cast<std::size_t>(added - conversation.events.begin());
}

}  // namespace stormproof::conform::testing
