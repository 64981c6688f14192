// The state of one Fast DDS relation in order.commutation, and what its events emit and schedule.
#pragma once

#include "checker/engines/tables/relation_parts.hpp"
#include "fsm/change_for_reader.hpp"
#include "fsm/single_shot.hpp"

namespace stormproof::tables::fastdds {

using Writer = MachineStep<fsm::ChangeForReader>;
using Shot = MachineStep<fsm::SingleShot>;

struct State {
  OneHot writer = Writer::unknown_state("C=");
  ReaderPart reader = ReaderPart::unknown();
  Expr announced = truth("announced");
  OneHot initial = InitialStep::unknown_state("initial_timer=");
  OneHot reply = Shot::unknown_state("reply=");
  OneHot suppression = Shot::unknown_state("suppression=");
  OneHot nack = Shot::unknown_state("nack_response=");
  OneHot async = Shot::unknown_state("async_run=");
  TimerPart timer = TimerPart::unknown();
  Expr enqueued = truth("enqueued");                // in the asynchronous queue
  Expr others_enqueued = truth("others_enqueued");  // something else is
  Expr low_is_zero = truth("low_mark_is_zero");     // nothing is acknowledged for good
  Expr others_created = truth("others_created");    // some other descriptor exists

  [[nodiscard]] Exprs flat() const {
    Exprs all = writer;
    append(all, reader.state);
    append(all, {reader.received, reader.others_missing, reader.heartbeat_seen, announced});
    append(all, initial);
    for (const OneHot* part : {&reply, &suppression, &nack, &async}) append(all, *part);
    append(all, timer.state);
    append(all, {timer.pending, enqueued, others_enqueued, low_is_zero, others_created});
    return all;
  }
  static State from(const Exprs& flat) {
    Reading reading{flat};
    State s;
    s.writer = reading.many(Writer::states);
    s.reader.state = reading.many(ReaderStep::states);
    for (Expr* bit :
         {&s.reader.received, &s.reader.others_missing, &s.reader.heartbeat_seen, &s.announced}) {
      *bit = reading.one();
    }
    s.initial = reading.many(InitialStep::states);
    for (OneHot* part : {&s.reply, &s.suppression, &s.nack, &s.async}) {
      *part = reading.many(Shot::states);
    }
    s.timer.state = reading.many(TimerStep::states);
    for (Expr* value :
         {&s.timer.pending, &s.enqueued, &s.others_enqueued, &s.low_is_zero, &s.others_created}) {
      *value = reading.one();
    }
    return s;
  }
};

enum Output : std::size_t {
  acknack_scheduled,
  acknack_listing,
  acknack_unannounced,
  acknack_clean,
  initial_sent,
  initial_scheduled,
  nack_response_scheduled,
  async_run_scheduled,
  data,
  suppression_scheduled,
  heartbeat,
  expiry_scheduled,
  output_kinds
};

}  // namespace stormproof::tables::fastdds
