// Fast DDS 2.6.11 (specs/guide/fastdds.md, executed by model/fastdds): a writer serves all its
// readers, every delay is pending at most once, and what is repaired goes through one asynchronous
// queue per participant. Who owns which single-shot timer is what distinguishes it: the nack
// response is the writer's, the async run the participant's. `FastDds` is the whole composition.
#pragma once

#include <array>

#include "fsm/composition/announcements.hpp"
#include "fsm/composition/control.hpp"
#include "fsm/composition/fastdds_parts.hpp"
#include "fsm/composition/heartbeat_clock.hpp"
#include "fsm/composition/lookups.hpp"
#include "fsm/composition/reader.hpp"
#include "fsm/composition/single_shots.hpp"

namespace stormproof::fsm::composition::fastdds {

struct Implementation {
  using Data = fastdds::Data;
  using Heartbeat = fastdds::Heartbeat;
  using Waits = fastdds::Waits;
  using NeedsHeartbeat = fastdds::NeedsHeartbeat;
  using Exists = fastdds::Exists;
  using Created = fastdds::Created;
  static constexpr bool multicast_first = false;
  /// Readers are served in the order in which they were matched; otherwise by number.
  static constexpr bool serves_in_order_of_match = true;

  // The reader.
  /// DATA tells of every descriptor up to its highest. Descriptors are handed over in order, to be
  /// told to the application as soon as their types are known; those of one's own host matter only
  /// if types do.
  template <class W>
  static void learn_from_data(W& w) {
    w.set_each(Known{}, [](auto& d) {
      return d(Known{}) || d.some_from_here([](auto& e) { return e(Carries{}); });
    });
    w.when((w(CrossHost{}) || w(lookup::AsksForTypes{})) && !w(RunEnds{}), [&] {
      w.for_descriptors(
          [](auto& d) { return !d(HandedOver{}) && d.all_up_to([](auto& e) { return e(X{}); }); },
          [](auto& d) {
            d.set(HandedOver{}, typename W::Bool(true));
            const auto waits = d(lookup::AsksForTypes{}) && !d(lookup::KnowsType{});
            d.when(waits, [&] { d.call(lookup::WaitForType{}); });
            d.when(!waits, [&] { d.perform(control::OpenTopics{}); });
          });
      w.when(w(lookup::AsksForTypes{}),
             [&] { w.reverse([](auto& back) { back.call(lookup::AskForAll{}); }); });
    });
  }
  template <class W>
  static void learn_from_heartbeat(W& w) {
    w.set_each(Known{}, [](auto& d) { return d(Known{}) || d(Announces{}); });
  }
  template <class W>
  static void answer_later(W& w) {
    request<Reply, ResponseDelay, AckNackGeneration>(w);
  }
  template <class W, class Body>
  static void acknack_due(W& w, Body&& body) {
    expire<Reply>(w, body);
  }
  /// The base is the first missing descriptor; the bitmap lists what is missing of what is known.
  static auto bitmap() {
    return says(Says{Listed{}, [](auto& d) { return d(Known{}) && !d(X{}); }},
                Says{BelowBase{}, is_confirmed});
  }
  template <class W>
  static void emit_acknack(W& w) {
    w.emit(AckNack{}, bitmap());
  }
  /// It claims nothing.
  template <class W>
  static void emit_initial(W& w) {
    w.emit(AckNack{}, says(Says{IsInitial{}, typename W::Bool(true)}));
  }

  // The writer.
  /// The queue is left for now, because its participant stalls: its run counts as requested.
  template <class W>
  static void leave_queue(W& w) {
    request<AsyncRun, Immediately, AsyncRunDue>(w);
  }
  template <class W>
  static void heartbeat(W& w) {
    emit_heartbeat(w);
    w.perform(RefillBudget{});
  }
  template <class W>
  static void periodic(W& w) {
    w.perform(HeartbeatToAll{});
    w.perform(RefillBudget{});
  }
  template <class W>
  static void open_sides(W& w) {
    const auto builtin_first = w(OpensBuiltinFirst{});
    w.when(builtin_first, [&] { w.call(OpenBuiltin{}); });
    w.for_streams([](auto& r) {
      r.raise(ReaderOpens{});
      r.reverse([](auto& back) { back.raise(WriterOpens{}); });
    });
    w.when(!builtin_first, [&] { w.call(OpenBuiltin{}); });
  }

 private:
  /// What is built in beside the streams.
  struct OpenBuiltin : Procedure {
    template <class W>
    static void body(W& w) {
      w.when(w(CrossHost{}) || w(lookup::LooksUpTypes{}),
             [&] { w.perform(control::OpenTopics{}); });
    }
  };
};

using Clock = ClockRules<Implementation>;

/// A descriptor of the writer is put into a message for those whom it serves.
struct Deliver : Procedure {
  template <class W, class To>
  static void body(W& w, To to) {
    w.perform(Pack{}, to);
    w.for_readers([](auto& r) {
      r.when(To::serves(r), [&] {
        r.feed(C{}, on<change_for_reader::Serialized>);
        request<Suppression, SuppressionDuration, SuppressionEnd>(r);
      });
    });
    Clock::arm(w);
    w.perform(Charge{}, to);
  }
};

/// Descriptors that exist wait until the reader asks for them.
struct ReaderIsMatched : Rule<Happens<WriterOpens>> {
  template <class W>
  static void run(W& w) {
    w.when(!w(WriterOpen{}), [&] {
      w.set(WriterOpen{}, typename W::Bool(true));
      w.feed_each(C{}, on<change_for_reader::ReaderMatched>, no_input,
                  [](auto& d) { return d(Exists{}); });
      w.when(w(HasDescriptors{}), [&] { Clock::arm(w); });
      Implementation::heartbeat(w);
    });
  }
};

/// What is created after the match is pushed, in a message of its own.
struct DescriptorIsCreated : Rule<Happens<Created>> {
  template <class W>
  static void run(W& w) {
    w.set(Exists{}, typename W::Bool(true));
    w.when(w(HasReaders{}), [&] {
      w.for_readers([](auto& r) { r.feed(C{}, on<change_for_reader::Created>); });
      w.call(Deliver{}, ToAll{});
      w.perform(Flush{}, ToAll{});
    });
    w.perform(control::OpenTopics{});
  }
};

struct AckNackArrives : Rule<Received<AckNack>> {
  template <class W>
  static void run(W& w) {
    const auto open = w(WriterOpen{});
    w.when(open && w(IsInitial{}), [&] { initial(w); });
    w.when(open && !w(IsInitial{}), [&] { ordinary(w); });
  }

 private:
  /// The reader has seen no HEARTBEAT: the writer forgets what it took as acknowledged.
  template <class W>
  static void initial(W& w) {
    w.feed_each(C{}, on<change_for_reader::InitialAckNackReceived>);
    w.set(SomeConfirmed{}, typename W::Bool(false));
    Implementation::heartbeat(w);
    Clock::arm(w);
  }
  template <class W>
  static void ordinary(W& w) {
    const auto changes = w.feed_each(
        C{}, on<change_for_reader::AckNackReceived>,
        [](auto& d) {
          using D = typename std::remove_cvref_t<decltype(d)>::D;
          return ChangeForReaderIo::Input<D>{.listed = d(Listed{}) && !d(BelowBase{}),
                                             .below_base = d(BelowBase{})};
        },
        [](auto& d) { return d(Listed{}) || d(BelowBase{}); });
    const auto confirms = w.some([](auto& d) { return d(BelowBase{}); });
    w.set(SomeConfirmed{}, w(SomeConfirmed{}) || confirms);
    const auto requested = w.any(changes.requested);
    const auto asks = w.some([](auto& d) { return d(Listed{}); });
    w.when(requested, [&] { request<NackResponse, NackResponseDelay, NackResponseDue>(w); });
    w.when(!requested && asks, [&] { Clock::arm(w); });
    w.when(!asks, [&] { Clock::response(w); });
  }
};

struct NackResponds : Rule<Due<NackResponseDue>> {
  template <class W>
  static void run(W& w) {
    expire<NackResponse>(w, [&] {
      w.for_readers([](auto& r) {
        const auto changes = r.feed_each(C{}, on<change_for_reader::NackResponseDue>);
        r.perform(Enqueue{}, changes.enqueue);
      });
      w.when(w(QueueNotEmpty{}), [&] { request<AsyncRun, Immediately, AsyncRunDue>(w); });
    });
  }
};

struct QueueIsSent : Rule<Due<AsyncRunDue>> {
  template <class W>
  static void run(W& w) {
    expire<AsyncRun>(w, [&] {
      w.when(w(lookup::AsksForTypes{}), [&] { w.perform(lookup::SendSamples{}); });
      w.for_queue([](auto& entry) {
        entry.set(Enqueued{}, typename W::Bool(false));
        const auto wanted = entry.some_reader([](auto& r) { return ToRequesters::serves(r); });
        entry.when(wanted, [&] { entry.call(Deliver{}, ToRequesters{}); });
      });
      w.perform(Flush{}, ToRequesters{});
    });
  }
};

struct SuppressionEnds : Rule<Due<SuppressionEnd>> {
  template <class W>
  static void run(W& w) {
    expire<Suppression>(w, [&] {
      w.feed_each(C{}, on<change_for_reader::SuppressionEnded>);
      Clock::arm(w);
    });
  }
};

/// The whole composition.
struct FastDds : Implementation {
  static constexpr std::string_view name = "fastdds";
  using AckNack = fastdds::AckNack;
  using Parts = Joined<TypeList<AnnouncementTimer, Reader, InitialTimer, Reply, C, Suppression,
                                NackResponse, AsyncRun, HeartbeatClock>,
                       control::Parts, lookup::Parts>;
  using Timers = Joined<
      TypeList<Announcement, AckNackGeneration, InitialAttempt, SuppressionEnd, NackResponseDue,
               AsyncRunDue, HeartbeatExpiry, CycleStart, CycleEnd, BatchDue>,
      control::Timers, lookup::Timers>;
  using State =
      Joined<TypeList<AnnouncementsSent, Recognised, X, HeartbeatSeen, LastDelay, Known, HandedOver,
                      WaitsForType, WriterOpen, Exists, Enqueued, SomeConfirmed, CycleBegan,
                      CyclePeriod, Contacted, Responded, AnnouncedAtStart>,
             control::State, lookup::State>;
  using Packets = Joined<TypeList<SpdpMulticast, SpdpUnicast, Data, Heartbeat, AckNack>,
                         control::Packets, lookup::Packets>;
  using Occasions =
      Joined<TypeList<ReaderOpens, WriterOpens, Created>, control::Occasions, lookup::Occasions>;
  /// Rules that only make the occasions happen, those of relations and writers, and those of the
  /// control-only relations, which share nothing with the former unless types are asked for.
  using Announcing = AnnouncementRules<Implementation>::Rules;
  using Exchange = Joined<ReaderRules<Implementation>::Rules,
                          TypeList<ReaderIsMatched, DescriptorIsCreated, AckNackArrives,
                                   NackResponds, QueueIsSent, SuppressionEnds>,
                          Clock::Rules>;
  using Rules = Joined<Announcing, Exchange, control::Rules, lookup::Rules>;
  using IsOpen = WriterOpen;
  using IsQueued = Enqueued;
  static constexpr std::array unused{
      Unused{"HeartbeatClock", "SuppressionEnded",
             "the end of a suppression arms as all else does"},
      Unused{"ControlWriterSide", "start_initial", "the reader side's, in the same outbox"},
      Unused{"ControlWriterSide", "reply", "the reader side's, in the same outbox"},
      Unused{"ControlReaderSide", "send_heartbeat", "the writer side's, in the same outbox"},
  };
  static constexpr std::array from_outside{
      announcements_start,
      FromOutside{"Created", "the application creates endpoints"},
  };
};

}  // namespace stormproof::fsm::composition::fastdds
