// The kinds of HEARTBEATs from the order of events.
#include "checker/evidence/capture/heartbeat_kinds.hpp"

namespace stormproof::capture {

HeartbeatKind HeartbeatClassifier::classify(const Event& event, VendorId vendor,
                                            bool is_behind_data) {
  if (!event.has_info_dst) return fan_out(event, vendor, is_behind_data);
  timer_ns_.try_emplace({event.source, event.writer}, event.time_ns);
  const Relation relation{event.source, *event.destination, event.writer};
  const bool is_first = open_.insert(relation).second;
  if (is_behind_data) return HeartbeatKind::directed_piggyback;
  if (is_first) return HeartbeatKind::relation_open;
  const auto asked = unanswered_.find(relation);
  if (asked == unanswered_.end() || asked->second == 0) return HeartbeatKind::directed;
  --asked->second;
  return HeartbeatKind::reply;
}

HeartbeatKind HeartbeatClassifier::fan_out(const Event& event, VendorId vendor,
                                           bool is_behind_data) {
  constexpr std::int64_t shortest_period = fastdds_heartbeat_period_ns / 10 * 9;
  const Writer writer{event.source, event.writer};
  const auto timer = timer_ns_.try_emplace(writer, event.time_ns).first;
  const auto [message, is_new] =
      messages_.try_emplace({writer, event.heartbeat()->count}, FanOut{.time_ns = event.time_ns});
  if (!is_new && event.time_ns - message->second.time_ns < shortest_period) {
    return message->second.kind;  // another copy of it
  }
  HeartbeatKind kind = HeartbeatKind::fan_out;
  if (is_behind_data) {
    kind = HeartbeatKind::fan_out_piggyback;
  } else if (vendor == fastdds_vendor) {
    const bool is_due = event.time_ns - timer->second >= shortest_period;
    kind = is_due ? HeartbeatKind::fan_out_periodic : HeartbeatKind::fan_out_piggyback;
    if (is_due) timer->second = event.time_ns;
  }
  message->second = {kind, event.time_ns};
  return kind;
}

void HeartbeatClassifier::saw_acknack(const Event& event) {
  const AcknackEvent& acknack = *event.acknack();
  if (!event.destination || acknack.is_final || !acknack.is_initial()) return;
  ++unanswered_[{*event.destination, event.source, event.writer}];
}

}  // namespace stormproof::capture
