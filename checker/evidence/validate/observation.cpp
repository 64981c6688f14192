// Counting until the cut, and the figures that counting has not: datagrams of discovery, control
// traffic of other endpoints, growth since the first announcement.
#include "checker/evidence/validate/observation.hpp"

#include <algorithm>
#include <set>
#include <tuple>

namespace stormproof::validate {

namespace {

using capture::Conversation;
using capture::Counting;
using capture::HeartbeatKind;
using model::MessageClass;

/// Datagrams with a message of a class, and their payloads.
void add_datagrams(const Conversation& conversation, const Counting& counting, Tally& tally) {
  std::optional<std::uint32_t> last;
  for (std::size_t k = 0; k < counting.classes.size(); ++k) {
    const std::uint32_t datagram = conversation.events[k].datagram;
    if (!counting.classes[k] || datagram == last) continue;
    last = datagram;
    ++tally[index_of(Figure::datagrams)];
    tally[index_of(Figure::payload_bytes)] += conversation.datagrams[datagram].payload_bytes;
  }
}

/// Initial DATA whose destination had asked for it.
std::uint64_t pulled(const Conversation& conversation, const Counting& counting) {
  using Key = std::tuple<capture::GuidPrefix, capture::EntityId, capture::GuidPrefix, std::int64_t>;
  std::set<Key> requested;
  std::uint64_t count = 0;
  for (std::size_t k = 0; k < counting.classes.size(); ++k) {
    const capture::Event& event = conversation.events[k];
    if (!event.destination || event.traffic() != capture::Traffic::sedp) continue;
    if (const capture::AcknackEvent* acknack = event.acknack()) {
      for (std::uint32_t bit = 0; bit < acknack->missing.num_bits; ++bit) {
        if (!acknack->missing.has(bit)) continue;
        requested.insert(
            {*event.destination, event.writer, event.source, acknack->missing.base + bit});
      }
    } else if (counting.classes[k] == MessageClass::initial_data) {
      const std::int64_t number = event.data()->sequence_number;
      if (requested.contains({event.source, event.writer, *event.destination, number})) ++count;
    }
  }
  return count;
}

/// HEARTBEATs and ACKNACKs of liveliness, user endpoints and what looks up types, across hosts.
/// Nothing if the capture has none at all of the first two: then it was filtered, because every
/// pair of participants has some.
std::optional<double> control_messages(const Conversation& conversation, std::int64_t until_ns) {
  std::uint64_t all = 0;
  std::uint64_t across = 0;
  for (const capture::Event& event : conversation.events) {
    if (event.time_ns > until_ns) break;
    const capture::Traffic traffic = event.traffic();
    const bool looks_up = traffic == capture::Traffic::type_lookup;
    if (!looks_up && traffic != capture::Traffic::liveliness && traffic != capture::Traffic::user) {
      continue;
    }
    if (event.heartbeat() == nullptr && event.acknack() == nullptr) continue;
    if (!looks_up) ++all;
    if (!event.is_same_host) ++across;
  }
  if (all == 0) return std::nullopt;
  return static_cast<double>(across);
}

Tally tally_of(const Conversation& conversation, const Counting& counting) {
  Tally tally{};
  for (const MessageClass one : model::message_classes) add(tally, one, counting.counts[one]);
  tally[index_of(Figure::total)] = counting.counts.total();
  const auto kind = [&](HeartbeatKind one) { return counting.heartbeats.of(one); };
  const auto set = [&](Figure figure, std::uint64_t value) { tally[index_of(figure)] = value; };
  set(Figure::heartbeat_open, kind(HeartbeatKind::relation_open));
  set(Figure::heartbeat_reply, kind(HeartbeatKind::reply));
  set(Figure::heartbeat_piggyback,
      kind(HeartbeatKind::directed_piggyback) + kind(HeartbeatKind::fan_out_piggyback));
  set(Figure::heartbeat_periodic, kind(HeartbeatKind::fan_out_periodic));
  set(Figure::acknack_initial, counting.acknacks.initial);
  set(Figure::acknack_negative, counting.acknacks.negative);
  set(Figure::acknack_positive, counting.acknacks.positive);
  set(Figure::initial_pulled, pulled(conversation, counting));
  set(Figure::pdp_data, counting.counts.pdp_data);
  set(Figure::pdp_heartbeat, counting.counts.pdp_heartbeat);
  set(Figure::pdp_acknack, counting.counts.pdp_acknack);
  set(Figure::gap, counting.counts.gap);
  add_datagrams(conversation, counting, tally);
  return tally;
}

/// When the last relation was opened, and the last initial DATA sent; 0 if none was.
void add_times(const Conversation& conversation, const Counting& counting, std::int64_t zero_ns,
               Tally& tally) {
  const auto set = [&](Figure figure, std::size_t event) {
    const std::int64_t since = conversation.events[event].time_ns - zero_ns;
    tally[index_of(figure)] = static_cast<std::uint64_t>(std::max<std::int64_t>(since, 0));
  };
  for (const auto& [event, kind] : counting.kinds) {
    if (kind == HeartbeatKind::relation_open) set(Figure::last_open, event);
  }
  for (std::size_t k = 0; k < counting.classes.size(); ++k) {
    if (counting.classes[k] == MessageClass::initial_data) set(Figure::last_initial, k);
  }
}

Growth growth_of(const Conversation& conversation, const Counting& counting, std::int64_t zero_ns,
                 std::int64_t span_ns) {
  Growth growth;
  constexpr auto steps = static_cast<std::int64_t>(observed_steps);
  growth.step_ns = std::max<std::int64_t>((span_ns + steps - 1) / steps, 1);
  Tally so_far{};
  std::size_t next = 0;
  auto of_server = counting.of_server.begin();
  for (std::int64_t step = 1; step <= steps; ++step) {
    for (; next < counting.classes.size(); ++next) {
      if (conversation.events[next].time_ns - zero_ns > step * growth.step_ns) break;
      if (counting.classes[next]) add(so_far, *counting.classes[next]);
      if (of_server == counting.of_server.end() || *of_server != next) continue;
      ++so_far[index_of(Figure::total)];
      ++of_server;
    }
    growth.points.push_back(growth_point(so_far));
  }
  return growth;
}

}  // namespace

model::config::Result<Observation> observe(const Conversation& conversation,
                                           std::optional<std::int64_t> until_ns,
                                           const RunRecord& record) {
  Observation result;
  result.cut = until_ns ? Cut::given : Cut::last_initial;
  result.cut_ns = std::min(until_ns.value_or(conversation.last_ns), conversation.last_ns);
  result.counting = capture::count(conversation, result.cut_ns);
  result.complete = result.counting.last_initial_ns.has_value();
  if (until_ns) result.cut_ns = *until_ns;
  if (!until_ns && result.complete && *result.counting.last_initial_ns < result.cut_ns) {
    result.cut_ns = *result.counting.last_initial_ns;
    result.counting = capture::count(conversation, result.cut_ns);
  }
  auto deployment = captured_deployment(conversation, result.cut_ns, record);
  if (!deployment) return deployment.error();
  result.deployment = std::move(*deployment);
  constexpr std::int64_t longest_ns = 1'000'000'000'000'000;
  if (result.completion_ns() > longest_ns) {
    return model::config::InputError{
        until_ns ? "--until" : "capture",
        "ends more than 1,000,000 s after the first announcement; expected one discovery"};
  }
  Tally tally = tally_of(conversation, result.counting);
  tally[index_of(Figure::completion)] = static_cast<std::uint64_t>(result.completion_ns());
  add_times(conversation, result.counting, result.deployment.zero_ns, tally);
  for (std::size_t k = 0; k < figure_count; ++k) {
    result.values[k] = static_cast<double>(tally[k]);
  }
  result.values[index_of(Figure::user_control)] = control_messages(conversation, result.cut_ns);
  result.growth =
      growth_of(conversation, result.counting, result.deployment.zero_ns, result.completion_ns());
  return result;
}

}  // namespace stormproof::validate
