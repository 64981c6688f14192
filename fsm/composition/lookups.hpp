// How a participant asks for a type that it does not know (specs/guide/fastdds.md, "Lookups of
// types"): a descriptor that is handed over waits for its type, and its writer's participant is
// asked; questions and answers go through the asynchronous queue, before descriptors, and to all
// readers of their writer, of whom one takes them up. Two switches are what might repair that: to
// whom samples go, and what there is one question for.
#pragma once

#include "fsm/composition/control.hpp"
#include "fsm/composition/fastdds_parts.hpp"
#include "fsm/composition/lookup_parts.hpp"
#include "fsm/domain.hpp"

namespace stormproof::fsm::composition::lookup {

/// It goes from the source of the pair, or of the relation, to its destination alone, whoever else
/// hears it.
struct QueueSample : Opaque {
  template <class W, class Stage_, class LookedUp_>
  static void contract(W& w, const Stage_&, const LookedUp_&) {
    w.set(SamplesQueued{}, w(SamplesQueued{}) + typename W::Int(1));
  }
};
template <class W>
void send(W& w, const typename W::Int& stage, const typename W::Int& looked_up) {
  w.perform(QueueSample{}, stage, looked_up);
  request<fastdds::AsyncRun, Immediately, fastdds::AsyncRunDue>(w);
}

// A descriptor is handed over. --------------------------------------------------------------------

/// The reader's participant knows the type: it has created an endpoint with it, or looked it up.
struct KnowsType : Answer {};
/// Descriptors of this type and stream, whoever has them, wait at the reader's participant; or of
/// this type alone.
struct SomebodyWaits : Answer {};
struct SomebodyWaitsForType : Answer {};
/// At the source of the pair wait descriptors of the destination, each the first one of its type
/// and stream.
struct FirstOnesWait : Answer {};
/// What a sample says is looked up: the type, for descriptors of this stream.
struct LookupOfDescriptor : Amount {};

/// The reader's participant knows the type of the descriptor now, and is told of it.
struct TypeIsKnown : Occasion<owner::descriptor> {};

/// Only the first one asks, and only whom it is from.
struct WaitForType : Procedure {
  template <class W>
  static void body(W& w) {
    const auto streams = w(AsksForStreams{});
    const auto is_asked =
        (streams && w(SomebodyWaits{})) || (!streams && w(SomebodyWaitsForType{}));
    const auto asks = !w(AsksForAll{}) && !is_asked;
    const auto looked_up = w(LookupOfDescriptor{});
    w.set(fastdds::WaitsForType{}, typename W::Bool(true));
    w.when(asks,
           [&] { w.reverse([&](auto& back) { send(back, typename W::Int(0), looked_up); }); });
  }
};
/// The source of the pair asks the destination for all types that nobody else was asked for, unless
/// it waits for an answer.
struct AskForAll : Procedure {
  template <class W>
  static void body(W& w) {
    w.when(w(AsksForAll{}) && !w(HasAsked{}), [&] {
      w.when(w(FirstOnesWait{}), [&] {
        w.set(HasAsked{}, typename W::Bool(true));
        send(w, typename W::Int(0), typename W::Int(0));
      });
    });
  }
};
struct DescriptorStopsWaiting : Rule<Happens<TypeIsKnown>> {
  template <class W>
  static void run(W& w) {
    w.set(fastdds::WaitsForType{}, typename W::Bool(false));
    w.perform(control::OpenTopics{});
  }
};

// Samples. ----------------------------------------------------------------------------------------

/// The receiver knows the type, or one after the other. What waits for it does not any more:
/// publications, then subscriptions, each in the order in which they came.
struct LearnType : Opaque {
  template <class W>
  static void contract(W& w) {
    w.when(w.choice("a descriptor waits for the type"), [&] { w.raise(TypeIsKnown{}); });
  }
};
/// What was lost at a side that was not open nobody repeats.
struct SampleArrives : Rule<Received<LookupSample>> {
  template <class W>
  static void run(W& w) {
    w.when(w.in(control::ControlReaderSide{}, is<control_relation::Open>), [&] {
      w.set(SamplesGot{}, max<typename W::D>(w(SamplesGot{}), w(SampleNumber{})));
      w.when(w(IsForReader{}), [&] {
        const auto stage = w(Stage{});
        const auto looked_up = w(LookedUp{});
        const auto is_last = !(typename W::Int(last_stage) > stage);
        w.when(is_last, [&] {
          w.perform(LearnType{});
          w.reverse([](auto& back) {
            back.set(HasAsked{}, typename W::Bool(false));
            back.call(AskForAll{});
          });
        });
        w.when(!is_last, [&] {
          w.reverse([&](auto& back) { send(back, stage + typename W::Int(1), looked_up); });
        });
      });
    });
  }
};

/// Of the sample that is sent: what it says.
struct SentLookup : Amount {};
struct SentStage : Amount {};
struct IsAddressee : Answer {};
/// It goes to the reader: in all versions, whoever it is for.
struct GoesToReader : Fact {
  template <class W>
  static auto of(W& w) {
    const auto filters = w(FiltersQuestions{}) || (w(FiltersAnswers{}) && w(OfAnswers{}));
    return !filters || w(IsAddressee{});
  }
};

/// The oldest sample of its participant's queue goes to readers of the writer.
struct SampleLeaves : Occasion<owner::control_writer> {};

/// The samples of the participant's queue are sent, the oldest first.
struct SendSamples : Opaque {
  template <class W>
  static void contract(W& w) {
    w.when(w(SamplesQueued{}) > typename W::Int(0), [&] {
      w.set(SamplesQueued{}, w(SamplesQueued{}) - typename W::Int(1));
      w.raise(SampleLeaves{});
    });
  }
};
/// The sample joins the message that is open, as a descriptor does (`fastdds::Pack`).
struct PackSample : Opaque {
  using FillsMessage = void;

  template <class W>
  static void contract(W& w) {
    w.for_readers([](auto& r) {
      r.when(r(GoesToReader{}), [&] {
        r.emit(LookupSample{},
               says(Says{SampleNumber{}, r(SamplesSent{})}, Says{LookedUp{}, r(SentLookup{})},
                    Says{Stage{}, r(SentStage{})}, Says{IsForReader{}, r(IsAddressee{})}));
      });
    });
  }
};
/// It is charged as a descriptor is (`fastdds::Charge`).
struct ChargeSample : Opaque {
  using FillsMessage = void;

  template <class W>
  static void contract(W& w) {
    w.when(w.choice("the budget is used up"),
           [&] { w.for_readers([](auto& r) { control::emit_user_heartbeat(r); }); });
  }
};
struct SampleIsSent : Rule<Happens<SampleLeaves>> {
  template <class W>
  static void run(W& w) {
    w.set(SamplesSent{}, w(SamplesSent{}) + typename W::Int(1));
    w.for_readers([](auto& r) {
      r.when(r(GoesToReader{}), [&] { r.set(SamplesTold{}, r(SamplesSent{})); });
    });
    w.perform(PackSample{});
    arm(w);
    w.perform(ChargeSample{});
  }
};

/// One message to every reader, which names its reader only if there is a single one.
struct LookupHeartbeatToAll : Opaque {
  template <class W>
  static void contract(W& w) {
    w.for_readers([](auto& r) { control::emit_user_heartbeat(r); });
  }
};
/// Until everybody has acknowledged everything that went to it.
struct LookupExpires : Rule<Due<LookupExpiryDue>> {
  template <class W>
  static void run(W& w) {
    expire<LookupExpiry>(w, [&] {
      const auto some_lack =
          w.some_reader([](auto& r) { return r(SamplesTold{}) > r(SamplesAcknowledged{}); });
      w.when(some_lack, [&] {
        w.perform(LookupHeartbeatToAll{});
        w.perform(RefillLookupBudget{});
        arm(w);
      });
    });
  }
};

using Parts = TypeList<LookupExpiry>;
using Timers = TypeList<LookupExpiryDue>;
using State = TypeList<SamplesSent, GetsSamples, SamplesTold, SamplesAcknowledged, SamplesGot,
                       SamplesQueued, HasAsked>;
using Packets = TypeList<LookupSample>;
using Occasions = TypeList<TypeIsKnown, SampleLeaves>;
using Rules = TypeList<DescriptorStopsWaiting, SampleArrives, SampleIsSent, LookupExpires>;

}  // namespace stormproof::fsm::composition::lookup
