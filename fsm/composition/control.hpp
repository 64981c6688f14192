// Relations of which only HEARTBEATs and ACKNACKs are modelled: liveliness, what asks for types and
// answers, and user topics. Which of them open when, the host knows, because it knows the topics;
// see `OpenTopics`.
// Source: specs/guide/fastdds.md, "Control-only relations".
#pragma once

#include "fsm/composition/lookup_parts.hpp"
#include "fsm/composition/reader.hpp"
#include "fsm/composition/single_shots.hpp"
#include "fsm/control_relation.hpp"
#include "fsm/domain.hpp"

namespace stormproof::fsm::composition::control {

struct ControlWriterSide : Part<ControlWriter, owner::control_relation> {};
struct ControlReaderSide : Part<ControlReader, owner::control_relation> {};
struct ControlInitialTimer : Part<InitialAckNack, owner::control_relation> {};
struct ControlReply : Part<SingleShot, owner::control_relation> {};

struct ControlInitialAttempt : TimerAtDestination<owner::control_relation> {};
struct ControlReplyDue : TimerAtDestination<owner::control_relation> {};

struct ControlHeartbeatSeen : Flag<owner::control_relation> {};
struct ControlLastDelay : Number<owner::control_relation> {};

/// It is a user topic; otherwise it is built in.
struct OfTopic : Answer {};
/// heartbeatResponseDelay of ordinary readers, and τ_B of those that are built in.
struct TopicReplyDelay : FixedDelay<5'000'000> {};
struct BuiltinReplyDelay : DelayOf<"builtin_response_delay">, OfDestination {};
struct ControlReplyDelay : Fact {
  template <class W>
  static auto of(W& w) {
    return W::D::select(w(OfTopic{}), w(TopicReplyDelay{}), w(BuiltinReplyDelay{}));
  }
};

struct UserHeartbeat : Packet<owner::control_relation, lookup::SampleCount> {};
struct UserAckNack : Packet<owner::control_relation, IsInitial, lookup::SampleCount> {};

struct ControlWriterOpens : Occasion<owner::control_relation> {};
struct ControlReaderOpens : Occasion<owner::control_relation> {};

using Attempts = InitialAttempts<ControlInitialTimer, ControlHeartbeatSeen, ControlLastDelay,
                                 ControlInitialAttempt>;

template <class W>
void emit_user_heartbeat(W& w) {
  w.emit(UserHeartbeat{}, says(Says{lookup::SampleCount{}, w(lookup::SamplesSent{})}));
}

/// Samples that are older than the match do not count as missing.
struct ControlWriterOpened : Rule<Happens<ControlWriterOpens>> {
  template <class W>
  static void run(W& w) {
    const auto writer = w.feed(ControlWriterSide{}, on<control_relation::Opened>);
    w.when(writer.send_heartbeat, [&] {
      w.when(w(lookup::KeepsSamples{}), [&] {
        w.set(lookup::GetsSamples{}, typename W::Bool(true));
        w.set(lookup::SamplesAcknowledged{}, w(lookup::SamplesSent{}));
        w.perform(lookup::RefillLookupBudget{});
      });
      emit_user_heartbeat(w);
    });
  }
};
struct ControlReaderOpened : Rule<Happens<ControlReaderOpens>> {
  template <class W>
  static void run(W& w) {
    const auto reader = w.feed(ControlReaderSide{}, on<control_relation::Opened>);
    w.when(reader.start_initial, [&] { Attempts::open(w); });
  }
};
struct ControlHeartbeatArrives : Rule<Received<UserHeartbeat>> {
  template <class W>
  static void run(W& w) {
    const auto reader = w.feed(ControlReaderSide{}, on<control_relation::HeartbeatReceived>);
    w.when(reader.reply, [&] {
      w.set(ControlHeartbeatSeen{}, typename W::Bool(true));
      w.when(w(lookup::KeepsSamples{}), [&] {
        w.set(lookup::SamplesGot{},
              max<typename W::D>(w(lookup::SamplesGot{}), w(lookup::SampleCount{})));
      });
      request<ControlReply, ControlReplyDelay, ControlReplyDue>(w);
    });
  }
};
/// Any other than an initial one acknowledges samples, where they are modelled.
struct ControlAckNackArrives : Rule<Received<UserAckNack>> {
  template <class W>
  static void run(W& w) {
    w.when(w(IsInitial{}), [&] {
      const auto writer = w.feed(ControlWriterSide{}, on<control_relation::InitialAckNackReceived>);
      w.when(writer.send_heartbeat, [&] {
        emit_user_heartbeat(w);
        w.when(w(lookup::KeepsSamples{}), [&] {
          w.perform(lookup::RefillLookupBudget{});
          lookup::arm(w);
        });
      });
    });
    w.when(!w(IsInitial{}) && w(lookup::GetsSamples{}), [&] {
      w.set(lookup::SamplesAcknowledged{},
            max<typename W::D>(w(lookup::SamplesAcknowledged{}), w(lookup::SampleCount{})));
    });
  }
};
struct ControlInitialAckNackDue : Rule<Due<ControlInitialAttempt>> {
  template <class W>
  static void run(W& w) {
    Attempts::attempt(w, [&] {
      w.emit(UserAckNack{}, says(Says{IsInitial{}, typename W::Bool(true)}));
    });
  }
};
struct ControlReplyIsDue : Rule<Due<ControlReplyDue>> {
  template <class W>
  static void run(W& w) {
    expire<ControlReply>(w, [&] {
      w.emit(UserAckNack{}, says(Says{lookup::SampleCount{}, w(lookup::SamplesGot{})}));
    });
  }
};

/// After a recognition, a creation or a notification: each side of a control-only relation opens
/// that now has what it needs. What is built in needs the recognition; a topic needs that this side
/// has created its endpoint and has been notified of the other's. The notification that ends the
/// run opens nothing any more.
struct OpenTopics : Opaque {
  template <class W>
  static void contract(W& w) {
    w.when(w.choice("a reader side can open"), [&] { w.raise(ControlReaderOpens{}); });
    w.when(w.choice("a writer side can open"), [&] { w.raise(ControlWriterOpens{}); });
  }
};

using Parts = TypeList<ControlWriterSide, ControlReaderSide, ControlInitialTimer, ControlReply>;
using Timers = TypeList<ControlInitialAttempt, ControlReplyDue>;
using State = TypeList<ControlHeartbeatSeen, ControlLastDelay>;
using Packets = TypeList<UserHeartbeat, UserAckNack>;
using Occasions = TypeList<ControlWriterOpens, ControlReaderOpens>;
using Rules = TypeList<ControlWriterOpened, ControlReaderOpened, ControlHeartbeatArrives,
                       ControlAckNackArrives, ControlInitialAckNackDue, ControlReplyIsDue>;

}  // namespace stormproof::fsm::composition::control
