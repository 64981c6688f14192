// What the amended rules of the paper's implementation (fsm/composition/amended.hpp) are about
// beside the paper's own: their knobs, what a writer and a reader remember for them, and packets
// that say which HEARTBEAT an ACKNACK answers.
// Source: specs/guide/museum.md, "The amended rules".
#pragma once

#include "fsm/composition/paper.hpp"
#include "fsm/reopening_repair.hpp"

namespace stormproof::fsm::composition::amended {

/// The writer's view of a descriptor.
struct C : Part<ReopeningRepair, owner::descriptor> {};

/// A reader asks by itself; it can be cancelled.
struct ReaderRetryDue : TimerAtDestination<owner::relation> {};
/// Another copy of an announcement to a participant that was recognised.
struct CopyDue : Timer<owner::pair> {};

// Of initial ACKNACKs.
struct InitialResets : SwitchOf<"amendments.initial_acknack_resets", "true"> {};
struct InitialArms : SwitchOf<"amendments.initial_acknack_arms", "true"> {};
struct IgnoresLateInitial : SwitchOf<"amendments.late_initial", "ignore_after_ack"> {};
struct AsksOnce : SwitchOf<"amendments.initial_acknack_repeat", "once"> {};
struct AsksByAge : SwitchOf<"amendments.initial_acknack_repeat", "age_based", "age_based_zero"> {};
struct AsksAtOnceBeforeCreation : SwitchOf<"amendments.initial_acknack_repeat", "age_based_zero"> {
};
struct StopsWhenComplete : SwitchOf<"amendments.initial_acknack_stop", "complete"> {};
struct MatchClockSkew : DelayOf<"amendments.match_clock_skew"> {};
struct AgePeriod : FixedDelay<1'000'000'000> {};
// Of requests and repairs.
struct ReopensAcknowledged : SwitchOf<"amendments.acked_request", "reopen"> {};
struct ResendsAcknowledged : SwitchOf<"amendments.acked_request", "resend"> {};
struct OnlyInUWaits : SwitchOf<"amendments.heartbeat_condition", "in_u"> {};
struct SuppressionEndArms : SwitchOf<"amendments.suppression_end_arms", "true"> {};
struct HeartbeatBeforeRepair : SwitchOf<"amendments.repair_heartbeat", "before"> {};
struct HeartbeatAfterRepair : SwitchOf<"amendments.repair_heartbeat", "after"> {};
struct AnswersRequests : SwitchOf<"amendments.acknack_reply", "nonfinal"> {};
struct AnswersEachAckNack : SwitchOf<"amendments.acknack_reply", "all"> {};
struct LatestOnly : SwitchOf<"amendments.stale_acknack", "latest_only"> {};
struct RequiredDrops : SwitchOf<"amendments.stale_acknack", "required_drop"> {};
struct RequiredGates : SwitchOf<"amendments.stale_acknack", "required_gate"> {};
struct RequiredAtRepair : SwitchOf<"amendments.stale_acknack", "required_at_repair"> {};
// Of the clock of HEARTBEATs.
struct MeasuresAcks : SwitchOf<"amendments.heartbeat_policy", "measured_ack"> {};
struct ShortestMeasured : FixedDelay<10'000'000> {};
struct LongestMeasured : FixedDelay<10'000'000'000> {};
// Of readers.
struct AcksHighest : SwitchOf<"amendments.on_reannounce", "ack_highest"> {};
struct AcksMissing : SwitchOf<"amendments.on_reannounce", "ack_missing"> {};
struct RetriesAfterNack : SwitchOf<"amendments.reader_retry", "after_nack", "whenever_missing"> {};
struct RetriesWheneverMissing : SwitchOf<"amendments.reader_retry", "whenever_missing"> {};
struct RetryPeriod : DelayOf<"amendments.reader_retry_period"> {};
struct NackDelay : DelayOf<"amendments.reader_nack_delay"> {};
/// Of readers that come back: how many of their ACKNACKs count as those of an earlier life.
struct CountFilter : DelayOf<"amendments.count_filter"> {};
// Of announcements.
struct ResendCopies : DelayOf<"amendments.resend_copies"> {};  ///< how many, the first one included
struct ResendCopyPeriod : DelayOf<"amendments.resend_copy_period"> {};

/// The writer has written the sample: those that its participant starts with, and one for each
/// endpoint that was created or deleted since.
struct Exists : Flag<owner::entry> {
  static constexpr bool from_the_start = true;
};
struct WrittenLater : Flag<owner::entry> {};  ///< of those that exist: not one of the start

// What a writer remembers of a reader.
struct LastHeartbeat : Number<owner::relation> {};  ///< H, how many HEARTBEATs it has sent
struct Required : Number<owner::relation> {};       ///< q, which HEARTBEAT has to be answered
/// How many ACKNACKs count as those of an earlier life of the reader.
struct OldCounts : Number<owner::relation> {};
struct HasAnswered : Flag<owner::relation> {};  ///< an ordinary ACKNACK has come
struct Resent : Flag<owner::descriptor> {};     ///< acknowledged, and part of the next repair
// What a reader remembers.
/// It knows that the descriptor exists: those of the start from its announcement.
struct Known : Flag<owner::descriptor> {
  static constexpr bool from_the_start = true;
};
struct LastHeard : Number<owner::relation> {};  ///< the HEARTBEAT that it heard last
struct LastNack : Number<owner::relation> {};   ///< when it asked last, ns
struct HasAsked : Flag<owner::relation> {};
struct MatchedAt : Number<owner::relation> {};  ///< when the match counts as created, ns
struct CopiesLeft : Number<owner::pair> {};

struct HeartbeatNumber : PacketNumber {};
struct Answered : PacketNumber {};  ///< the HEARTBEAT that the ACKNACK answers

/// The ACKNACK is about the descriptor: its reader knew it.
struct Covers : DescriptorField {};

struct Heartbeat : Packet<owner::relation, HeartbeatNumber, Announces> {};
struct AckNack : Packet<owner::relation, Listed, BelowBase, IsInitial, Answered, Covers> {};

/// What a reader knows and lacks, which is what it can ask for.
inline constexpr auto is_lacking = [](auto& d) { return d(Known{}) && !d(X{}); };
struct Lacks : Fact {
  template <class W>
  static auto of(W& w) {
    return w.some(is_lacking);
  }
};

/// The reader has something to acknowledge that keeps the periodic HEARTBEAT going.
struct Waits : Fact {
  template <class W>
  static auto of(W& w) {
    return w(paper::WriterOpen{}) && w.some([](auto& d) {
      return d(Exists{}) && (d.in(C{}, is<descriptor_repair::U>) ||
                             (!d(OnlyInUWaits{}) && !d.in(C{}, is<descriptor_repair::A>)));
    });
  }
};
struct SomeReaderWaits : Fact {
  template <class W>
  static auto of(W& w) {
    return w.some_reader([](auto& r) { return r(Waits{}); });
  }
};
/// The reader asks no more by initial ACKNACKs.
struct AsksNoMore : Fact {
  template <class W>
  static auto of(W& w) {
    return w(HeartbeatSeen{}) && (!w(StopsWhenComplete{}) || !w(Lacks{}));
  }
};
/// The ACKNACK that arrives answers a HEARTBEAT before the required one: it requests nothing.
struct RequestsNothing : Fact {
  template <class W>
  static auto of(W& w) {
    return (w(RequiredGates{}) || w(RequiredAtRepair{})) && w(Required{}) > w(Answered{});
  }
};

}  // namespace stormproof::fsm::composition::amended
