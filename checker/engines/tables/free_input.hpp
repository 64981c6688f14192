// Inputs of the machines as unknowns with their names: what a proof ranges over. A field that a
// machine gains and this page forgets is a compile error.
#pragma once

#include <string>

#include "checker/engines/tables/proof.hpp"
#include "fsm/announcer.hpp"
#include "fsm/cautious_reader.hpp"
#include "fsm/change_for_reader.hpp"
#include "fsm/channel.hpp"
#include "fsm/control_relation.hpp"
#include "fsm/descriptor_repair.hpp"
#include "fsm/discovery_reader.hpp"
#include "fsm/event_thread.hpp"
#include "fsm/heartbeat_pacer.hpp"
#include "fsm/heartbeat_timer.hpp"
#include "fsm/initial_acknack.hpp"
#include "fsm/matched_reader.hpp"
#include "fsm/movable_timer.hpp"
#include "fsm/single_shot.hpp"

namespace stormproof::tables {

/// Makes unknowns and keeps a list of them. `prefix` tells those of several events apart.
class Unknowns {
 public:
  explicit Unknowns(std::string prefix = {}) : prefix_{std::move(prefix)} {}

  smt::SymbolicBool truth(const std::string& name) {
    const auto value = smt::SymbolicBool::named(prefix_ + name);
    list_.push_back(value.expr());
    return value;
  }
  smt::SymbolicInt number(const std::string& name) {
    const auto value = smt::SymbolicInt::named(prefix_ + name);
    list_.push_back(value.expr());
    return value;
  }

  [[nodiscard]] const Exprs& list() const { return list_; }

 private:
  std::string prefix_;
  Exprs list_;
};

namespace detail {

using smt::Symbolic;

inline void fill(fsm::DescriptorRepairIo::Input<Symbolic>& in, Unknowns& u) {
  in = {.listed = u.truth("listed"),
        .below_first_missing = u.truth("below_first_missing"),
        .prefix_only = u.truth("prefix_only")};
}
inline void fill(fsm::ChangeForReaderIo::Input<Symbolic>& in, Unknowns& u) {
  in = {.listed = u.truth("listed"), .below_base = u.truth("below_base")};
}
inline void fill(fsm::DiscoveryReaderIo::Input<Symbolic>& in, Unknowns& u) {
  in = {.accepts_unmatched = u.truth("accepts_unmatched"),
        .missing_after = u.number("missing_after")};
}
inline void fill(fsm::HeartbeatTimerIo::Input<Symbolic>& in, Unknowns& u) {
  in = {.now = u.number("now"),
        .heartbeat_period = u.number("heartbeat_period"),
        .adaptive = u.truth("adaptive"),
        .additive = u.truth("additive"),
        .pending = u.number("pending"),
        .unacknowledged = u.truth("unacknowledged"),
        .cycle = {.start = u.number("cycle_start"),
                  .period = u.number("cycle_period"),
                  .contacted = u.number("contacted"),
                  .responded = u.number("responded"),
                  .min_period = u.number("min_period"),
                  .max_period = u.number("max_period"),
                  .epsilon_num = u.number("epsilon_num"),
                  .epsilon_den = u.number("epsilon_den")}};
}
inline void fill(fsm::InitialAckNackIo::Input<Symbolic>& in, Unknowns& u) {
  in = {.now = u.number("now"),
        .first_delay = u.number("first_delay"),
        .last_delay = u.number("last_delay"),
        .heartbeat_seen = u.truth("heartbeat_seen"),
        .constant = u.truth("constant")};
}
inline void fill(fsm::AnnouncerIo::Input<Symbolic>& in, Unknowns& u) {
  in = {.now = u.number("now"),
        .number = u.number("number"),
        .startup = u.number("startup"),
        .startup_period = u.number("startup_period"),
        .period = u.number("period")};
}
inline void fill(fsm::ChannelIo::Input<Symbolic>& in, Unknowns& u) {
  in = {.waiting = u.truth("waiting"), .dispatch_pending = u.truth("dispatch_pending")};
}
inline void fill(fsm::SingleShotIo::Input<Symbolic>& in, Unknowns& u) {
  in = {.now = u.number("now"), .delay = u.number("delay")};
}
inline void fill(fsm::ControlRelationIo::Input<Symbolic>&, Unknowns&) {}
inline void fill(fsm::CautiousReaderIo::Input<Symbolic>& in, Unknowns& u) {
  in = {.fresh = u.truth("fresh"),
        .directed = u.truth("directed"),
        .by_delay = u.truth("by_delay"),
        .first_missing = u.number("first_missing"),
        .last = u.number("last"),
        .asked_end = u.number("asked_end"),
        .base = u.number("base"),
        .now = u.number("now"),
        .quiet_until = u.number("quiet_until"),
        .hush_until = u.number("hush_until"),
        .again_at = u.number("again_at"),
        .preemptive_delay = u.number("preemptive_delay"),
        .repeat_delay = u.number("repeat_delay"),
        .again_delay = u.number("again_delay")};
}
inline void fill(fsm::MatchedReaderIo::Input<Symbolic>& in, Unknowns& u) {
  in = {.accepted = u.truth("accepted"), .replies = u.truth("replies")};
}
inline void fill(fsm::HeartbeatPacerIo::Input<Symbolic>& in, Unknowns& u) {
  in = {.waiting = u.truth("waiting"),
        .sent_before = u.truth("sent_before"),
        .now = u.number("now"),
        .last_sent = u.number("last_sent"),
        .number = u.number("number"),
        .interval = u.number("interval"),
        .interval_max = u.number("interval_max"),
        .match_delay = u.number("match_delay")};
}
inline void fill(fsm::EventThreadIo::Input<Symbolic>& in, Unknowns& u) {
  in = {.now = u.number("now"), .send_time = u.number("send_time")};
}
inline void fill(fsm::MovableTimerIo::Input<Symbolic>& in, Unknowns& u) {
  in = {.now = u.number("now"), .due = u.number("due"), .to = u.number("to")};
}

}  // namespace detail

/// An input of `Machine` of which nothing is known.
template <class Machine>
typename Machine::Io::template Input<smt::Symbolic> free_input(Unknowns& unknowns) {
  typename Machine::Io::template Input<smt::Symbolic> input;
  detail::fill(input, unknowns);
  return input;
}

}  // namespace stormproof::tables
