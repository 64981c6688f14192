// A third implementation, to see that one is a file of rules: its writer pushes all that it has
// when a reader is matched, with a HEARTBEAT, and never repeats anything; it only notes what is
// acknowledged. Readers are those of all implementations. Nothing outside tests knows of it.
#pragma once

#include <array>

#include "fsm/composition/announcements.hpp"
#include "fsm/composition/reader.hpp"
#include "fsm/descriptor_repair.hpp"

namespace stormproof::fsm::composition::push_once {

/// The writer's view of a descriptor; of its letters only U and A are reached.
struct C : Part<DescriptorRepair, owner::descriptor> {};

struct WriterOpen : Flag<owner::relation> {};

struct Data : Packet<owner::relation, Carries, IsRepair, CarriesHeartbeat> {};
struct Heartbeat : Packet<owner::relation> {};
struct AckNack : Packet<owner::relation, Listed, BelowBase, IsInitial> {};

struct WriterOpens : Occasion<owner::relation> {};

/// Every descriptor in some DATA.
struct Push : Opaque {
  template <class W>
  static void contract(W& w) {
    w.partition(w.set_of(everyone), [&](const auto& part) {
      w.emit(Data{}, says(Says{Carries{}, [&](auto& d) { return d.is_in(part); }}));
    });
  }
};

struct Implementation : AnswersEachHeartbeat {
  using Data = push_once::Data;
  using Heartbeat = push_once::Heartbeat;
  static constexpr bool multicast_first = true;

  template <class W>
  static void emit_acknack(W& w) {
    w.emit(AckNack{}, bitmap());
  }
  template <class W>
  static void emit_initial(W& w) {
    w.emit(AckNack{}, says(Says{IsInitial{}, typename W::Bool(true)}));
  }
  template <class W>
  static void open_sides(W& w) {
    w.for_streams([](auto& r) {
      r.raise(ReaderOpens{});
      r.raise(WriterOpens{});
    });
  }
};

struct WriterSideOpens : Rule<Happens<WriterOpens>> {
  template <class W>
  static void run(W& w) {
    w.when(!w(WriterOpen{}), [&] {
      w.set(WriterOpen{}, typename W::Bool(true));
      w.perform(Push{});
      w.emit(Heartbeat{}, says());
    });
  }
};

struct AckNackArrives : Rule<Received<AckNack>> {
  template <class W>
  static void run(W& w) {
    w.when(w(WriterOpen{}) && !w(IsInitial{}), [&] {
      w.feed_each(C{}, on<descriptor_repair::AckNackReceived>, [](auto& d) {
        using D = typename std::remove_cvref_t<decltype(d)>::D;
        return DescriptorRepairIo::Input<D>{
            .listed = false, .below_first_missing = d(BelowBase{}), .prefix_only = true};
      });
    });
  }
};

struct PushOnce : Implementation {
  static constexpr std::string_view name = "push-once";
  using AckNack = push_once::AckNack;
  using Parts = TypeList<AnnouncementTimer, Reader, InitialTimer, C>;
  using Timers = TypeList<Announcement, AckNackGeneration, InitialAttempt>;
  using State = TypeList<AnnouncementsSent, Recognised, X, HeartbeatSeen, LastDelay, WriterOpen>;
  using Packets = TypeList<SpdpMulticast, SpdpUnicast, Data, Heartbeat, AckNack>;
  using Occasions = TypeList<ReaderOpens, WriterOpens>;
  using Announcing = AnnouncementRules<Implementation>::Rules;
  using Exchange =
      Joined<ReaderRules<Implementation>::Rules, TypeList<WriterSideOpens, AckNackArrives>>;
  using Rules = Joined<Announcing, Exchange>;
  using IsOpen = WriterOpen;
  static constexpr std::array unused{
      Unused{"C", "RepairDue", "nothing is repaired"},
      Unused{"C", "RepairSent", "nothing is repaired"},
      Unused{"C", "SuppressionEnded", "nothing is repaired"},
      Unused{"C", "requested", "requests are not heard"},
      Unused{"C", "generate", "nothing is repaired"},
      Unused{"C", "returned", "nothing is repaired"},
  };
  static constexpr std::array from_outside{announcements_start};
};

}  // namespace stormproof::fsm::composition::push_once
