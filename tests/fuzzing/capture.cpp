// Fuzz target: captures (checker/evidence/capture/events.hpp). An input that starts as an RTPS
// message is one, so that a fuzzer reaches the submessages without learning the layers below them.
#include <limits>

#include "checker/evidence/capture/counting.hpp"
#include "checker/evidence/capture/message_events.hpp"
#include "tests/fuzzing/checks.hpp"
#include "tests/fuzzing/targets.hpp"

namespace stormproof::fuzzing {

namespace {

using capture::Bytes;

Outcome message(Bytes input) {
  capture::Extraction extraction;
  capture::Remarks remarks;
  capture::Datagram datagram;
  datagram.payload = input;
  if (!extract(datagram, 0, "input", extraction, remarks)) return Outcome::refused;
  std::size_t bytes = 0;
  for (const capture::Event& event : extraction.events) bytes += event.bytes;
  require(bytes <= input.size(), "submessages are no longer than their message");
  return Outcome::accepted;
}

constexpr std::int64_t always = std::numeric_limits<std::int64_t>::max();

void check(const capture::Conversation& conversation) {
  const capture::Counting counting = count(conversation, always);
  std::uint64_t submessages = 0;
  for (const capture::TrafficFigures& one : counting.traffic) {
    submessages += one.data + one.data_frag + one.heartbeat + one.acknack + one.gap;
  }
  std::uint64_t user_data = 0;
  for (const capture::DatagramRecord& one : conversation.datagrams) user_data += one.user.data;
  require(submessages == conversation.events.size() + user_data, "every event is in the traffic");
  require(counting.counts.total() + counting.same_host.total() <= submessages,
          "no event counts twice");
  require(counting.missing_count <= counting.required, "what is missing was required");
  std::int64_t last = conversation.first_ns;
  for (const capture::Event& event : conversation.events) {
    require(event.datagram < conversation.datagrams.size(), "an event has a datagram");
    require(event.time_ns >= last, "events are in time order");
    last = event.time_ns;
  }
  require(last <= conversation.last_ns, "events lie within the capture");
  if (conversation.events.empty()) return;
  const std::int64_t half_ns = conversation.events[conversation.events.size() / 2].time_ns;
  const capture::Counting half = count(conversation, half_ns);
  require(half.counts.total() <= counting.counts.total(), "no event counts only before a cut");
  require(half.datagrams + half.after_cut == counting.datagrams, "a cut leaves no datagram out");
  require(counting.missing.size() <= counting.missing_count,
          "what is listed as missing is missing");
  require(
      counting.last_initial_ns.has_value() || counting.missing_count > 0 || counting.required == 0,
      "what is not missing was sent at some time");
}

/// A capture read again, and together with itself.
void check_again(const capture::Conversation& once, const capture::MemoryCapture& file) {
  const auto again = capture::read_conversation(std::array{file});
  require(again && again->events.size() == once.events.size() && again->remarks == once.remarks,
          "the same bytes give the same conversation");
  const auto both = capture::read_conversation(std::array{file, file});
  require(static_cast<bool>(both), "a capture can be merged with itself");
  require(both->captures[1].merged + both->captures[0].merged == once.datagrams.size(),
          "every datagram is merged with itself");
  require(count(*both, always).counts == count(once, always).counts,
          "a capture together with itself counts once");
}

}  // namespace

Outcome capture(std::string_view input) {
  constexpr std::size_t unpack_limit = 4U << 20U;
  const Bytes bytes{reinterpret_cast<const std::uint8_t*>(input.data()), input.size()};
  if (input.starts_with("RTPS")) return message(bytes);
  const std::array captures{capture::MemoryCapture{"input", bytes, unpack_limit}};
  const auto conversation = capture::read_conversation(captures);
  if (!conversation) {
    require(conversation.error().where == "input", "an error has a place");
    require(!conversation.error().message.empty(), "an error says what is wrong");
    return Outcome::refused;
  }
  check(*conversation);
  // Reads it three times more: not worth the time of a fuzzer for a large input.
  constexpr std::size_t small = 4096;
  if (bytes.size() <= small) check_again(*conversation, captures[0]);
  return Outcome::accepted;
}

}  // namespace stormproof::fuzzing
