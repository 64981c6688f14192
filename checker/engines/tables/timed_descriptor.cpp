// The unknowns, which packets are looked at, and when the limit starts to count.
#include "checker/engines/tables/timed_descriptor.hpp"

#include <stdexcept>

#include "checker/engines/tables/derived.hpp"
#include "model/composition_of.hpp"
#include "model/engine/composition_knobs.hpp"

namespace stormproof::tables {
namespace {

using Says = DerivedTime::Says;
using smt::SymbolicInt;

/// What a packet says of a field; what it does not say is false.
Expr said(const Says& says, const char* field) {
  const auto found = says.find(field);
  if (found != says.end()) return found->second;
  return smt::SymbolicContext::current().bool_val(false);
}

/// A HEARTBEAT that tells of the descriptor, an ordinary ACKNACK that asks for it, DATA that
/// carries it; an initial ACKNACK.
Expr is_of_an_exchange(std::string_view packet, const Says& says) {
  if (packet == watched::initial_acknack) return said(says, "IsInitial");
  if (packet == "Heartbeat") {
    return says.contains("Announces") ? says.at("Announces")
                                      : smt::SymbolicContext::current().bool_val(true);
  }
  if (packet == "Data") return said(says, "Carries");
  if (packet != "AckNack") return smt::SymbolicContext::current().bool_val(false);
  return said(says, "Listed") && !said(says, "BelowBase") && !said(says, "IsInitial");
}
Expr is_repair(std::string_view packet, const Says& says) {
  return is_of_an_exchange(packet, says) && said(says, "IsRepair");
}

timeline::Delays<smt::Symbolic> unknown_delays() {
  return {.period = SymbolicInt::named("HeartbeatPeriod"),
          .response = SymbolicInt::named("ResponseDelay"),
          .nack = SymbolicInt::named("NackResponseDelay"),
          .suppression = SymbolicInt::named("SuppressionDuration"),
          .delta = SymbolicInt::named("Delta"),
          .source = SymbolicInt::named("Sigma")};
}

/// An initial ACKNACK, and the exchange with the HEARTBEAT that it calls for.
TimedDescriptor::Bound bound_of_attempts(const timeline::Delays<smt::Symbolic>& t) {
  const SymbolicInt asked = t.delta + t.delta + t.response + t.delta;
  return {.first = 0, .loss = t.source + t.suppression, .exchange = asked + t.nack + t.delta};
}

/// What stands for a knob: one of the unknowns, or its value.
Expr knob_or_unknown(const Knob& knob, const model::DdsProfile& dds) {
  for (const char* name : {"HeartbeatPeriod", "ResponseDelay", "NackResponseDelay",
                           "SuppressionDuration", "InitialDelay"}) {
    if (knob.name == name) return SymbolicInt::named(name).expr();
  }
  return knob.value(dds);
}

/// Whether the reader's side was opened.
Expr reader_is_open(const std::function<Expr(const char*)>& at) {
  return at("Reader=Recognised") || at("Reader=Complete");
}

Expr opened(model::Of<fsm::composition::paper::Paper>, const model::DdsProfile& dds,
            const std::function<Expr(const char*)>& at) {
  if (model::knob_value(fsm::composition::AcceptsUnmatched{}, dds)) return at("WriterOpen");
  return at("WriterOpen") && reader_is_open(at);
}
Expr opened(model::Of<fsm::composition::fastdds::FastDds>, const model::DdsProfile&,
            const std::function<Expr(const char*)>& at) {
  return !at("C=Absent") && reader_is_open(at);
}

}  // namespace

Expr can_be_asked_for(const model::DdsProfile& dds, const std::function<Expr(const char*)>& at) {
  return model::visit_composition(dds, [&](auto composition) -> Expr {
    if constexpr (requires { opened(composition, dds, at); }) {
      return opened(composition, dds, at);
    } else {
      throw std::logic_error{"nobody derives this composition"};
    }
  });
}

TimedDescriptor::TimedDescriptor(const model::DdsProfile& dds, const model::Mutation& mistakes,
                                 const Options& options)
    : delays_{unknown_delays()},
      initial_{SymbolicInt::named("InitialDelay").expr()},
      doubles_{dds.sedp.initial_acknack_interval == model::InitialAckNackInterval::doubling},
      bound_{options.attempts ? bound_of_attempts(delays_)
                              : timeline::losses<smt::Symbolic>(dds, delays_)},
      derivation_{options.unsound} {
  if (options.tighten) options.tighten(bound_);
  Derivation& system = derivation_;
  const auto attempt_after = [&](const Expr& time) {
    return next_attempt(time, system.now(watched::opened));
  };
  const auto after_loss = [&](const Expr& limit) {
    return options.attempts ? attempt_after(system.now(timed::now) + bound_.loss.expr())
                            : limit + bound_.loss.expr();
  };
  std::map<std::string, std::string> further;
  if (options.attempts) further["AckNack"] = watched::initial_acknack;
  DerivedTime time{system,
                   {.delay = delays_.delta.expr(),
                    .source = delays_.source.expr(),
                    .lost = after_loss,
                    .loses = options.loses,
                    .exact = options.exact,
                    .matters = is_of_an_exchange,
                    .matters_at_source = is_repair,
                    .further = further}};
  system.declare(watched::counting, false);
  system.declare_count(watched::heartbeat_sent);
  Derived derived{dds, mistakes, system};
  derived.time = &time;
  derived.knob = [&dds](const Knob& knob) { return knob_or_unknown(knob, dds); };
  if (options.counts_copies) {
    system.declare(watched::data_sent, false);
    system.declare(watched::data_sent_again, false);
  }
  if (options.attempts) {
    for (const char* number : {watched::opened, "LastDelay", "LastNack", "OldCounts"}) {
      system.declare_count(number);
    }
    derived.counted = {"InitialAttempt"};
  }
  derived.emitted = [&](std::string_view packet, const Expr& when, const Says& says) {
    if (packet == "Data" && options.counts_copies) {
      const Expr yes = smt::SymbolicContext::current().bool_val(true);
      const Expr it = when && said(says, "Carries");
      system.assign(watched::data_sent_again, it && system.now(watched::data_sent), yes);
      system.assign(watched::data_sent, it, yes);
    }
    if (packet != "Heartbeat") return;
    system.assign(watched::heartbeat_sent, when && is_of_an_exchange(packet, says), time.now());
  };
  derived.ended = [&](const Expr&) {
    const auto at = [&](const char* name) { return system.now(name); };
    const auto before = [&](const char* name) { return system.variable(name); };
    const Expr counts = can_be_asked_for(dds, at) && (!options.attempts || reader_is_open(at));
    const Expr starts = counts && !system.now(watched::counting);
    if (options.attempts) {
      system.assign(watched::opened, reader_is_open(at) && !reader_is_open(before), time.now());
      system.assign(timed::limit, starts, attempt_after(time.now()) + bound_.first.expr());
    } else {
      const Expr lost_now = system.now(timed::limit) - system.variable(timed::limit);
      system.assign(timed::limit, starts, time.now() + bound_.first.expr() + lost_now);
    }
    system.assign(watched::counting, starts, smt::SymbolicContext::current().bool_val(true));
  };
  derive(model::program_of_exchange(dds), derived);
  if (options.stale) start_stale();
}

void TimedDescriptor::start_stale() {
  derivation_.start_with("WriterOpen", true);
  derivation_.start_with("C=U", false);
  derivation_.start_with("C=A", true);
}

Expr TimedDescriptor::next_attempt(const Expr& time, const Expr& opened) const {
  return doubles_ ? time + (time - opened) + initial_ : time + initial_;
}

Exprs TimedDescriptor::unknowns() const {
  return {delays_.period.expr(),
          delays_.response.expr(),
          delays_.nack.expr(),
          delays_.suppression.expr(),
          delays_.delta.expr(),
          delays_.source.expr(),
          initial_};
}

Exprs TimedDescriptor::assumptions() const {
  return {delays_.period.expr() >= 1,
          delays_.response.expr() >= 0,
          delays_.nack.expr() >= 0,
          delays_.suppression.expr() >= 0,
          delays_.source.expr() >= 0,
          delays_.source.expr() <= delays_.delta.expr(),
          initial_ >= 0};
}

}  // namespace stormproof::tables
