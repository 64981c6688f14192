// Questions, their answers, and the verdict.
#include "checker/engines/tables/proof.hpp"

#include <algorithm>

namespace stormproof::tables {

Proof::Proof(std::string_view property, const checker::CheckRequest& request)
    : request_{request}, property_{property}, scenario_{checker::scenario_to_run(request)} {
  finding_.engine = "tables";
  finding_.seed = request.claims.options().seed;
}

const model::Mutation& Proof::mistakes() const {
  static const model::Mutation none;
  return request_.mutant != nullptr ? request_.mutant->rules : none;
}

bool Proof::concerns(std::string_view machine) const {
  if (request_.mutant == nullptr) return true;
  return std::ranges::any_of(mistakes().tables, [&](const fsm::TableMutation& mistake) {
    return mistake.machine == machine;
  });
}

smt::Decision Proof::ask(std::string_view query, const Exprs& conditions) {
  z3::expr_vector assertions{context_};
  for (const Expr& condition : conditions) assertions.push_back(condition);
  smt::Decision decision = request_.claims.decide(property_, query, assertions);
  ++asked_;
  if (decision.answer == smt::Answer::unknown) {
    give_up(std::string{query} + ": no answer (" + decision.why + ")");
  }
  return decision;
}

void Proof::give_up(std::string why) {
  if (gap_.empty()) gap_ = std::move(why);
}

void Proof::dispute(std::string why) {
  if (dispute_.empty()) dispute_ = std::move(why);
}

void Proof::violate(std::string line) {
  violated_ = true;
  detail(std::move(line));
}

props::Finding Proof::finish(std::string how) {
  const smt::SecondOpinion opinion = request_.claims.second_opinion(property_);
  if (asked_ > 0) finding_.solver = request_.claims.solver_name();
  finding_.how = std::move(how);
  if (asked_ > 0) {
    finding_.how += "; " + std::to_string(asked_) + (asked_ == 1 ? " condition" : " conditions");
    finding_.how += " decided by z3";
  }
  if (opinion.asked) {
    finding_.solver += " + " + opinion.solver;
    if (opinion.agrees) finding_.how += " and " + opinion.solver.substr(0, 4);
    const std::string difference = "the solvers do not agree: " + opinion.difference;
    if (!opinion.agrees) opinion.contradicts ? dispute(difference) : give_up(difference);
  }
  if (!opinion.problem.empty()) detail("export: " + opinion.problem);
  finding_.kind = violated_ ? props::VerdictKind::violated : props::VerdictKind::proved;
  if (!gap_.empty()) {
    finding_.kind = props::VerdictKind::inconclusive;
    finding_.how += "; inconclusive: " + gap_;
    detail("inconclusive: " + gap_);
  }
  if (!dispute_.empty()) {
    props::dispute(finding_, dispute_);
    detail("disputed: " + dispute_);
  }
  const auto elapsed = std::chrono::steady_clock::now() - start_;
  finding_.seconds = std::chrono::duration<double>(elapsed).count();
  return std::move(finding_);
}

Expr any_of(const Exprs& parts) {
  z3::expr_vector list{smt::SymbolicContext::current()};
  for (const Expr& part : parts) list.push_back(part);
  return z3::mk_or(list);
}

Expr all_of(const Exprs& parts) {
  z3::expr_vector list{smt::SymbolicContext::current()};
  for (const Expr& part : parts) list.push_back(part);
  return z3::mk_and(list);
}

std::string value_text(const z3::model& model, const Expr& expr) {
  const std::string text = model.eval(expr, true).to_string();
  // Negative numbers are spelt (- 3).
  if (text.starts_with("(- ")) return "-" + text.substr(3, text.size() - 4);
  return text;
}

std::string notable_in(const z3::model& model, const Exprs& unknowns) {
  std::string text;
  for (const Expr& unknown : unknowns) {
    const std::string value = value_text(model, unknown);
    if (value == "false" || value == "0") continue;
    text += text.empty() ? "" : ", ";
    text += unknown.decl().name().str() + (value == "true" ? "" : " = " + value);
  }
  return text;
}

bool is_true_in(const z3::model& model, const Expr& expr) {
  return model.eval(expr, true).is_true();
}

std::string values_in(const z3::model& model, const Exprs& unknowns) {
  std::string text;
  for (const Expr& unknown : unknowns) {
    if (!text.empty()) text += ", ";
    text += unknown.decl().name().str() + " = " + value_text(model, unknown);
  }
  return text.empty() ? "any input" : text;
}

}  // namespace stormproof::tables
