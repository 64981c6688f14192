// The paper's implementation with amended rules: what writers and readers of Fast DDS, Cyclone DDS,
// OpenDDS and Connext did before or after a defect was repaired, each a knob of the profile
// (model/amendments.hpp). With every knob at its default it is the paper's composition
// (fsm/composition/paper.hpp), from which it takes whatever no knob changes. `Amended` is the whole
// composition.
// Source: specs/guide/museum.md, "The amended rules".
#pragma once

#include <array>

#include "fsm/composition/amended_clock.hpp"
#include "fsm/composition/amended_life.hpp"
#include "fsm/composition/amended_parts.hpp"

namespace stormproof::fsm::composition::amended {

using paper::Data;
using paper::WriterOpen;
using paper::WriterOpens;

/// One to the reader, which has a number.
struct SendHeartbeat : Procedure {
  template <class W>
  static void body(W& w) {
    w.perform(RefillBudget{});
    w.set(LastHeartbeat{}, w(LastHeartbeat{}) + 1);
    w.emit(Heartbeat{}, says(Says{HeartbeatNumber{}, w(LastHeartbeat{})},
                             Says{Announces{}, [](auto& d) { return d(Exists{}); }}));
  }
};

/// A reader that may ask again by itself, and that may have to wait before it does.
struct RetryAfterNack : Procedure {
  template <class W>
  static void body(W& w) {
    w.set(LastNack{}, w(Now{}));
    w.set(HasAsked{}, typename W::Bool(true));
    w.when(w(RetriesAfterNack{}), [&] {
      w.cancel(ReaderRetryDue{});
      w.after(RetryPeriod{}, ReaderRetryDue{});
    });
  }
};
struct RetryAfterDelay : Procedure {
  template <class W>
  static void body(W& w) {
    w.cancel(ReaderRetryDue{});
    w.at(w(LastNack{}) + w(NackDelay{}), ReaderRetryDue{});
  }
};

struct Implementation : AnswersEachHeartbeat {
  using Data = paper::Data;
  using Heartbeat = amended::Heartbeat;
  using Waits = amended::Waits;
  using NeedsHeartbeat = SomeReaderWaits;
  using Exists = amended::Exists;
  static constexpr bool multicast_first = paper::Implementation::multicast_first;

  // The reader.
  /// Samples have numbers: those before one that has come exist.
  template <class W>
  static void learn_from_data(W& w) {
    w.set_each(Known{}, [](auto& d) {
      return d(Known{}) || d.some_from_here([](auto& e) { return e(Carries{}); });
    });
  }
  template <class W>
  static void learn_from_heartbeat(W& w) {
    w.set(LastHeard{}, w(HeartbeatNumber{}));
    w.set_each(Known{}, [](auto& d) { return d(Known{}) || d(Announces{}); });
  }
  /// A HEARTBEAT stands for the reader's own question.
  template <class W>
  static void answer_later(W& w) {
    w.when(w(RetriesAfterNack{}), [&] { w.cancel(ReaderRetryDue{}); });
    w.after(ResponseDelay{}, AckNackGeneration{});
  }
  template <class W, class Body>
  static void acknack_due(W& w, Body&& body) {
    const auto asks = w(Lacks{});
    const auto too_early = asks && w(HasAsked{}) && w(LastNack{}) + w(NackDelay{}) > w(Now{});
    w.when(!too_early, body);
    w.when(asks && !too_early, [&] { w.call(RetryAfterNack{}); });
    w.when(too_early && w(RetriesWheneverMissing{}), [&] { w.call(RetryAfterDelay{}); });
  }
  static auto bitmap() {
    return says(Says{Listed{}, is_lacking}, Says{BelowBase{}, is_confirmed},
                Says{Covers{}, [](auto& d) { return d(Known{}); }});
  }
  template <class W>
  static void emit_acknack(W& w) {
    emit_bitmap(w, typename W::Bool(false));
  }
  template <class W>
  static void emit_initial(W& w) {
    emit_bitmap(w, typename W::Bool(true));
  }

  // The writer.
  template <class W>
  static void heartbeat(W& w) {
    w.call(SendHeartbeat{});
  }
  template <class W>
  static void periodic(W& w) {
    w.for_readers([](auto& r) {
      r.when(r(paper::HeartbeatToMatched{}) || r(Waits{}), [&] { heartbeat(r); });
    });
  }
  template <class W>
  static void open_sides(W& w) {
    paper::Implementation::open_sides(w);
  }

 private:
  template <class W>
  static void emit_bitmap(W& w, const typename W::Bool& initial) {
    w.emit(AckNack{}, std::tuple_cat(bitmap(), says(Says{IsInitial{}, initial},
                                                    Says{Answered{}, w(LastHeard{})})));
  }
};

using Clock = MeasuredClock<Implementation>;
using SharedReader = ReaderRules<Implementation>;
using SharedAnnouncements = AnnouncementRules<Implementation>;

/// The destination of the pair knew its source before the announcement that it hears.
struct WasKnown : Flag<owner::pair> {};
/// The writer of a relation, whom its reader knows, announces itself.
struct AnnouncedAgain : Occasion<owner::relation> {};

// The reader. -------------------------------------------------------------------------------------

template <class Event, class W>
auto ask(W& w) {
  return w.feed(Reader{}, on<Event>,
                {.accepts_unmatched = w(AcceptsUnmatched{}), .missing_after = w(Missing{})});
}
template <class Event, class W>
auto ask_timer(W& w) {
  return w.feed(InitialTimer{}, on<Event>,
                {.now = w(Now{}),
                 .first_delay = w(InitialDelay{}),
                 .last_delay = w(LastDelay{}),
                 .heartbeat_seen = w(AsksNoMore{}),
                 .constant = w(ConstantInterval{})});
}

struct ReaderOpened : Rule<Happens<ReaderOpens>> {
  template <class W>
  static void run(W& w) {
    const auto reader = ask<discovery_reader::AnnouncementReceived>(w);
    w.when(reader.opened, [&] {
      w.set(MatchedAt{}, w(Now{}) + w(MatchClockSkew{}));
      const auto timer = ask_timer<initial_acknack::ReaderOpened>(w);
      w.when(timer.schedule, [&] {
        w.set(LastDelay{}, timer.next_delay);
        w.at(timer.next_at, InitialAttempt{});
      });
    });
  }
};

struct InitialAckNackDue : Rule<Due<InitialAttempt>> {
  template <class W>
  static void run(W& w) {
    const auto timer = ask_timer<initial_acknack::AttemptDue>(w);
    w.when(timer.attempt, [&] {
      const auto reader = ask<discovery_reader::InitialAckNackDue>(w);
      w.when(reader.send_initial, [&] { Implementation::emit_initial(w); });
    });
    const auto at_once = w(AsksAtOnceBeforeCreation{}) && w(MatchedAt{}) > w(Now{});
    w.when(timer.schedule && !w(AsksOnce{}), [&] {
      w.set(LastDelay{}, timer.next_delay);
      w.when(!w(AsksByAge{}), [&] { w.at(timer.next_at, InitialAttempt{}); });
      w.when(w(AsksByAge{}) && !at_once, [&] { w.after(AgePeriod{}, InitialAttempt{}); });
      w.when(w(AsksByAge{}) && at_once, [&] { w.at(w(Now{}), InitialAttempt{}); });
    });
  }
};

struct DataArrives : Rule<Received<Data>> {
  template <class W>
  static void run(W& w) {
    SharedReader::DataArrives::run(w);
    w.call(HearFrom{});
  }
};
struct HeartbeatArrives : Rule<Received<Heartbeat>> {
  template <class W>
  static void run(W& w) {
    SharedReader::HeartbeatArrives::run(w);
    w.call(HearFrom{});
  }
};

struct ReaderRetries : Rule<Due<ReaderRetryDue>> {
  template <class W>
  static void run(W& w) {
    w.when(w(Lacks{}), [&] {
      Implementation::acknack_due(w, [&] {
        const auto reader = ask<discovery_reader::AckNackDue>(w);
        w.when(reader.send_acknack, [&] { Implementation::emit_acknack(w); });
      });
    });
  }
};

// The writer. -------------------------------------------------------------------------------------

struct WriterSideOpens : Rule<Happens<WriterOpens>> {
  template <class W>
  static void run(W& w) {
    w.when(!w(WriterOpen{}), [&] {
      w.set(WriterOpen{}, typename W::Bool(true));
      w.when(w(paper::PushesInitialData{}), [&] {
        const auto all = w.set_of([](auto& d) { return d(Exists{}); });
        w.perform(paper::Generate{}, all, typename W::Bool(false));
      });
      Implementation::heartbeat(w);
      Clock::arm(w);
    });
  }
};

/// A descriptor comes into being, or the sample that disposes of one; readers take them alike.
struct EndpointChanges : Rule<Happens<Written>> {
  template <class W>
  static void run(W& w) {
    w.set(Exists{}, typename W::Bool(true));
    w.set(WrittenLater{}, typename W::Bool(true));
    w.for_readers([](auto& r) {
      r.when(r(paper::PushesInitialData{}), [&] {
        const auto it = r.set_of([](auto& d) { return d.is_subject(); });
        r.perform(paper::Generate{}, it, typename W::Bool(false));
      });
    });
    Clock::arm(w);
  }
};

/// An initial ACKNACK that calls for a HEARTBEAT.
struct AnswerInitial : Procedure {
  template <class W>
  static void body(W& w) {
    w.when(w(InitialResets{}), [&] { w.feed_each(C{}, on<reopening_repair::ReaderForgot>); });
    Implementation::heartbeat(w);
    w.when(w(InitialArms{}), [&] { Clock::arm(w); });
  }
};

/// What is acknowledged and asked for all the same.
struct TakeRequestsAgain : Procedure {
  template <class W>
  static void body(W& w) {
    w.when(w(ReopensAcknowledged{}), [&] {
      const auto again = w.feed_each(C{}, on<reopening_repair::RequestedAgain>, no_input,
                                     [](auto& d) { return d(Listed{}) && !d(RequestsNothing{}); });
      w.when(w.any(again.requested),
             [&] { w.after(paper::NackResponseDelay{}, paper::RepairGeneration{}); });
    });
    const auto asked_again = [](auto& d) {
      return d(Listed{}) && !d(RequestsNothing{}) && d.in(C{}, is<descriptor_repair::A>);
    };
    w.when(w(ResendsAcknowledged{}) && w.some(asked_again), [&] {
      w.set_each(Resent{}, [&](auto& d) { return d(Resent{}) || asked_again(d); });
      w.after(paper::NackResponseDelay{}, paper::RepairGeneration{});
    });
  }
};

/// An ordinary ACKNACK, or an initial one that counts as such.
struct TakeAckNack : Procedure {
  template <class W>
  static void body(W& w) {
    w.set(HasAnswered{}, typename W::Bool(true));
    const auto changes = w.feed_each(
        C{}, on<descriptor_repair::AckNackReceived>,
        [](auto& d) {
          using D = typename std::remove_cvref_t<decltype(d)>::D;
          return DescriptorRepairIo::Input<D>{.listed = d(Listed{}),
                                              .below_first_missing = d(BelowBase{}),
                                              .prefix_only = d(paper::PrefixOnly{})};
        },
        [](auto& d) { return d(Covers{}) && (!d(Listed{}) || !d(RequestsNothing{})); });
    w.when(w.any(changes.requested),
           [&] { w.after(paper::NackResponseDelay{}, paper::RepairGeneration{}); });
    w.call(TakeRequestsAgain{});
    const auto requests = w.some([](auto& d) { return d(Listed{}); });
    w.when((w(RequiredDrops{}) || w(RequiredGates{})) && !(w(Required{}) > w(Answered{})),
           [&] { w.set(Required{}, w(LastHeartbeat{})); });
    w.when(w(AnswersEachAckNack{}) || (w(AnswersRequests{}) && requests),
           [&] { Implementation::heartbeat(w); });
    w.when(!requests, [&] { Clock::response(w); });
    Clock::answered(w);
  }
};

struct AckNackArrives : Rule<Received<AckNack>> {
  template <class W>
  static void run(W& w) {
    w.reverse([](auto& back) { back.call(HearFrom{}); });
    const auto open = w(WriterOpen{});
    const auto is_old = open && w(OldCounts{}) > 0;
    const auto heard = open && !is_old;
    const auto ordinary = !w(IsInitial{}) || w(paper::InitialCountsAsAckNack{});
    const auto late = w(IgnoresLateInitial{}) && w(HasAnswered{});
    const auto discarded = (w(LatestOnly{}) && w(LastHeartbeat{}) > w(Answered{})) ||
                           (w(RequiredDrops{}) && w(Required{}) > w(Answered{}));
    w.when(is_old, [&] { w.set(OldCounts{}, w(OldCounts{}) - 1); });
    w.when(heard && !ordinary && w(paper::InitialIsAnsweredByHeartbeat{}) && !late,
           [&] { w.call(AnswerInitial{}); });
    w.when(heard && ordinary && !discarded, [&] { w.call(TakeAckNack{}); });
  }
};

struct RepairIsDue : Rule<Due<paper::RepairGeneration>> {
  template <class W>
  static void run(W& w) {
    const auto changes = w.feed_each(C{}, on<descriptor_repair::RepairDue>);
    const auto again = w.some([](auto& d) { return d(Resent{}); });
    w.when(w.any(changes.generate) || again, [&] {
      w.when(w(HeartbeatBeforeRepair{}), [&] { Implementation::heartbeat(w); });
      const auto& generated = changes.generate;
      w.perform(paper::Generate{},
                w.set_of([&](auto& d) { return d.is_in(generated) || d(Resent{}); }),
                typename W::Bool(true));
      w.when(w(HeartbeatAfterRepair{}), [&] { Implementation::heartbeat(w); });
      w.when(w(RequiredAtRepair{}), [&] { w.set(Required{}, w(LastHeartbeat{})); });
      w.set_each(Resent{}, [](auto& d) { return !everyone(d); });
    });
  }
};

struct RepairHasLeft : Rule<LeftSource<Data>> {
  template <class W>
  static void run(W& w) {
    w.when(w(IsRepair{}), [&] {
      w.feed_each(C{}, on<descriptor_repair::RepairSent>, no_input,
                  [](auto& d) { return d(Carries{}); });
      w.after(paper::SuppressionDuration{}, paper::SuppressionEnd{});
    });
  }
};

struct SuppressionEnds : Rule<Due<paper::SuppressionEnd>> {
  template <class W>
  static void run(W& w) {
    const auto changes = w.feed_each(C{}, on<descriptor_repair::SuppressionEnded>);
    w.when(w.any(changes.returned) && w(SuppressionEndArms{}),
           [&] { Clock::suppression_ended(w); });
  }
};

// Announcements. ----------------------------------------------------------------------------------

/// Somebody whom the reader knows announces itself again. The reader may say what it has:
/// correctly, or with everything below the highest that it has as received.
struct AnswerAnnouncement : Rule<Happens<AnnouncedAgain>> {
  template <class W>
  static void run(W& w) {
    const auto has_some = w.some([](auto& d) { return d(X{}); });
    w.when(w(AcksMissing{}) && has_some, [&] { Implementation::emit_acknack(w); });
    w.when(w(AcksHighest{}) && has_some, [&] {
      const auto above = [](auto& d) {
        return is_lacking(d) && !d.some_from_here([](auto& e) { return e(X{}); });
      };
      const auto below = [](auto& d) {
        return d(X{}) || d.some_from_here([](auto& e) { return e(X{}); });
      };
      w.emit(AckNack{},
             says(Says{Listed{}, above}, Says{BelowBase{}, below},
                  Says{IsInitial{}, typename W::Bool(false)}, Says{Answered{}, w(LastHeard{})},
                  Says{Covers{}, [](auto& d) { return d(Known{}); }}));
    });
  }
};
/// More copies of the answer to a participant that is recognised.
struct CopyAgain : Procedure {
  template <class W>
  static void body(W& w) {
    w.reverse([](auto& back) {
      back.set(CopiesLeft{}, back(ResendCopies{}) - 1);
      back.when(back(ResendCopies{}) > 1, [&] { back.after(ResendCopyPeriod{}, CopyDue{}); });
    });
  }
};

/// `Usual` is the rule of the paper for the same packet.
template <class Usual, class W>
void hear(W& w) {
  w.set(WasKnown{}, w(Recognised{}));
  Usual::run(w);
  w.call(HearFrom{});
  w.when(w(WasKnown{}) && (w(AcksHighest{}) || w(AcksMissing{})),
         [&] { w.for_streams([](auto& r) { r.raise(AnnouncedAgain{}); }); });
  w.when(!w(WasKnown{}) && w(ResendsCopy{}), [&] { w.call(CopyAgain{}); });
}
struct MulticastArrives : Rule<Received<SpdpMulticast>> {
  template <class W>
  static void run(W& w) {
    hear<SharedAnnouncements::MulticastArrives>(w);
  }
};
struct UnicastArrives : Rule<Received<SpdpUnicast>> {
  template <class W>
  static void run(W& w) {
    hear<SharedAnnouncements::UnicastArrives>(w);
  }
};
struct CopyIsDue : Rule<Due<CopyDue>> {
  template <class W>
  static void run(W& w) {
    w.emit(SpdpUnicast{}, says());
    w.set(CopiesLeft{}, w(CopiesLeft{}) - 1);
    w.when(w(CopiesLeft{}) > 0, [&] { w.after(ResendCopyPeriod{}, CopyDue{}); });
  }
};

/// The whole composition.
struct Amended : Implementation {
  static constexpr std::string_view name = "paper-amended";
  using AckNack = amended::AckNack;
  using Parts = TypeList<AnnouncementTimer, Reader, InitialTimer, C, HeartbeatClock>;
  using Timers = TypeList<Announcement, AckNackGeneration, InitialAttempt, paper::RepairGeneration,
                          paper::SuppressionEnd, HeartbeatExpiry, CycleStart, CycleEnd, BatchDue,
                          ReaderRetryDue, CopyDue, LeaseCheck, Return>;
  using State =
      TypeList<AnnouncementsSent, Recognised, X, HeartbeatSeen, LastDelay, WriterOpen, CycleBegan,
               CyclePeriod, Contacted, Responded, AnnouncedAtStart, Resent, Known, Exists,
               WrittenLater, LastHeartbeat, Required, OldCounts, HasAnswered, LastHeard, LastNack,
               HasAsked, MatchedAt, CopiesLeft, WasKnown, ForgottenAt, LeaseRuns>;
  using Packets = TypeList<SpdpMulticast, SpdpUnicast, Data, Heartbeat, AckNack>;
  using Occasions = TypeList<ReaderOpens, WriterOpens, AnnouncedAgain, Written>;
  using Reading = TypeList<AnswerAnnouncement, ReaderOpened, InitialAckNackDue, DataArrives,
                           HeartbeatArrives, SharedReader::AckNackDue, ReaderRetries>;
  using Writing =
      Joined<TypeList<WriterSideOpens, AckNackArrives, RepairIsDue, RepairHasLeft, SuppressionEnds>,
             Clock::Rules>;
  /// Those of relations and writers whose participants stay.
  using Exchange = Joined<Reading, Writing>;
  using Rules = Joined<
      TypeList<SharedAnnouncements::AnnouncementIsDue, MulticastArrives, UnicastArrives, CopyIsDue>,
      Reading, TypeList<Life::LeaseIsChecked, Life::Returns, EndpointChanges>, Writing>;
  using IsOpen = WriterOpen;
  static constexpr std::array<Unused, 0> unused{};
  static constexpr std::array from_outside{participant_returns, endpoint_changes};
};

}  // namespace stormproof::fsm::composition::amended
