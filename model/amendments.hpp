// Rules that writers and readers of DDS implementations had before or after a defect was repaired,
// as changes of the paper's rules (fsm/composition/amended.hpp). A profile that has this section
// runs under the amended composition; every member left at its default is the paper's rule.
// specs/guide/museum.md explains each.
#pragma once

#include <cstdint>

#include "model/units.hpp"

namespace stormproof::model {

/// A truth value of the amendments.
enum class Whether : std::uint8_t { no, yes };

/// What follows an initial ACKNACK: another one (after the delay that `initial_acknack_interval`
/// says), nothing, or another one after 1 s; the last with the slip that it comes at once as long
/// as the clock is before the creation of the match.
enum class InitialAckNackRepeat : std::uint8_t { again, once, age_based, age_based_zero };
/// What ends initial ACKNACKs: the first HEARTBEAT, or one after which nothing is missing.
enum class InitialAckNackStop : std::uint8_t { any_heartbeat, complete };
/// What a writer does with a request for a descriptor that it has as acknowledged.
enum class AckedRequest : std::uint8_t { ignore, reopen, resend };
/// For which readers the periodic HEARTBEAT goes on: with a descriptor that is not acknowledged, or
/// with one in state U.
enum class HeartbeatCondition : std::uint8_t { not_acknowledged, in_u };
/// Whether a repair sends a HEARTBEAT of its own, and on which side of its DATA.
enum class RepairHeartbeat : std::uint8_t { none, before, after };
/// Which ordinary ACKNACKs are answered by a HEARTBEAT at once.
enum class AckNackReply : std::uint8_t { none, nonfinal, all };
/// What a reader says when it hears an announcement of somebody it knows.
enum class OnReannounce : std::uint8_t { none, ack_highest, ack_missing };
/// What an initial ACKNACK is after an ordinary one.
enum class LateInitial : std::uint8_t { reset, ignore_after_ack };
/// What a writer does with an ACKNACK that answers an old HEARTBEAT.
enum class StaleAckNack : std::uint8_t {
  process,
  latest_only,
  required_drop,
  required_gate,
  required_at_repair
};
/// When a reader asks again by itself.
enum class ReaderRetry : std::uint8_t { off, after_nack, whenever_missing };
/// How long a writer waits for the next HEARTBEAT: as `heartbeat_policy` of the profile says, or
/// twice as long as long as a reader that was asked is silent, else 1.1 times what they took to
/// answer.
enum class AmendedPolicy : std::uint8_t { of_the_profile, measured_ack };
/// Who is charged for DATA that piggyback HEARTBEATs are due for: as `piggyback` says, or the
/// participant, whose counter loses the threshold at each overflow.
enum class PiggybackAccount : std::uint8_t { of_the_profile, linear_group };

struct Amendments {
  Whether initial_acknack_resets = Whether::no;  ///< it un-acknowledges everything
  Whether initial_acknack_arms = Whether::no;    ///< its HEARTBEAT is followed by periodic ones
  InitialAckNackRepeat initial_acknack_repeat = InitialAckNackRepeat::again;
  InitialAckNackStop initial_acknack_stop = InitialAckNackStop::any_heartbeat;
  Nanoseconds match_clock_skew;  ///< by how much the creation of a match lies in the future
  LateInitial late_initial = LateInitial::reset;
  AckedRequest acked_request = AckedRequest::ignore;
  HeartbeatCondition heartbeat_condition = HeartbeatCondition::not_acknowledged;
  AmendedPolicy heartbeat_policy = AmendedPolicy::of_the_profile;
  Whether suppression_end_arms = Whether::yes;
  RepairHeartbeat repair_heartbeat = RepairHeartbeat::none;
  AckNackReply acknack_reply = AckNackReply::none;
  StaleAckNack stale_acknack = StaleAckNack::process;
  std::uint32_t count_filter = 0;  ///< ACKNACKs of a reader that forgot that count as old
  OnReannounce on_reannounce = OnReannounce::none;
  ReaderRetry reader_retry = ReaderRetry::off;
  Nanoseconds reader_retry_period{3'000'000'000};
  Nanoseconds reader_nack_delay;    ///< between two requests; 0: no such limit
  std::uint32_t resend_copies = 1;  ///< of an announcement to a participant that is recognised
  Nanoseconds resend_copy_period{1'000'000'000};
  PiggybackAccount piggyback_account = PiggybackAccount::of_the_profile;

  bool operator==(const Amendments&) const = default;
};

}  // namespace stormproof::model
