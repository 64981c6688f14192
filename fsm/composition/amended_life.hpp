// What the amended rules (fsm/composition/amended.hpp) lose of a side of a relation that is
// forgotten, and of a participant that comes back; the rest is in fsm/composition/life.hpp. And
// endpoints that are created and deleted in a run.
// Source: specs/guide/museum.md, "Participants that come and go".
#pragma once

#include "fsm/composition/amended_parts.hpp"
#include "fsm/composition/life.hpp"

namespace stormproof::fsm::composition::amended {

/// What these rules have besides that is forgotten.
struct Forgetting {
  using Descriptor = amended::C;
  using WriterOpen = paper::WriterOpen;
  using SuppressionEnd = paper::SuppressionEnd;

  template <class W>
  static void forget_writer(W& w) {
    w.set_each(Known{}, [](auto& d) { return d(Exists{}) && !d(WrittenLater{}); });
    w.set(LastHeard{}, typename W::Int(0));
    w.set(HasAsked{}, typename W::Bool(false));
    w.cancel(ReaderRetryDue{});
  }
  template <class W>
  static void forget_reader(W& w) {
    w.set(LastHeartbeat{}, typename W::Int(0));
    w.set(Required{}, typename W::Int(0));
    w.set(OldCounts{}, typename W::Int(0));
    w.set(HasAnswered{}, typename W::Bool(false));
    w.set_each(Resent{}, [](auto& d) { return !everyone(d); });
    w.cancel(paper::RepairGeneration{});
  }
  template <class W>
  static void forget_peer(W& w) {
    w.cancel(CopyDue{});
  }
  template <class W>
  static void lose_participant(W&) {}
  /// Others take some of its ACKNACKs for those of its earlier life.
  template <class W>
  static void lose_writer(W& w) {
    w.reverse([](auto& back) {
      back.when(back(paper::WriterOpen{}), [&] { back.set(OldCounts{}, back(CountFilter{})); });
    });
  }
};
using Life = LifeRules<Forgetting>;

/// The application creates or deletes an endpoint.
struct Written : Occasion<owner::entry> {};

inline constexpr FromOutside endpoint_changes{"Written",
                                              "the application creates and deletes endpoints"};

}  // namespace stormproof::fsm::composition::amended
