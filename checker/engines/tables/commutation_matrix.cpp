// The comparison of the two orders, and how it is shown.
#include "checker/engines/tables/commutation_matrix.hpp"

#include <algorithm>
#include <map>

namespace stormproof::tables {
namespace {

/// Effects by their names.
using Effects = std::map<std::string, std::vector<SymbolicEffect>>;

Effects by_name(const std::vector<SymbolicEffect>& effects) {
  Effects result;
  for (const SymbolicEffect& effect : effects) {
    if (!effect.when.is_false()) result[effect.what].push_back(effect);
  }
  return result;
}

/// How many of `effects` happen; with `like`, of those with its content.
Expr count_of(const std::vector<SymbolicEffect>& effects, const SymbolicEffect* like = nullptr) {
  z3::context& context = smt::SymbolicContext::current();
  Expr total = context.int_val(0);
  for (const SymbolicEffect& effect : effects) {
    Exprs same{effect.when};
    for (std::size_t k = 0; like != nullptr && k < like->content.size(); ++k) {
      same.push_back(effect.content[k] == like->content[k]);
    }
    total = total + z3::ite(all_of(same), context.int_val(1), context.int_val(0));
  }
  return total.simplify();
}

/// Takes out of both what is literally the same in both.
void cancel(std::vector<SymbolicEffect>& one, std::vector<SymbolicEffect>& other) {
  const auto same = [](const SymbolicEffect& a, const SymbolicEffect& b) {
    return z3::eq(a.when, b.when) &&
           std::ranges::equal(a.content, b.content,
                              [](const Expr& x, const Expr& y) { return z3::eq(x, y); });
  };
  std::erase_if(one, [&](const SymbolicEffect& effect) {
    const auto found = std::ranges::find_if(
        other, [&](const SymbolicEffect& candidate) { return same(effect, candidate); });
    if (found == other.end()) return false;
    other.erase(found);
    return true;
  });
}

/// As collections the effects are not the same.
Expr effects_differ(const std::vector<SymbolicEffect>& one,
                    const std::vector<SymbolicEffect>& other) {
  Exprs differences;
  for (const auto* list : {&one, &other}) {
    for (const SymbolicEffect& effect : *list) {
      differences.push_back(effect.when && count_of(one, &effect) != count_of(other, &effect));
    }
  }
  return any_of(differences).simplify();
}

/// Two events from one state, in both orders.
class BothOrders {
 public:
  BothOrders(const EventGroup& group, const EventKind& a, const EventKind& b, Extent extent,
             const std::vector<fsm::TableMutation>& mistakes)
      : ab_{extent, mistakes}, ba_{extent, mistakes} {
    SymbolicRun before{extent, mistakes};
    SymbolicRun in_run{extent, mistakes};
    a.happen(ab_, "a.");
    b.happen(ab_, "b.");
    b.happen(ba_, "b.");
    a.happen(ba_, "a.");
    const EventConditions of_a = a.conditions(before, "a.");
    const EventConditions of_b = b.conditions(before, "b.");
    consistent_ = {group.consistent(in_run), of_a.consistent, of_b.consistent};
    consistent_.push_back(in_run.possible());
    conditions_ = {group.possible(before), of_a.possible, of_b.possible};
    for (const SymbolicRun* run : {&before, &ab_, &ba_}) conditions_.push_back(run->possible());
    collect();
    Exprs differences;
    for (const auto& [name, differs] : differences_) differences.push_back(differs);
    conditions_.push_back(any_of(differences).simplify());
  }

  /// Both orders lead to literally the same.
  [[nodiscard]] bool are_equal() const { return conditions_.back().is_false(); }
  /// The order matters.
  [[nodiscard]] const Exprs& conditions() const { return conditions_; }
  /// The same in a state of a run.
  [[nodiscard]] Exprs in_runs() const {
    Exprs all = conditions_;
    all.insert(all.end(), consistent_.begin(), consistent_.end());
    return all;
  }
  /// From which state and with which events, and what then differs.
  [[nodiscard]] std::string witness(const z3::model& model, const std::string& a,
                                    const std::string& b) const {
    std::map<std::string, SymbolicRun::Variable> touched = ab_.variables();
    touched.insert(ba_.variables().begin(), ba_.variables().end());
    Exprs state;
    for (const auto& [name, variable] : touched) state.push_back(variable.at_first);
    std::string text = "from " + or_nothing(notable_in(model, state)) +
                       " (knobs: " + or_nothing(notable_in(model, ab_.knobs())) + "; a = " + a +
                       ", b = " + b + ", inputs: " + or_nothing(notable_in(model, ab_.inputs())) +
                       ") the order a, b / b, a leads to";
    for (const auto& [name, differs] : differences_) {
      if (!is_true_in(model, differs)) continue;
      const auto& [one, other] = values_.at(name);
      const std::string first = value_text(model, one);
      const std::string second = value_text(model, other);
      text += " " + name + ": " + first + " / " + second + (first == second ? " others" : "");
      text += ";";
    }
    text.pop_back();
    return text;
  }

 private:
  static std::string or_nothing(std::string text) { return text.empty() ? "none set" : text; }
  static Expr value_in(const SymbolicRun& run, const std::string& name, const Expr& at_first) {
    const auto found = run.variables().find(name);
    return found == run.variables().end() ? at_first : found->second.now;
  }
  void collect() {
    for (const SymbolicRun* run : {&ab_, &ba_}) {
      for (const auto& [name, variable] : run->variables()) {
        compare(name, value_in(ab_, name, variable.at_first),
                value_in(ba_, name, variable.at_first));
      }
    }
    Effects ab = by_name(ab_.effects());
    Effects ba = by_name(ba_.effects());
    for (const auto& [name, list] : Effects{ba}) ab.try_emplace(name);
    for (auto& [name, one] : ab) {
      std::vector<SymbolicEffect>& other = ba[name];
      cancel(one, other);
      if (one.empty() && other.empty()) continue;
      values_.try_emplace(name, count_of(one), count_of(other));
      differences_.try_emplace(name, effects_differ(one, other));
    }
  }
  void compare(const std::string& name, const Expr& one, const Expr& other) {
    if (z3::eq(one, other)) return;
    values_.try_emplace(name, one, other);
    differences_.try_emplace(name, (one != other).simplify());
  }

  SymbolicRun ab_;
  SymbolicRun ba_;
  Exprs conditions_;
  Exprs consistent_;
  std::map<std::string, Expr> differences_;
  std::map<std::string, std::pair<Expr, Expr>> values_;
};

PairResult compare_orders(Proof& proof, const EventGroup& group, std::size_t first,
                          std::size_t second, Extent extent) {
  const EventKind& a = group.kinds[first];
  const EventKind& b = group.kinds[second];
  PairResult result{first, second, Verdict::unknown, {}};
  const BothOrders orders{group, a, b, extent, proof.mistakes().tables};
  const std::string pair = a.name + " and " + b.name;
  if (orders.are_equal()) {
    result.verdict = Verdict::commutes;
    return result;
  }
  auto decision = proof.ask(pair + ": the order matters", orders.conditions());
  if (decision.answer == smt::Answer::unsat) result.verdict = Verdict::commutes;
  if (decision.answer != smt::Answer::sat) return result;
  result.verdict = Verdict::unreachable;
  result.witness = orders.witness(*decision.model, a.name, b.name);
  decision = proof.ask(pair + ": the order matters in a state of a run", orders.in_runs());
  if (decision.answer == smt::Answer::sat) {
    result.verdict = Verdict::matters;
    result.witness = orders.witness(*decision.model, a.name, b.name);
  }
  if (decision.answer == smt::Answer::unknown) result.verdict = Verdict::unknown;
  return result;
}

/// Of each kind, whether its event steps a machine whose table has to be looked at. The state is
/// free, so whatever it can step after another event it can step here.
std::vector<bool> concerned_kinds(const Proof& proof, const EventGroup& group, Extent extent) {
  std::vector<bool> concerned(group.kinds.size(), proof.request().mutant == nullptr);
  if (proof.mistakes().tables.empty()) return concerned;
  for (std::size_t k = 0; k < group.kinds.size(); ++k) {
    SymbolicRun run{extent, proof.mistakes().tables};
    group.kinds[k].happen(run, "a.");
    concerned[k] = std::ranges::any_of(
        run.stepped(), [&](const std::string& machine) { return proof.concerns(machine); });
  }
  return concerned;
}

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width > text.size() ? width - text.size() : 0, ' ');
}

}  // namespace

std::vector<PairResult> commutation_matrix(Proof& proof, const EventGroup& group, Extent extent,
                                           const std::function<bool(const PairResult&)>& goes_on) {
  const std::vector<bool> concerned = concerned_kinds(proof, group, extent);
  std::vector<PairResult> results;
  for (std::size_t i = 0; i < group.kinds.size(); ++i) {
    for (std::size_t j = i; j < group.kinds.size(); ++j) {
      results.push_back(concerned[i] || concerned[j] ? compare_orders(proof, group, i, j, extent)
                                                     : PairResult{i, j, Verdict::unknown, {}});
      if (goes_on && !goes_on(results.back())) return results;
    }
  }
  return results;
}

std::vector<std::string> matrix_lines(const EventGroup& group,
                                      const std::vector<PairResult>& results) {
  std::size_t width = 0;
  for (const EventKind& kind : group.kinds) width = std::max(width, kind.name.size());
  std::vector<std::string> lines;
  std::string heading = padded("", width + 4);
  for (std::size_t k = 0; k < group.kinds.size(); ++k) {
    heading += padded(std::to_string(k + 1), 3);
  }
  lines.push_back(heading);
  for (std::size_t i = 0; i < group.kinds.size(); ++i) {
    std::string line = padded(std::to_string(i + 1), 3) + padded(group.kinds[i].name, width + 1);
    for (std::size_t j = 0; j < group.kinds.size(); ++j) {
      for (const PairResult& result : results) {
        if (result.first != std::min(i, j) || result.second != std::max(i, j)) continue;
        line += padded(std::string(1, static_cast<char>(result.verdict)), 3);
      }
    }
    lines.push_back(line);
  }
  lines.push_back(
      ". commutes from every state   X the order matters   u it matters only in states "
      "that no run reaches");
  return lines;
}

}  // namespace stormproof::tables
