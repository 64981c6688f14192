// Conditions, their answers, and the verdict.
#include "checker/engines/timeline/theorem.hpp"

namespace stormproof::timeline {

Theorem::Theorem(std::string_view property, const checker::CheckRequest& request)
    : request_{request}, property_{property} {}

Int Theorem::at_least(const std::string& name, const Int& low) {
  const Int value = number(name);
  assume(value >= low);
  return value;
}

Int Theorem::within(const std::string& name, const Int& low, const Int& high) {
  const Int value = at_least(name, low);
  assume(value <= high);
  return value;
}

void Theorem::assume(const Bool& fact) { assumptions_.push_back(fact); }

void Theorem::close(std::size_t mark) {
  assumptions_.erase(assumptions_.begin() + static_cast<std::ptrdiff_t>(mark), assumptions_.end());
}

z3::expr Theorem::assumptions() {
  z3::expr_vector all{context_};
  for (const Bool& fact : assumptions_) all.push_back(fact.expr());
  return z3::mk_and(all);
}

smt::Answer Theorem::ask(std::string_view condition, const Bool& claim) {
  z3::expr_vector query{context_};
  for (const Bool& fact : assumptions_) query.push_back(fact.expr());
  query.push_back(claim.expr());
  const smt::Decision decision = request_.claims.decide(property_, condition, query);
  ++asked_;
  if (decision.answer == smt::Answer::unknown) {
    give_up(std::string{condition} + ": no answer (" + decision.why + ")");
  }
  return decision.answer;
}

bool Theorem::holds(std::string_view condition, const Bool& claim) {
  const smt::Answer answer = ask(condition, !claim);
  if (answer == smt::Answer::sat) give_up(std::string{condition} + ": refuted");
  return answer == smt::Answer::unsat;
}

bool Theorem::possible(std::string_view condition, const Bool& claim) {
  const smt::Answer answer = ask(condition, claim);
  if (answer == smt::Answer::unsat) give_up(std::string{condition} + ": impossible");
  return answer == smt::Answer::sat;
}

void Theorem::give_up(std::string why) {
  if (gap_.empty()) gap_ = std::move(why);
}

props::Finding Theorem::finish(std::string how) {
  const smt::SecondOpinion opinion = request_.claims.second_opinion(property_);
  props::Finding finding;
  finding.engine = "timelines";
  finding.seed = request_.claims.options().seed;
  finding.solver = request_.claims.solver_name();
  finding.how = std::move(how) + "; " + std::to_string(asked_) + " conditions decided by z3";
  if (!is_asked_for()) finding.how = "boundary runs of a theorem, under the mutant's rules";
  if (opinion.asked) {
    finding.solver += " + " + opinion.solver;
    if (opinion.agrees) {
      finding.how += " and " + opinion.solver.substr(0, opinion.solver.find(' '));
    } else {
      give_up("the solvers do not agree: " + opinion.difference);
    }
  }
  if (!opinion.problem.empty()) finding.details.push_back("export: " + opinion.problem);
  finding.kind = proved() ? props::VerdictKind::proved : props::VerdictKind::inconclusive;
  if (opinion.contradicts) {
    props::dispute(finding, "the solvers do not agree: " + opinion.difference);
  } else if (!proved()) {
    finding.how += "; inconclusive: " + gap_;
  }
  const auto elapsed = std::chrono::steady_clock::now() - start_;
  finding.seconds = std::chrono::duration<double>(elapsed).count();
  return finding;
}

Parameters::Parameters(Theorem& theorem)
    : least{theorem.at_least("mu", 0)},
      delta{theorem.at_least("delta", least)},
      source{theorem.within("sigma", 0, delta)},
      timers{theorem.at_least("tau_A", 0), theorem.at_least("tau_N", 0),
             theorem.at_least("tau_S", 0)},
      period{theorem.at_least("tau_H", 1)} {}

Passage<Sym> Parameters::passage(Theorem& theorem, const std::string& name) const {
  Passage<Sym> passage;
  passage.delay = theorem.within(name + "_delay", least, delta);
  passage.leaves = theorem.within(name + "_leaves", 0, source);
  passage.lost = theorem.choice(name + "_lost");
  return passage;
}

}  // namespace stormproof::timeline
