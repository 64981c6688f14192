// The paper's implementation (SEMANTICS of specs/guide/model.md, executed by model/paper): each
// relation repairs by itself, and each cause schedules an event of its own. `Paper` is the whole
// composition.
#pragma once

#include <array>

#include "fsm/composition/announcements.hpp"
#include "fsm/composition/heartbeat_clock.hpp"
#include "fsm/composition/reader.hpp"
#include "fsm/descriptor_repair.hpp"

namespace stormproof::fsm::composition::paper {

/// The writer's view of a descriptor, the paper's letter.
struct C : Part<DescriptorRepair, owner::descriptor> {};

struct WriterOpen : Flag<owner::relation> {};
struct RepairGeneration : Timer<owner::relation> {};
struct SuppressionEnd : Timer<owner::relation> {};

struct NackResponseDelay : DelayOf<"sedp.nack_response_delay"> {};          ///< τ_N
struct SuppressionDuration : DelayOf<"sedp.nack_suppression_duration"> {};  ///< τ_S
struct PushesInitialData : SwitchOf<"sedp.initial_data", "push"> {};
struct PrefixOnly : SwitchOf<"sedp.acknowledge", "prefix"> {};
// What an initial ACKNACK is to the writer: an ACKNACK as any other, or a call for a HEARTBEAT;
// none of them: nothing.
struct InitialCountsAsAckNack : SwitchOf<"sedp.initial_acknack", "bitmap"> {};
struct InitialIsAnsweredByHeartbeat : SwitchOf<"sedp.initial_acknack", "heartbeat"> {};
struct HeartbeatToMatched : SwitchOf<"sedp.heartbeat_recipients", "matched"> {};
struct ReceiverOpensBothSides : SwitchOf<"sedp.relation_opening", "receiver"> {};

struct Data : Packet<owner::relation, Carries, IsRepair, CarriesHeartbeat> {};
struct Heartbeat : Packet<owner::relation> {};
struct AckNack : Packet<owner::relation, Listed, BelowBase, IsInitial> {};

struct WriterOpens : Occasion<owner::relation> {};

/// The reader has not acknowledged everything.
struct Waits : Fact {
  template <class W>
  static auto of(W& w) {
    return w(WriterOpen{}) && w.some([](auto& d) { return !d.in(C{}, is<descriptor_repair::A>); });
  }
};
struct SomeReaderWaits : Fact {
  template <class W>
  static auto of(W& w) {
    return w.some_reader([](auto& r) { return r(Waits{}); });
  }
};

/// A HEARTBEAT to every open relation of the writer, or to those whose readers wait. A host may
/// keep those to all as one record.
struct HeartbeatToRecipients : Opaque {
  template <class W>
  static void contract(W& w) {
    w.for_readers([](auto& r) {
      r.when(r(HeartbeatToMatched{}) || r(Waits{}), [&] {
        r.perform(RefillBudget{});
        r.emit(Heartbeat{}, says());
      });
    });
  }
};
/// Descriptors are put into DATA packets, filled in ascending order up to the grouping limit and
/// charged against the piggyback budget. A budget that is used up sends a HEARTBEAT to every open
/// relation of the writer: in the packet if there is only one, otherwise after the packet as it is.
struct Generate : Opaque {
  template <class W>
  static void contract(W& w, const typename W::Set& set, const typename W::Bool& repair) {
    w.partition(set, [&](const auto& part) {
      const auto rides = w.choice("a HEARTBEAT rides in it");
      w.emit(Data{}, says(Says{Carries{}, [&](auto& d) { return d.is_in(part); }},
                          Says{IsRepair{}, repair}, Says{CarriesHeartbeat{}, rides}));
      w.when(w.choice("the budget is used up") && !rides,
             [&] { w.for_readers([](auto& r) { r.emit(Heartbeat{}, says()); }); });
    });
  }
};

struct Implementation : AnswersEachHeartbeat {
  using Data = paper::Data;
  using Heartbeat = paper::Heartbeat;
  using Waits = paper::Waits;
  using NeedsHeartbeat = SomeReaderWaits;
  struct Exists : Fact {
    template <class W>
    static auto of(W&) {
      return typename W::Bool(true);
    }
  };
  static constexpr bool multicast_first = true;

  // The reader.
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
    w.perform(RefillBudget{});
    w.emit(Heartbeat{}, says());
  }
  template <class W>
  static void periodic(W& w) {
    w.perform(HeartbeatToRecipients{});
  }
  template <class W>
  static void open_sides(W& w) {
    w.for_streams([](auto& r) { r.raise(ReaderOpens{}); });
    w.when(w(ReceiverOpensBothSides{}),
           [&] { w.for_streams([](auto& r) { r.raise(WriterOpens{}); }); });
    w.when(!w(ReceiverOpensBothSides{}), [&] {
      w.reverse([](auto& back) { back.for_streams([](auto& r) { r.raise(WriterOpens{}); }); });
    });
  }

 private:
  template <class W>
  static void emit_bitmap(W& w, const typename W::Bool& initial) {
    w.emit(AckNack{}, std::tuple_cat(bitmap(), says(Says{IsInitial{}, initial})));
  }
};

using Clock = ClockRules<Implementation>;

struct WriterSideOpens : Rule<Happens<WriterOpens>> {
  template <class W>
  static void run(W& w) {
    w.when(!w(WriterOpen{}), [&] {
      w.set(WriterOpen{}, typename W::Bool(true));
      w.when(w(PushesInitialData{}),
             [&] { w.perform(Generate{}, w.set_of(everyone), typename W::Bool(false)); });
      Implementation::heartbeat(w);
      Clock::arm(w);
    });
  }
};

struct AckNackArrives : Rule<Received<AckNack>> {
  template <class W>
  static void run(W& w) {
    const auto open = w(WriterOpen{});
    const auto ordinary = !w(IsInitial{}) || w(InitialCountsAsAckNack{});
    w.when(open && !ordinary && w(InitialIsAnsweredByHeartbeat{}),
           [&] { Implementation::heartbeat(w); });
    w.when(open && ordinary, [&] {
      const auto changes = w.feed_each(C{}, on<descriptor_repair::AckNackReceived>, [](auto& d) {
        using D = typename std::remove_cvref_t<decltype(d)>::D;
        return DescriptorRepairIo::Input<D>{.listed = d(Listed{}),
                                            .below_first_missing = d(BelowBase{}),
                                            .prefix_only = d(PrefixOnly{})};
      });
      w.when(w.any(changes.requested), [&] { w.after(NackResponseDelay{}, RepairGeneration{}); });
      w.when(!w.some([](auto& d) { return d(Listed{}); }), [&] { Clock::response(w); });
    });
  }
};

struct RepairIsDue : Rule<Due<RepairGeneration>> {
  template <class W>
  static void run(W& w) {
    const auto changes = w.feed_each(C{}, on<descriptor_repair::RepairDue>);
    w.when(w.any(changes.generate),
           [&] { w.perform(Generate{}, changes.generate, typename W::Bool(true)); });
  }
};

struct RepairHasLeft : Rule<LeftSource<Data>> {
  template <class W>
  static void run(W& w) {
    w.when(w(IsRepair{}), [&] {
      w.feed_each(C{}, on<descriptor_repair::RepairSent>, no_input,
                  [](auto& d) { return d(Carries{}); });
      w.after(SuppressionDuration{}, SuppressionEnd{});
    });
  }
};

struct SuppressionEnds : Rule<Due<SuppressionEnd>> {
  template <class W>
  static void run(W& w) {
    const auto changes = w.feed_each(C{}, on<descriptor_repair::SuppressionEnded>);
    w.when(w.any(changes.returned), [&] { Clock::suppression_ended(w); });
  }
};

/// The whole composition.
struct Paper : Implementation {
  static constexpr std::string_view name = "paper";
  using AckNack = paper::AckNack;
  using Parts = TypeList<AnnouncementTimer, Reader, InitialTimer, C, HeartbeatClock>;
  using Timers = TypeList<Announcement, AckNackGeneration, InitialAttempt, RepairGeneration,
                          SuppressionEnd, HeartbeatExpiry, CycleStart, CycleEnd, BatchDue>;
  using State = TypeList<AnnouncementsSent, Recognised, X, HeartbeatSeen, LastDelay, WriterOpen,
                         CycleBegan, CyclePeriod, Contacted, Responded, AnnouncedAtStart>;
  using Packets = TypeList<SpdpMulticast, SpdpUnicast, Data, Heartbeat, AckNack>;
  using Occasions = TypeList<ReaderOpens, WriterOpens>;
  /// Rules that only make the occasions happen, and those of relations and writers.
  using Announcing = AnnouncementRules<Implementation>::Rules;
  using Exchange =
      Joined<ReaderRules<Implementation>::Rules,
             TypeList<WriterSideOpens, AckNackArrives, RepairIsDue, RepairHasLeft, SuppressionEnds>,
             Clock::Rules>;
  using Rules = Joined<Announcing, Exchange>;
  using IsOpen = WriterOpen;
  static constexpr std::array<Unused, 0> unused{};
  static constexpr std::array from_outside{announcements_start};
};

}  // namespace stormproof::fsm::composition::paper
