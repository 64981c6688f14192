// One pass over the events, and the check of the keys.
#include "checker/evidence/capture/counting.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include "checker/evidence/capture/heartbeat_kinds.hpp"
#include "checker/evidence/capture/required_keys.hpp"

namespace stormproof::capture {

namespace {

class Counter {
 public:
  explicit Counter(const Conversation& conversation, Counting& counting)
      : conversation_{conversation},
        counting_{counting},
        has_server_{conversation.topology.has_server()} {}

  /// The events first … last − 1 are those of one datagram.
  void add(const DatagramRecord& datagram, std::size_t first, std::size_t last) {
    std::array<std::uint32_t, message_class_count> in_datagram{};
    std::uint32_t data = 0;
    const std::uint64_t lookups = counting_.lookup_messages();
    add_user(datagram.user);
    for (std::size_t k = first; k < last; ++k) {
      const Event& event = conversation_.events[k];
      add_traffic(event);
      if (event.traffic() == Traffic::type_lookup) add_lookup(event);
      const std::optional<MessageClass> one = classify(event);
      counting_.classes.push_back(event.is_same_host ? std::nullopt : one);
      if (has_server_) add_of_server(event, k);
      if (!one) continue;
      ++(event.is_same_host ? counting_.same_host : counting_.counts)[*one];
      if (event.is_same_host) continue;
      const auto index = index_of(*one);
      ++in_datagram[index];
      counting_.sizes[index].submessage_bytes += event.bytes;
      if (one == MessageClass::initial_data || one == MessageClass::repair_data) ++data;
      if (one == MessageClass::heartbeat) add_heartbeat(k, datagram.vendor, data > 0);
      if (one == MessageClass::acknack) add_acknack(event);
      if (!event.destination && !event.is_multicast) ++counting_.unknown_destination;
    }
    for (std::size_t k = 0; k < message_class_count; ++k) {
      if (in_datagram[k] == 1) ++counting_.sizes[k].single[datagram.payload_bytes];
    }
    if (data > 0) ++counting_.data_per_datagram[data];
    if (last > first && datagram.user.data == 0 &&
        counting_.lookup_messages() - lookups == last - first) {
      ++counting_.lookup_datagrams;
    }
    counting_.statistics_bytes += datagram.statistics_bytes;
    ++counting_.datagrams;
    counting_.frames += datagram.frames;
    counting_.wire_bytes += datagram.wire_bytes;
  }

 private:
  void add_user(const UserData& user) {
    TrafficFigures& figures = counting_.traffic[static_cast<std::size_t>(Traffic::user)];
    figures.bytes += user.bytes;
    figures.data += user.data - user.fragments;
    figures.data_frag += user.fragments;
  }

  void add_traffic(const Event& event) {
    TrafficFigures& figures = counting_.traffic[static_cast<std::size_t>(event.traffic())];
    figures.bytes += event.bytes;
    if (const DataEvent* data = event.data()) {
      ++(data->fragment == 0 ? figures.data : figures.data_frag);
    } else if (event.heartbeat() != nullptr) {
      ++figures.heartbeat;
    } else if (event.acknack() != nullptr) {
      ++figures.acknack;
    } else {
      ++figures.gap;
    }
  }

  void add_lookup(const Event& event) {
    if (event.data() != nullptr) {
      ++(event.is_same_host ? counting_.same_host : counting_.counts).lookup;
    }
    if (event.is_same_host) return;
    LookupFigures& figures = event.writer == entity::lookup_requests_writer
                                 ? counting_.lookup_requests
                                 : counting_.lookup_replies;
    if (const DataEvent* data = event.data()) {
      ++figures.data;
      figures.data_bytes += event.bytes;
      if (samples_.insert({event.source, event.writer, data->sequence_number}).second) {
        ++figures.samples;
      }
      counting_.last_lookup_ns = event.time_ns;
    } else if (event.heartbeat() != nullptr) {
      ++figures.heartbeat;
    } else {
      ++(event.acknack() != nullptr ? figures.acknack : figures.gap);
    }
  }

  [[nodiscard]] std::optional<MessageClass> classify(const Event& event) {
    const Traffic traffic = event.traffic();
    if (const DataEvent* data = event.data()) {
      if (data->fragment != 0) return std::nullopt;
      if (traffic == Traffic::spdp) {
        if (event.is_multicast) return MessageClass::spdp_multicast;
        if (has_server_) return std::nullopt;
        return MessageClass::spdp_unicast;
      }
      if (traffic != Traffic::sedp) return std::nullopt;
      return classify_data(event, *data);
    }
    if (traffic != Traffic::sedp) return std::nullopt;
    if (event.heartbeat() != nullptr) return MessageClass::heartbeat;
    if (event.acknack() != nullptr) return MessageClass::acknack;
    return std::nullopt;
  }

  /// Reliable announcements, and GAPs of all relays.
  void add_of_server(const Event& event, std::size_t index) {
    model::Counts& counts = event.is_same_host ? counting_.same_host : counting_.counts;
    const bool is_announcement = event.traffic() == Traffic::spdp;
    if (event.gap() != nullptr && (is_announcement || event.traffic() == Traffic::sedp)) {
      ++counts.gap;
    }
    if (!is_announcement || event.gap() != nullptr) return;
    if (const DataEvent* data = event.data()) {
      if (data->fragment != 0 || event.is_multicast) return;
      ++counts.pdp_data;
    } else {
      ++(event.heartbeat() != nullptr ? counts.pdp_heartbeat : counts.pdp_acknack);
    }
    if (!event.is_same_host) counting_.of_server.push_back(index);
  }

  [[nodiscard]] MessageClass classify_data(const Event& event, const DataEvent& data) {
    if (!event.destination && event.is_multicast) ++counting_.multicast_data;
    const bool is_first =
        is_relayed(event, data)
            ? relayed_.insert({event.source, event.destination, event.writer, *data.endpoint})
                  .second
            : keys_.insert({event.source, event.destination, event.writer, data.sequence_number})
                  .second;
    return is_first ? MessageClass::initial_data : MessageClass::repair_data;
  }

  void add_heartbeat(std::size_t index, VendorId vendor, bool is_behind_data) {
    const Event& event = conversation_.events[index];
    const HeartbeatEvent& heartbeat = *event.heartbeat();
    HeartbeatFigures& figures = counting_.heartbeats;
    const HeartbeatKind kind = classifier_.classify(event, vendor, is_behind_data);
    counting_.kinds.emplace_back(index, kind);
    ++figures.by_kind[static_cast<std::size_t>(kind)];
    if (is_behind_data) ++figures.behind_data;
    if (!event.has_info_dst) ++figures.no_info_dst;
    if (heartbeat.is_empty()) ++figures.empty;
    if (heartbeat.is_final) ++figures.final_flag;
  }

  void add_acknack(const Event& event) {
    const AcknackEvent& acknack = *event.acknack();
    AcknackFigures& figures = counting_.acknacks;
    const std::uint32_t requested = acknack.missing.size();
    if (requested > 0) {
      ++figures.negative;
    } else {
      ++(acknack.is_initial() ? figures.initial : figures.positive);
    }
    if (acknack.is_initial() && !acknack.is_final) ++figures.preemptive;
    if (acknack.is_final) ++figures.final_flag;
    figures.requested += requested;
    classifier_.saw_acknack(event);
  }

  using Key = std::tuple<GuidPrefix, std::optional<GuidPrefix>, EntityId, std::int64_t>;

  using Relayed = std::tuple<GuidPrefix, std::optional<GuidPrefix>, EntityId, Guid>;

  const Conversation& conversation_;
  Counting& counting_;
  const bool has_server_;
  HeartbeatClassifier classifier_;
  std::set<Key> keys_;
  std::set<Relayed> relayed_;
  std::set<std::tuple<GuidPrefix, EntityId, std::int64_t>> samples_;  ///< of TypeLookup
};

}  // namespace

const char* name_of(HeartbeatKind kind) {
  switch (kind) {
    case HeartbeatKind::relation_open:
      return "relation_open";
    case HeartbeatKind::reply:
      return "reply";
    case HeartbeatKind::directed_piggyback:
      return "directed_piggyback";
    case HeartbeatKind::directed:
      return "directed";
    case HeartbeatKind::fan_out_piggyback:
      return "fan_out_piggyback";
    case HeartbeatKind::fan_out_periodic:
      return "fan_out_periodic";
    case HeartbeatKind::fan_out:
      return "fan_out";
  }
  return "";
}

Counting count(const Conversation& conversation, std::int64_t until_ns) {
  Counting counting;
  counting.until_ns = until_ns;
  Counter counter{conversation, counting};
  const auto& events = conversation.events;
  std::size_t event = 0;
  for (std::size_t d = 0; d < conversation.datagrams.size(); ++d) {
    const DatagramRecord& datagram = conversation.datagrams[d];
    if (datagram.time_ns > until_ns) {
      counting.after_cut = conversation.datagrams.size() - d;
      break;
    }
    const std::size_t first = event;
    while (event < events.size() && events[event].datagram == d) ++event;
    counter.add(datagram, first, event);
  }
  check_keys(conversation, counting);
  return counting;
}

}  // namespace stormproof::capture
