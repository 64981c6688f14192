// Names of the outbox fields of each machine, in their order, because C++ does not tell them.
#pragma once

#include <array>
#include <string_view>

#include <boost/pfr.hpp>

#include "fsm/announcer.hpp"
#include "fsm/cautious_reader.hpp"
#include "fsm/change_for_reader.hpp"
#include "fsm/control_relation.hpp"
#include "fsm/descriptor_repair.hpp"
#include "fsm/discovery_reader.hpp"
#include "fsm/event_thread.hpp"
#include "fsm/heartbeat_pacer.hpp"
#include "fsm/heartbeat_timer.hpp"
#include "fsm/initial_acknack.hpp"
#include "fsm/matched_reader.hpp"
#include "fsm/movable_timer.hpp"
#include "fsm/single_shot.hpp"

namespace stormproof::fsm::composition {

namespace detail {
template <class Io, class... Names>
constexpr auto all_fields(Names... names) {
  static_assert(sizeof...(Names) == boost::pfr::tuple_size_v<typename Io::template Output<Plain>>,
                "name every field of the outbox");
  return std::array<std::string_view, sizeof...(Names)>{names...};
}
}  // namespace detail

template <class Io>
inline constexpr auto outbox_names = nullptr;
template <>
inline constexpr auto outbox_names<AnnouncerIo> = detail::all_fields<AnnouncerIo>("announce",
                                                                                  "next_at");
template <>
inline constexpr auto outbox_names<CautiousReaderIo> =
    detail::all_fields<CautiousReaderIo>("opened", "take_data", "learn", "note", "preempt", "reply",
                                         "request", "delayed", "move", "next_at");
template <>
inline constexpr auto outbox_names<ChangeForReaderIo> =
    detail::all_fields<ChangeForReaderIo>("requested", "enqueue");
template <>
inline constexpr auto outbox_names<ControlRelationIo> =
    detail::all_fields<ControlRelationIo>("send_heartbeat", "start_initial", "reply");
template <>
inline constexpr auto outbox_names<DescriptorRepairIo> =
    detail::all_fields<DescriptorRepairIo>("requested", "generate", "returned");
template <>
inline constexpr auto outbox_names<DiscoveryReaderIo> = detail::all_fields<DiscoveryReaderIo>(
    "opened", "take_data", "schedule_acknack", "send_acknack", "send_initial");
template <>
inline constexpr auto outbox_names<EventThreadIo> = detail::all_fields<EventThreadIo>("schedule",
                                                                                      "work",
                                                                                      "next_at");
template <>
inline constexpr auto outbox_names<HeartbeatPacerIo> =
    detail::all_fields<HeartbeatPacerIo>("send", "restart", "move", "next_at");
template <>
inline constexpr auto outbox_names<HeartbeatTimerIo> = detail::all_fields<HeartbeatTimerIo>(
    "send", "schedule_expiry", "schedule_cycle", "schedule_end", "pace", "send_batch", "invalidate",
    "count_response", "next_at", "period");
template <>
inline constexpr auto outbox_names<InitialAckNackIo> =
    detail::all_fields<InitialAckNackIo>("attempt", "schedule", "next_delay", "next_at");
template <>
inline constexpr auto outbox_names<MatchedReaderIo> = detail::all_fields<MatchedReaderIo>("matched",
                                                                                          "take");
template <>
inline constexpr auto outbox_names<MovableTimerIo> = detail::all_fields<MovableTimerIo>("schedule",
                                                                                        "join");
template <>
inline constexpr auto outbox_names<SingleShotIo> = detail::all_fields<SingleShotIo>("schedule",
                                                                                    "fire",
                                                                                    "next_at");

}  // namespace stormproof::fsm::composition
