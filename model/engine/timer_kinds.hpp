// What the timers of a composition (fsm/composition) are in the event queue. Every world that runs
// scenarios, and whoever reads the events of a run, finds the kinds here; traces show them.
#pragma once

#include "fsm/composition/amended_parts.hpp"
#include "fsm/composition/cyclone_life.hpp"
#include "fsm/composition/fastdds.hpp"
#include "fsm/composition/life.hpp"
#include "fsm/composition/paper.hpp"
#include "fsm/composition/server.hpp"
#include "model/event.hpp"

namespace stormproof::model {

namespace comp = fsm::composition;

namespace detail {

template <class Timer, EventKind kind>
struct KindOf {};
struct TimerKinds : KindOf<comp::Announcement, EventKind::announcement_due>,
                    KindOf<comp::AckNackGeneration, EventKind::acknack_generation>,
                    KindOf<comp::InitialAttempt, EventKind::initial_acknack_due>,
                    KindOf<comp::HeartbeatExpiry, EventKind::heartbeat_expiry>,
                    KindOf<comp::CycleStart, EventKind::cycle_start>,
                    KindOf<comp::CycleEnd, EventKind::cycle_end>,
                    KindOf<comp::BatchDue, EventKind::batch_due>,
                    KindOf<comp::paper::RepairGeneration, EventKind::repair_generation>,
                    KindOf<comp::paper::SuppressionEnd, EventKind::suppression_end>,
                    KindOf<comp::fastdds::SuppressionEnd, EventKind::suppression_end>,
                    KindOf<comp::fastdds::NackResponseDue, EventKind::nack_response>,
                    KindOf<comp::fastdds::AsyncRunDue, EventKind::async_run>,
                    KindOf<comp::control::ControlInitialAttempt, EventKind::control_initial_due>,
                    KindOf<comp::control::ControlReplyDue, EventKind::control_reply_due>,
                    KindOf<comp::lookup::LookupExpiryDue, EventKind::lookup_expiry>,
                    KindOf<comp::cyclone::AckTime, EventKind::ack_time>,
                    KindOf<comp::cyclone::HeartbeatTime, EventKind::heartbeat_time>,
                    KindOf<comp::cyclone::SpdpTime, EventKind::spdp_time>,
                    KindOf<comp::cyclone::ReplyTime, EventKind::reply_time>,
                    KindOf<comp::cyclone::ThreadRun, EventKind::thread_run>,
                    KindOf<comp::cyclone::LivelinessTime, EventKind::liveliness_time>,
                    KindOf<comp::cyclone::AddressTime, EventKind::address_time>,
                    KindOf<comp::server::ClientAnnouncement, EventKind::client_announcement>,
                    KindOf<comp::server::ClientSync, EventKind::client_sync>,
                    KindOf<comp::server::RegistrationExpiryDue, EventKind::registration_expiry>,
                    KindOf<comp::server::RegistrationReplyDue, EventKind::registration_reply>,
                    KindOf<comp::server::RegistrationAttempt, EventKind::registration_initial>,
                    KindOf<comp::server::LearnerReplyDue, EventKind::learner_reply>,
                    KindOf<comp::server::LearnerAttempt, EventKind::learner_initial>,
                    KindOf<comp::server::RelayExpiryDue, EventKind::relay_expiry>,
                    KindOf<comp::server::RelayResponseDue, EventKind::relay_response>,
                    KindOf<comp::server::RelaySuppressionEnd, EventKind::relay_suppression_end>,
                    KindOf<comp::server::RoutineDue, EventKind::server_routine>,
                    KindOf<comp::server::RoutineAgain, EventKind::server_routine_again>,
                    KindOf<comp::server::SendingDue, EventKind::server_sending>,
                    KindOf<comp::LeaseCheck, EventKind::lease_check>,
                    KindOf<comp::Return, EventKind::participant_start>,
                    // A reader that asks by itself generates an ACKNACK.
                    KindOf<comp::amended::ReaderRetryDue, EventKind::acknack_generation>,
                    KindOf<comp::amended::CopyDue, EventKind::reply_time> {};

template <class Timer, EventKind kind>
constexpr EventKind kind_of_timer(const KindOf<Timer, kind>*) {
  return kind;
}
template <class Timer>
constexpr EventKind kind_of_timer(const void*) {
  return EventKind::dispatch;
}

}  // namespace detail

/// The kind of the events that a timer is; `dispatch`, which none is, if it is not in the list.
template <class Timer>
inline constexpr EventKind event_kind_of =
    detail::kind_of_timer<Timer>(static_cast<const detail::TimerKinds*>(nullptr));

}  // namespace stormproof::model
