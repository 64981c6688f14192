// What is known of the states and events of real runs, in the words of the composition: conditions
// over a world. `possible` says which events can be pending in a state at all, everything else what
// runs keep true. Two events whose order matters only where this fails do not matter in runs. It is
// not proved here: tests/checker/engines/tables/known_of_runs_test.cpp looks for a run that leaves
// it, for all but packets that leave their source and timers that are due.
#pragma once

#include "fsm/composition/fastdds.hpp"
#include "fsm/composition/paper.hpp"

namespace stormproof::tables {

namespace known {
namespace comp = fsm::composition;

template <class Bool>
Bool implies(const Bool& a, const Bool& b) {
  return !a || b;
}

/// A reader is complete if it has everything.
template <class W>
auto reader(W& w) {
  namespace reader = fsm::discovery_reader;
  const auto complete = w.in(comp::Reader{}, comp::is<reader::Complete>) ||
                        w.in(comp::Reader{}, comp::is<reader::EarlyComplete>);
  return complete == w.all([](auto& d) { return d(comp::X{}); });
}
/// The HEARTBEAT timer under the periodic policy.
template <class W>
auto clock(W& w) {
  namespace timer = fsm::heartbeat_timer;
  const auto armed = w.in(comp::HeartbeatClock{}, comp::is<timer::Armed>);
  const auto pending = w(comp::Pending<comp::HeartbeatExpiry>{});
  return (armed || w.in(comp::HeartbeatClock{}, comp::is<timer::Idle>)) &&
         armed == (pending >= 1) && (w(comp::Additive{}) || pending <= 1);
}
/// The initial ACKNACK timer waits from the opening of the reader on.
template <class W>
auto initial_timer(W& w) {
  namespace reader = fsm::discovery_reader;
  const auto open = w.in(comp::Reader{}, comp::is<reader::Complete>) ||
                    w.in(comp::Reader{}, comp::is<reader::Recognised>);
  return !(open == w.in(comp::InitialTimer{}, comp::is<fsm::initial_acknack::Dormant>));
}

/// A profile has one answer to a first recognition.
template <class W>
auto one_resend(W& w) {
  const auto all = w(comp::ResendsToAll{});
  const auto both = w(comp::ResendsCopyAndMulticast{});
  return !(all && both) && !(w(comp::ResendsCopy{}) && (all || both));
}

/// What is not said here may always be.
struct Anything {
  template <class Trigger, class W>
  static auto possible(Trigger, W&) {
    return typename W::Bool(true);
  }
  template <class Trigger, class W>
  static auto consistent(Trigger, W&) {
    return typename W::Bool(true);
  }
  template <class W>
  static auto possible(comp::Due<comp::InitialAttempt>, W& w) {
    return w.in(comp::InitialTimer{}, comp::is<fsm::initial_acknack::Waiting>);
  }
};
}  // namespace known

struct KnownOfPaper : known::Anything {
  using Composition = fsm::composition::paper::Paper;
  using known::Anything::consistent;
  using known::Anything::possible;

  template <class W>
  static auto of_knobs(W& w) {
    return known::one_resend(w);
  }
  template <class W>
  static auto of_writer(W& w) {
    using namespace fsm::composition;
    const auto idle = w.in(HeartbeatClock{}, is<fsm::heartbeat_timer::Idle>);
    return known::clock(w) && known::implies(idle, !w(paper::SomeReaderWaits{}));
  }
  template <class W>
  static auto of_relation(W& w) {
    using namespace fsm::composition;
    const auto open = w(paper::WriterOpen{});
    return known::reader(w) && known::initial_timer(w) && w.all([&](auto& d) {
      return known::implies(d.in(paper::C{}, is<fsm::descriptor_repair::A>), d(X{})) &&
             (open || d.in(paper::C{}, is<fsm::descriptor_repair::U>));
    });
  }
  /// The bitmap lists all that is missing; what it does not list its reader had received before.
  template <class W>
  static auto possible(fsm::composition::Received<fsm::composition::paper::AckNack>, W& w) {
    using namespace fsm::composition;
    return w.all([](auto& d) {
      return d(BelowBase{}) == d.all_up_to([](auto& e) { return !e(Listed{}); });
    });
  }
  template <class W>
  static auto consistent(fsm::composition::Received<fsm::composition::paper::AckNack>, W& w) {
    using namespace fsm::composition;
    return w.all([](auto& d) { return d(Listed{}) || d(X{}); });
  }
  /// A descriptor in a repair packet that is on its way is in Q, or acknowledged meanwhile.
  template <class W>
  static auto consistent(fsm::composition::LeftSource<fsm::composition::paper::Data>, W& w) {
    using namespace fsm::composition;
    return w.all([](auto& d) {
      return !d(IsRepair{}) || !d(Carries{}) || d.in(paper::C{}, is<fsm::descriptor_repair::Q>) ||
             d.in(paper::C{}, is<fsm::descriptor_repair::A>);
    });
  }
};

struct KnownOfFastDds : known::Anything {
  using Composition = fsm::composition::fastdds::FastDds;
  using known::Anything::consistent;
  using known::Anything::possible;

  template <class W>
  static auto of_knobs(W& w) {
    using namespace fsm::composition;
    return !w(AcceptsUnmatched{}) && !w(Additive{}) && known::one_resend(w);
  }
  template <class W>
  static auto of_writer(W& w) {
    using namespace fsm::composition;
    return known::clock(w) && pending(w, fastdds::AsyncRun{}) == w(fastdds::QueueNotEmpty{});
  }
  template <class W>
  static auto of_relation(W& w) {
    using namespace fsm::composition;
    namespace change = fsm::change_for_reader;
    const auto open = w(fastdds::WriterOpen{});
    const auto responds = pending(w, fastdds::NackResponse{});
    const auto suppressed = pending(w, fastdds::Suppression{});
    return known::reader(w) && known::initial_timer(w) && w.all([&](auto& d) {
      const auto exists = d(fastdds::Exists{});
      const auto absent = d.in(fastdds::C{}, is<change::Absent>);
      return known::implies(d(X{}), d(fastdds::Known{})) &&
             known::implies(d(fastdds::Known{}), exists) &&
             known::implies(d(fastdds::HandedOver{}),
                            d.all_up_to([](auto& e) { return e(X{}); })) &&
             absent == (!open || !exists) &&
             known::implies(d.in(fastdds::C{}, is<change::A>), d(X{})) &&
             known::implies(d.in(fastdds::C{}, is<change::R>), responds) &&
             known::implies(d.in(fastdds::C{}, is<change::Q>), d(fastdds::Enqueued{})) &&
             known::implies(d.in(fastdds::C{}, is<change::S>), suppressed);
    });
  }

  /// A base above which everything is listed that the reader knows to be missing; initial ones
  /// claim nothing. What lies below the base the reader had received, what is listed it knew.
  template <class W>
  static auto possible(fsm::composition::Received<fsm::composition::fastdds::AckNack>, W& w) {
    using namespace fsm::composition;
    return w.all([](auto& d) {
      return !(d(IsInitial{}) && (d(Listed{}) || d(BelowBase{}))) &&
             !(d(Listed{}) && d(BelowBase{})) &&
             known::implies(d(BelowBase{}), d.all_up_to([](auto& e) { return e(BelowBase{}); }));
    });
  }
  template <class W>
  static auto consistent(fsm::composition::Received<fsm::composition::fastdds::AckNack>, W& w) {
    using namespace fsm::composition;
    return w.all([](auto& d) {
      return known::implies(d(BelowBase{}), d(X{})) &&
             known::implies(d(Listed{}), d(fastdds::Known{}));
    });
  }
  template <class W>
  static auto consistent(fsm::composition::Received<fsm::composition::fastdds::Data>, W& w) {
    using namespace fsm::composition;
    return w.all([](auto& d) {
      return known::implies(d(Carries{}) || d(Announces{}), d(fastdds::Exists{}));
    });
  }
  template <class W>
  static auto consistent(fsm::composition::Received<fsm::composition::fastdds::Heartbeat>, W& w) {
    using namespace fsm::composition;
    return w.all([](auto& d) { return known::implies(d(Announces{}), d(fastdds::Exists{})); });
  }
  template <class W>
  static auto possible(fsm::composition::Due<fsm::composition::AckNackGeneration>, W& w) {
    return pending(w, fsm::composition::fastdds::Reply{});
  }
  template <class W>
  static auto possible(fsm::composition::Due<fsm::composition::fastdds::SuppressionEnd>, W& w) {
    return pending(w, fsm::composition::fastdds::Suppression{});
  }
  template <class W>
  static auto possible(fsm::composition::Due<fsm::composition::fastdds::NackResponseDue>, W& w) {
    return pending(w, fsm::composition::fastdds::NackResponse{});
  }
  template <class W>
  static auto possible(fsm::composition::Due<fsm::composition::fastdds::AsyncRunDue>, W& w) {
    return pending(w, fsm::composition::fastdds::AsyncRun{});
  }
  /// What is created does not exist yet, for nobody.
  template <class W>
  static auto possible(fsm::composition::Happens<fsm::composition::fastdds::Created>, W& w) {
    using namespace fsm::composition;
    return !w(fastdds::Exists{}) && !w.some_reader([](auto& r) {
      return !r.in(fastdds::C{}, is<fsm::change_for_reader::Absent>);
    });
  }

 private:
  template <class W, class Shot>
  static auto pending(W& w, Shot shot) {
    return w.in(shot, fsm::composition::is<fsm::single_shot::Pending>);
  }
};

}  // namespace stormproof::tables
