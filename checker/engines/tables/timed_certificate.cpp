// Which states go with what the reader has, and the assumptions in words.
#include "checker/engines/tables/timed_certificate.hpp"

#include "checker/engines/tables/houdini.hpp"

namespace stormproof::tables {
namespace {

/// What else may hold: each state, packet and timer implies that the reader has the descriptor,
/// knows of it, or is open; and nothing that is looked at is overdue.
Exprs candidates_of(const TimedDescriptor& whole, const Moving& moving) {
  Exprs candidates = facts_of(moving.system);
  Exprs implied{moving(whole["Reader=Recognised"] || whole["Reader=Complete"])};
  for (const Expr& variable : moving.system.variables) {
    const std::string name = variable.decl().name().str();
    for (const char* other : {"X", "Known", "Exists", "WriterOpen"}) {
      if (name == other) implied.push_back(variable);
    }
  }
  for (const Expr& variable : moving.system.variables) {
    if (!variable.is_bool()) continue;
    for (const Expr& other : implied) candidates.push_back(z3::implies(variable, other));
    const std::string name = variable.decl().name().str();
    for (const auto& [prefix, end] : {std::pair<std::string, std::string>{"in flight ", "arrives "},
                                      std::pair<std::string, std::string>{"leaving ", "leaves "}}) {
      if (!name.starts_with(prefix)) continue;
      candidates.push_back(
          z3::implies(variable, whole[timed::now] <= whole[end + name.substr(prefix.size())]));
    }
  }
  return candidates;
}

}  // namespace

std::function<void(TimedDescriptor::Bound&)> tightened_by(const Tighter& tighter) {
  return [tighter](TimedDescriptor::Bound& bound) {
    bound.first = bound.first - tighter.first;
    bound.loss = bound.loss - tighter.loss;
    bound.exchange = bound.exchange - tighter.exchange;
  };
}

void assume_in_time(Proof& proof) {
  proof.assume(
      "A packet that matters arrives within Δ, unless it is lost, and has left its source within "
      "σ ≤ Δ; all others may be delayed, lost, duplicated and reordered without bound.");
  proof.assume(
      "What is scheduled happens at its time, and receptions before timers of the same instant.");
  proof.assume(
      "The numbers of descriptors and readers are arbitrary: one is looked at, and what the rules "
      "read of the others ranges freely.");
  proof.assume(hosts_keep_contracts);
}

void TimedStatement::within(const std::string& timer, const Expr& pending, const Expr& delay) {
  say(timer + ": what is pending is due within its delay",
      if_then(pending, now() <= due(timer) && by(due(timer), now() + delay)));
}

void TimedStatement::arrives_in_time(const std::string& kind) {
  say(kind + ": what is looked at arrives within Δ",
      if_then(is(timed::in_flight(kind)),
              by(is(timed::arrives(kind)), now() + system_.delays().delta.expr())));
}

void TimedStatement::repairs_leave_in_time() {
  say("a repair that is looked at leaves its source within σ",
      if_then(is(timed::leaving("Data")),
              by(is(timed::leaves("Data")), now() + system_.delays().source.expr())));
}

Expr TimedStatement::arrives_by(const std::string& kind, const Expr& latest) const {
  return is(timed::in_flight(kind)) && by(is(timed::arrives(kind)), latest);
}

void give(Certificate& certificate, std::string words, const Expr& holds) {
  certificate.given.push_back({std::move(words), holds});
  certificate.system.initial = certificate.system.initial && holds;
}

Certificate certificate_in_time(const TimedDescriptor& descriptor, const Moving& moving) {
  Certificate certificate{.system = moving.system,
                          .constants = descriptor.unknowns(),
                          .candidates = candidates_of(descriptor, moving)};
  for (const Expr& assumption : descriptor.assumptions()) give(certificate, "given", assumption);
  return certificate;
}

Certificate certificate_of(const TimedDescriptor& descriptor, const TimedStatement& statement) {
  const Moving moving{descriptor.whole()};
  Certificate certificate = certificate_in_time(descriptor, moving);
  const auto add = [&](const std::vector<Clause>& from, std::vector<Clause>& to) {
    for (const Clause& clause : from) to.push_back({clause.words, moving(clause.holds)});
  };
  add(statement.stated, certificate.invariant);
  add(statement.conclusions, certificate.conclusions);
  for (const StepClause& clause : statement.on_steps) {
    certificate.on_steps.push_back(
        {clause.words, clause.step, moving(clause.before), moving(clause.after)});
  }
  return certificate;
}

}  // namespace stormproof::tables
