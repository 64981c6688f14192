// The comparison of the two orders, and how it is shown.
#include "checker/engines/tables/commutation_matrix.hpp"

#include <algorithm>

namespace stormproof::tables {
namespace {

/// Two events from one state, in both orders.
struct BothOrders {
  EventInstance a;
  EventInstance b;
  Outcome after_a;
  Outcome after_ab;
  Outcome after_b;
  Outcome after_ba;

  BothOrders(const RelationModel& relation, const EventKindModel& first,
             const EventKindModel& second)
      : a{first.make("a.", relation.variables)},
        b{second.make("b.", relation.variables)},
        after_a{a.apply(relation.variables)},
        after_ab{b.apply(after_a.state)},
        after_b{b.apply(relation.variables)},
        after_ba{a.apply(after_b.state)} {}

  /// The outputs of both events, as one collection.
  [[nodiscard]] Expr outputs_differ(std::size_t k) const {
    return after_a.outputs[k] + after_ab.outputs[k] != after_b.outputs[k] + after_ba.outputs[k];
  }
  [[nodiscard]] Expr state_differs(std::size_t k) const {
    return after_ab.state[k] != after_ba.state[k];
  }
  [[nodiscard]] Expr differ() const {
    Exprs differences;
    for (std::size_t k = 0; k < after_a.state.size(); ++k) differences.push_back(state_differs(k));
    for (std::size_t k = 0; k < after_a.outputs.size(); ++k) {
      differences.push_back(outputs_differ(k));
    }
    return any_of(differences).simplify();
  }
};

std::string or_nothing(std::string text) { return text.empty() ? "none set" : text; }

std::string witness_text(const z3::model& model, const RelationModel& relation,
                         const BothOrders& orders, const std::string& a, const std::string& b) {
  Exprs inputs = orders.a.inputs;
  inputs.insert(inputs.end(), orders.b.inputs.begin(), orders.b.inputs.end());
  std::string text = "from " + notable_in(model, relation.variables) +
                     " (knobs: " + or_nothing(notable_in(model, relation.knobs)) + "; a = " + a +
                     ", b = " + b + ", inputs: " + or_nothing(notable_in(model, inputs)) +
                     ") the order a, b / b, a leads to";
  for (std::size_t k = 0; k < relation.variables.size(); ++k) {
    if (!is_true_in(model, orders.state_differs(k))) continue;
    text += " " + relation.variables[k].decl().name().str() + ": " +
            value_text(model, orders.after_ab.state[k]) + " / " +
            value_text(model, orders.after_ba.state[k]) + ";";
  }
  for (std::size_t k = 0; k < relation.outputs.size(); ++k) {
    if (!is_true_in(model, orders.outputs_differ(k))) continue;
    text += " " + relation.outputs[k] + ": " +
            value_text(model, orders.after_a.outputs[k] + orders.after_ab.outputs[k]) + " / " +
            value_text(model, orders.after_b.outputs[k] + orders.after_ba.outputs[k]) + ";";
  }
  text.pop_back();
  return text;
}

PairResult compare(Proof& proof, const RelationModel& relation, std::size_t first,
                   std::size_t second) {
  const EventKindModel& a = relation.kinds[first];
  const EventKindModel& b = relation.kinds[second];
  PairResult result{first, second, Verdict::excluded, {}};
  if (first == second && !a.repeats) return result;
  const BothOrders orders{relation, a, b};
  const std::string pair = a.name + " and " + b.name;
  const Exprs conditions{relation.possible, orders.a.possible, orders.b.possible, orders.differ()};
  auto decision = proof.ask(pair + ": the order matters", conditions);
  if (decision.answer == smt::Answer::unsat) {
    result.verdict = Verdict::commutes;
    return result;
  }
  result.verdict = Verdict::unknown;
  if (decision.answer == smt::Answer::unknown) return result;
  result.verdict = Verdict::unreachable;
  result.witness = witness_text(*decision.model, relation, orders, a.name, b.name);
  Exprs in_runs = conditions;
  in_runs.insert(in_runs.end(), {relation.consistent, orders.a.consistent, orders.b.consistent});
  decision = proof.ask(pair + ": the order matters in a state of a run", in_runs);
  if (decision.answer == smt::Answer::sat) {
    result.verdict = Verdict::matters;
    result.witness = witness_text(*decision.model, relation, orders, a.name, b.name);
  }
  if (decision.answer == smt::Answer::unknown) result.verdict = Verdict::unknown;
  return result;
}

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width > text.size() ? width - text.size() : 0, ' ');
}

}  // namespace

std::vector<PairResult> commutation_matrix(Proof& proof, const RelationModel& relation) {
  std::vector<PairResult> results;
  for (std::size_t i = 0; i < relation.kinds.size(); ++i) {
    for (std::size_t j = i; j < relation.kinds.size(); ++j) {
      results.push_back(compare(proof, relation, i, j));
    }
  }
  return results;
}

std::vector<std::string> matrix_lines(const RelationModel& relation,
                                      const std::vector<PairResult>& results) {
  std::size_t width = 0;
  for (const EventKindModel& kind : relation.kinds) width = std::max(width, kind.name.size());
  std::vector<std::string> lines;
  std::string heading = padded("", width + 4);
  for (std::size_t k = 0; k < relation.kinds.size(); ++k) {
    heading += padded(std::to_string(k + 1), 3);
  }
  lines.push_back(heading);
  for (std::size_t i = 0; i < relation.kinds.size(); ++i) {
    std::string line = padded(std::to_string(i + 1), 3) + padded(relation.kinds[i].name, width + 1);
    for (std::size_t j = 0; j < relation.kinds.size(); ++j) {
      for (const PairResult& result : results) {
        if (result.first != std::min(i, j) || result.second != std::max(i, j)) continue;
        line += padded(std::string(1, static_cast<char>(result.verdict)), 3);
      }
    }
    lines.push_back(line);
  }
  lines.push_back(
      ". commutes from every state   X the order matters   u it matters only in states "
      "that no run reaches   - never two at once");
  return lines;
}

}  // namespace stormproof::tables
