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
struct InitialResets : Switch {};
struct InitialArms : Switch {};
struct IgnoresLateInitial : Switch {};
struct AsksOnce : Switch {};
struct AsksByAge : Switch {};
struct AsksAtOnceBeforeCreation : Switch {};
struct StopsWhenComplete : Switch {};
struct MatchClockSkew : Delay {};
struct AgePeriod : Delay {};  ///< 1 s
// Of requests and repairs.
struct ReopensAcknowledged : Switch {};
struct ResendsAcknowledged : Switch {};
struct OnlyInUWaits : Switch {};
struct SuppressionEndArms : Switch {};
struct HeartbeatBeforeRepair : Switch {};
struct HeartbeatAfterRepair : Switch {};
struct AnswersRequests : Switch {};
struct AnswersEachAckNack : Switch {};
struct LatestOnly : Switch {};
struct RequiredDrops : Switch {};
struct RequiredGates : Switch {};
struct RequiredAtRepair : Switch {};
// Of the clock of HEARTBEATs.
struct MeasuresAcks : Switch {};
struct ShortestMeasured : Delay {};  ///< 10 ms
struct LongestMeasured : Delay {};   ///< 10 s
// Of readers.
struct AcksHighest : Switch {};
struct AcksMissing : Switch {};
struct RetriesAfterNack : Switch {};
struct RetriesWheneverMissing : Switch {};
struct RetryPeriod : Delay {};
struct NackDelay : Delay {};
// Of participants that come and go.
/// How many ACKNACKs of a reader that came back count as those of its earlier life.
struct CountFilter : Delay {};
// Of announcements.
struct ResendCopies : Delay {};  ///< how many, the first one included
struct ResendCopyPeriod : Delay {};

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
