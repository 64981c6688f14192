// Each datagram belongs to the class of what it was sent for, as in the model.
#include "checker/evidence/doctor/expense.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "checker/evidence/doctor/repairs.hpp"
#include "model/airtime.hpp"

namespace stormproof::doctor {

namespace {

using capture::Conversation;
using capture::Counting;
using capture::Event;
using capture::GuidPrefix;
using model::MessageClass;
using model::TrafficClass;

/// Nothing: it is not of discovery, or of the same host.
std::optional<TrafficClass> traffic_class(const Event& event,
                                          const std::optional<MessageClass>& is) {
  if (is) {
    switch (*is) {
      case MessageClass::initial_data:
        return TrafficClass::initial_data;
      case MessageClass::repair_data:
        return TrafficClass::repair_data;
      case MessageClass::heartbeat:
        return TrafficClass::heartbeat;
      case MessageClass::acknack:
        return TrafficClass::acknack;
      case MessageClass::spdp_multicast:
      case MessageClass::spdp_unicast:
        return TrafficClass::spdp;
    }
  }
  if (event.is_same_host) return std::nullopt;
  if (event.traffic() == capture::Traffic::spdp) return TrafficClass::spdp;
  if (event.traffic() == capture::Traffic::type_lookup) return TrafficClass::lookup;
  const bool is_control = event.heartbeat() != nullptr || event.acknack() != nullptr;
  if (event.traffic() != capture::Traffic::user || !is_control) return std::nullopt;
  return TrafficClass::user_control;
}

/// What a datagram is sent for that holds several of them is the first one.
constexpr std::array order{TrafficClass::initial_data, TrafficClass::spdp,
                           TrafficClass::repair_data,  TrafficClass::heartbeat,
                           TrafficClass::acknack,      TrafficClass::lookup,
                           TrafficClass::user_control};

/// Messages until `end_ns`; and, if there is a channel, what their datagrams take.
struct Tally {
  exact::PerClass messages{};
  exact::PerClass airtime{};

  Tally(const Conversation& conversation, const Counting& counting, std::int64_t end_ns,
        const model::WirelessProfile* channel) {
    std::optional<model::RouteAirtime> route;
    if (channel != nullptr) route.emplace(*channel);
    for (std::size_t k = 0; k < counting.classes.size();) {
      const std::uint32_t number = conversation.events[k].datagram;
      const capture::DatagramRecord& datagram = conversation.datagrams[number];
      if (datagram.time_ns > end_ns) break;
      auto first = order.end();
      for (; k < counting.classes.size() && conversation.events[k].datagram == number; ++k) {
        const auto one = traffic_class(conversation.events[k], counting.classes[k]);
        if (!one) continue;
        ++messages[static_cast<std::size_t>(*one)];
        first = std::min(first, std::ranges::find(order, *one));
      }
      if (!route || first == order.end()) continue;
      airtime[static_cast<std::size_t>(*first)] += static_cast<double>(
          route->packet_ns(datagram.payload_bytes, datagram.destination.address.is_multicast()));
    }
  }
};

using ReaderOf = std::tuple<GuidPrefix, GuidPrefix, capture::EntityId>;

/// What was sent last to the readers of each SEDP writer: to one, or to the group.
class Acknowledgements {
 public:
  void sent(const Event& event, const capture::DataEvent& data) {
    Last& last = event.destination ? to_one_[{event.source, *event.destination, event.writer}]
                                   : to_all_[{event.source, event.writer}];
    last.number = std::max(last.number, data.sequence_number);
    last.time_ns = std::max(last.time_ns, event.time_ns);
  }
  void acknowledged(const Event& event, const capture::AcknackEvent& acknack) {
    const ReaderOf relation{*event.destination, event.source, event.writer};
    std::int64_t all = 0;
    if (const auto one = to_one_.find(relation); one != to_one_.end()) all = one->second.number;
    const auto group = to_all_.find({*event.destination, event.writer});
    if (group != to_all_.end()) all = std::max(all, group->second.number);
    if (all > 0 && acknack.missing.base > all) known_.try_emplace(relation, event.time_ns);
  }
  [[nodiscard]] std::int64_t all_known_ns() const {
    std::int64_t last = INT64_MIN;
    for (const auto& [relation, time_ns] : known_) last = std::max(last, time_ns);
    for (const auto& [relation, sent] : to_one_) {
      if (!known_.contains(relation)) last = std::max(last, sent.time_ns);
    }
    return last;
  }

 private:
  struct Last {
    std::int64_t number = 0;
    std::int64_t time_ns = INT64_MIN;
  };
  std::map<ReaderOf, Last> to_one_;
  std::map<std::pair<GuidPrefix, capture::EntityId>, Last> to_all_;
  std::map<ReaderOf, std::int64_t> known_;
};

/// When everybody had everything, as far as the capture shows it: of each relation the first
/// ACKNACK that acknowledges all that was sent to it, or, where there is none, the last DATA. At
/// least when the last descriptor was sent first, and the last type was asked for or told.
std::int64_t known_ns(const Conversation& conversation, const Counting& counting) {
  Acknowledgements known;
  const auto each = [&](const auto& act) {
    for (std::size_t k = 0; k < counting.classes.size(); ++k) {
      const Event& event = conversation.events[k];
      if (counting.classes[k] && event.traffic() == capture::Traffic::sedp) act(event);
    }
  };
  each([&](const Event& event) {
    if (const auto* data = event.data()) known.sent(event, *data);
  });
  each([&](const Event& event) {
    const auto* acknack = event.acknack();
    if (acknack != nullptr && event.destination) known.acknowledged(event, *acknack);
  });
  return std::max({known.all_known_ns(), counting.last_initial_ns.value_or(INT64_MIN),
                   counting.last_lookup_ns.value_or(INT64_MIN)});
}

/// When the last participant announced itself first.
std::int64_t last_start_ns(const Conversation& conversation) {
  std::int64_t last = conversation.first_ns;
  for (const capture::Participant& one : conversation.topology.participants) {
    last = std::max(last, one.first_ns);
  }
  return last;
}

}  // namespace

Discovered discovered(const Conversation& conversation, const Counting& counting,
                      const std::optional<model::Limits>& limits) {
  return {last_start_ns(conversation) + exact::late_limit(limits).count(),
          known_ns(conversation, counting)};
}

exact::Expense expense_of(const Conversation& conversation, const Counting& counting,
                          const model::Counts& failure_free, const Discovered& discovered,
                          bool incomplete, const model::WirelessProfile* channel) {
  const std::int64_t end_ns = incomplete ? conversation.last_ns : discovered.known_ns;
  const Tally tally{conversation, counting, end_ns, channel};
  const Repairs repairs = find_repairs(conversation, counting, end_ns);
  const double needed = exact::part_of(static_cast<double>(repairs.needed()),
                                       static_cast<double>(repairs.needed() + repairs.needless()));
  const exact::Sent sent = exact::sent_of(channel != nullptr ? tally.airtime : tally.messages,
                                          tally.messages, failure_free, needed);
  return exact::expense_of(sent, incomplete || discovered.is_late(discovered.known_ns));
}

}  // namespace stormproof::doctor
