// What the knobs of a composition (fsm/composition) are in a profile. Every world that runs
// scenarios reads them here.
#pragma once

#include "fsm/composition/amended_parts.hpp"
#include "fsm/composition/cyclone.hpp"
#include "fsm/composition/fastdds.hpp"
#include "fsm/composition/paper.hpp"
#include "fsm/composition/server.hpp"
#include "model/dds_profile.hpp"
#include "model/implementations.hpp"

namespace stormproof::model {

namespace comp = fsm::composition;

namespace knobs_of_composition {

// Truth values.
inline bool value(comp::AcceptsUnmatched, const DdsProfile& dds) {
  const RelationRules rules = rules_of(dds);
  return rules.unmatched == Unmatched::accept ||
         rules.relation_opening != RelationOpening::each_side;
}
inline bool value(comp::ConstantInterval, const DdsProfile& dds) {
  return dds.sedp.initial_acknack_interval == InitialAckNackInterval::constant;
}
inline bool value(comp::Additive, const DdsProfile& dds) {
  return dds.sedp.heartbeat_timer == HeartbeatTimerKind::additive;
}
inline bool value(comp::Adaptive, const DdsProfile& dds) {
  return dds.sedp.heartbeat_policy == HeartbeatPolicy::adaptive;
}
inline bool value(comp::ResendsToAll, const DdsProfile& dds) {
  return dds.spdp.resend == SpdpResend::all_known;
}
inline bool value(comp::ResendsCopyAndMulticast, const DdsProfile& dds) {
  return dds.spdp.resend == SpdpResend::new_and_multicast;
}
inline bool value(comp::ResendsCopy, const DdsProfile& dds) {
  return dds.spdp.resend == SpdpResend::new_only;
}
inline bool value(comp::paper::PushesInitialData, const DdsProfile& dds) {
  return dds.sedp.initial_data == InitialData::push;
}
inline bool value(comp::paper::PrefixOnly, const DdsProfile& dds) {
  return dds.sedp.acknowledge == Acknowledge::prefix;
}
inline bool value(comp::paper::InitialCountsAsAckNack, const DdsProfile& dds) {
  return dds.sedp.initial_acknack == InitialAckNackReply::bitmap;
}
inline bool value(comp::paper::InitialIsAnsweredByHeartbeat, const DdsProfile& dds) {
  return dds.sedp.initial_acknack == InitialAckNackReply::heartbeat;
}
inline bool value(comp::paper::HeartbeatToMatched, const DdsProfile& dds) {
  return dds.sedp.heartbeat_recipients == HeartbeatRecipients::matched;
}
inline bool value(comp::paper::ReceiverOpensBothSides, const DdsProfile& dds) {
  return dds.sedp.relation_opening == RelationOpening::receiver;
}

// Delays in ns, and the two numbers of ε.
inline std::int64_t value(comp::InitialDelay, const DdsProfile& dds) {
  return dds.sedp.initial_acknack_delay.count();
}
inline std::int64_t value(comp::ResponseDelay, const DdsProfile& dds) {
  return dds.sedp.heartbeat_response_delay.count();
}
inline std::int64_t value(comp::HeartbeatPeriod, const DdsProfile& dds) {
  return dds.sedp.heartbeat_period.count();
}
inline std::int64_t value(comp::MinPeriod, const DdsProfile& dds) {
  return dds.sedp.adaptive.min_period.count();
}
inline std::int64_t value(comp::MaxPeriod, const DdsProfile& dds) {
  return dds.sedp.adaptive.max_period.count();
}
inline std::int64_t value(comp::EpsilonNumerator, const DdsProfile& dds) {
  return dds.sedp.adaptive.epsilon_numerator;
}
inline std::int64_t value(comp::EpsilonDenominator, const DdsProfile& dds) {
  return dds.sedp.adaptive.epsilon_denominator;
}
inline std::int64_t value(comp::StartupAnnouncements, const DdsProfile& dds) {
  return dds.spdp.startup_announcements;
}
inline std::int64_t value(comp::StartupPeriod, const DdsProfile& dds) {
  return dds.spdp.startup_period.count();
}
inline std::int64_t value(comp::AnnouncementPeriod, const DdsProfile& dds) {
  return dds.spdp.period.count();
}
inline std::int64_t value(comp::paper::NackResponseDelay, const DdsProfile& dds) {
  return dds.sedp.nack_response_delay.count();
}
inline std::int64_t value(comp::paper::SuppressionDuration, const DdsProfile& dds) {
  return dds.sedp.nack_suppression_duration.count();
}
inline std::int64_t value(comp::fastdds::NackResponseDelay, const DdsProfile& dds) {
  return dds.sedp.nack_response_delay.count();
}
inline std::int64_t value(comp::fastdds::SuppressionDuration, const DdsProfile& dds) {
  return dds.sedp.nack_suppression_duration.count();
}
inline std::int64_t value(comp::Immediately, const DdsProfile&) { return 0; }
inline std::int64_t value(comp::control::ControlReplyDelay, const DdsProfile&) { return 5'000'000; }

// Cyclone DDS.
inline bool value(comp::cyclone::MergesQueued, const DdsProfile& dds) {
  return dds.sedp.merge_queued_rexmit == MergeQueued::yes;
}
inline std::int64_t value(comp::cyclone::HeartbeatInterval, const DdsProfile& dds) {
  return dds.sedp.heartbeat_interval.count();
}
inline std::int64_t value(comp::cyclone::HeartbeatIntervalMax, const DdsProfile& dds) {
  return dds.sedp.heartbeat_interval_max.count();
}
inline std::int64_t value(comp::cyclone::MatchHeartbeatDelay, const DdsProfile& dds) {
  return dds.sedp.match_heartbeat_delay.count();
}
inline std::int64_t value(comp::cyclone::AckDelay, const DdsProfile& dds) {
  return dds.sedp.ack_delay.count();
}
inline std::int64_t value(comp::cyclone::NackDelay, const DdsProfile& dds) {
  return dds.sedp.nack_delay.count();
}
inline std::int64_t value(comp::cyclone::AutoReschedNackDelay, const DdsProfile& dds) {
  return dds.sedp.auto_resched_nack_delay.count();
}
inline std::int64_t value(comp::cyclone::PreEmptiveAckDelay, const DdsProfile& dds) {
  return dds.sedp.preemptive_ack_delay.count();
}
inline std::int64_t value(comp::cyclone::PreEmptiveRepeatDelay, const DdsProfile&) {
  return 1'000'000'000;
}
inline std::int64_t value(comp::cyclone::CountWindow, const DdsProfile&) { return 500'000'000; }
inline std::int64_t value(comp::cyclone::SpdpStartupPeriod, const DdsProfile& dds) {
  return dds.spdp.startup_period.count();
}
inline std::int64_t value(comp::cyclone::SpdpPeriod, const DdsProfile& dds) {
  return dds.spdp.period.count();
}
inline std::int64_t value(comp::cyclone::DirectedReplies, const DdsProfile& dds) {
  return dds.spdp.directed_replies;
}
inline std::int64_t value(comp::cyclone::DirectedReplyInterval, const DdsProfile& dds) {
  return dds.spdp.directed_reply_interval.count();
}

// A Discovery Server.
inline std::int64_t value(comp::server::ClientSyncPeriod, const DdsProfile& dds) {
  return dds.server.client_sync_period.count();
}
inline std::int64_t value(comp::server::RoutinePeriod, const DdsProfile& dds) {
  return dds.server.server_routine_period.count();
}
inline std::int64_t value(comp::server::RegistrationHeartbeatPeriod, const DdsProfile& dds) {
  return dds.server.pdp_heartbeat_period.count();
}
inline std::int64_t value(comp::server::RegistrationResponseDelay, const DdsProfile& dds) {
  return dds.server.pdp_heartbeat_response_delay.count();
}

// The amended rules of the paper's implementation; only profiles with amendments are asked.
inline bool value(comp::amended::InitialResets, const DdsProfile& dds) {
  return dds.amendments->initial_acknack_resets == Whether::yes;
}
inline bool value(comp::amended::InitialArms, const DdsProfile& dds) {
  return dds.amendments->initial_acknack_arms == Whether::yes;
}
inline bool value(comp::amended::IgnoresLateInitial, const DdsProfile& dds) {
  return dds.amendments->late_initial == LateInitial::ignore_after_ack;
}
inline bool value(comp::amended::AsksOnce, const DdsProfile& dds) {
  return dds.amendments->initial_acknack_repeat == InitialAckNackRepeat::once;
}
inline bool value(comp::amended::AsksAtOnceBeforeCreation, const DdsProfile& dds) {
  return dds.amendments->initial_acknack_repeat == InitialAckNackRepeat::age_based_zero;
}
inline bool value(comp::amended::AsksByAge, const DdsProfile& dds) {
  const InitialAckNackRepeat repeat = dds.amendments->initial_acknack_repeat;
  return repeat == InitialAckNackRepeat::age_based ||
         repeat == InitialAckNackRepeat::age_based_zero;
}
inline std::int64_t value(comp::amended::AgePeriod, const DdsProfile&) { return 1'000'000'000; }
inline bool value(comp::amended::StopsWhenComplete, const DdsProfile& dds) {
  return dds.amendments->initial_acknack_stop == InitialAckNackStop::complete;
}
inline bool value(comp::amended::ReopensAcknowledged, const DdsProfile& dds) {
  return dds.amendments->acked_request == AckedRequest::reopen;
}
inline bool value(comp::amended::ResendsAcknowledged, const DdsProfile& dds) {
  return dds.amendments->acked_request == AckedRequest::resend;
}
inline bool value(comp::amended::OnlyInUWaits, const DdsProfile& dds) {
  return dds.amendments->heartbeat_condition == HeartbeatCondition::in_u;
}
inline bool value(comp::amended::MeasuresAcks, const DdsProfile& dds) {
  return dds.amendments->heartbeat_policy == AmendedPolicy::measured_ack;
}
inline std::int64_t value(comp::amended::ShortestMeasured, const DdsProfile&) { return 10'000'000; }
inline std::int64_t value(comp::amended::LongestMeasured, const DdsProfile&) {
  return 10'000'000'000;
}
inline bool value(comp::amended::SuppressionEndArms, const DdsProfile& dds) {
  return dds.amendments->suppression_end_arms == Whether::yes;
}
inline bool value(comp::amended::HeartbeatBeforeRepair, const DdsProfile& dds) {
  return dds.amendments->repair_heartbeat == RepairHeartbeat::before;
}
inline bool value(comp::amended::HeartbeatAfterRepair, const DdsProfile& dds) {
  return dds.amendments->repair_heartbeat == RepairHeartbeat::after;
}
inline bool value(comp::amended::AnswersRequests, const DdsProfile& dds) {
  return dds.amendments->acknack_reply == AckNackReply::nonfinal;
}
inline bool value(comp::amended::AnswersEachAckNack, const DdsProfile& dds) {
  return dds.amendments->acknack_reply == AckNackReply::all;
}
inline bool value(comp::amended::LatestOnly, const DdsProfile& dds) {
  return dds.amendments->stale_acknack == StaleAckNack::latest_only;
}
inline bool value(comp::amended::RequiredDrops, const DdsProfile& dds) {
  return dds.amendments->stale_acknack == StaleAckNack::required_drop;
}
inline bool value(comp::amended::RequiredGates, const DdsProfile& dds) {
  return dds.amendments->stale_acknack == StaleAckNack::required_gate;
}
inline bool value(comp::amended::RequiredAtRepair, const DdsProfile& dds) {
  return dds.amendments->stale_acknack == StaleAckNack::required_at_repair;
}
inline bool value(comp::amended::AcksHighest, const DdsProfile& dds) {
  return dds.amendments->on_reannounce == OnReannounce::ack_highest;
}
inline bool value(comp::amended::AcksMissing, const DdsProfile& dds) {
  return dds.amendments->on_reannounce == OnReannounce::ack_missing;
}
inline bool value(comp::amended::RetriesAfterNack, const DdsProfile& dds) {
  return dds.amendments->reader_retry != ReaderRetry::off;
}
inline bool value(comp::amended::RetriesWheneverMissing, const DdsProfile& dds) {
  return dds.amendments->reader_retry == ReaderRetry::whenever_missing;
}
inline std::int64_t value(comp::amended::MatchClockSkew, const DdsProfile& dds) {
  return dds.amendments->match_clock_skew.count();
}
inline std::int64_t value(comp::amended::RetryPeriod, const DdsProfile& dds) {
  return dds.amendments->reader_retry_period.count();
}
inline std::int64_t value(comp::amended::NackDelay, const DdsProfile& dds) {
  return dds.amendments->reader_nack_delay.count();
}
inline std::int64_t value(comp::amended::ResendCopies, const DdsProfile& dds) {
  return dds.amendments->resend_copies;
}
inline std::int64_t value(comp::amended::ResendCopyPeriod, const DdsProfile& dds) {
  return dds.amendments->resend_copy_period.count();
}
inline std::int64_t value(comp::amended::CountFilter, const DdsProfile& dds) {
  return dds.amendments->count_filter;
}
}  // namespace knobs_of_composition

/// Whether the switch or delay is one of the profile; otherwise it is the deployment's.
template <class Knob>
inline constexpr bool is_knob = requires(const DdsProfile& dds) {
  knobs_of_composition::value(Knob{}, dds);
};
/// The value of a switch, or of a delay in ns.
template <class Knob>
[[nodiscard]] auto knob_value(Knob knob, const DdsProfile& dds) {
  return knobs_of_composition::value(knob, dds);
}

}  // namespace stormproof::model
