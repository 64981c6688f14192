// Spacer, the check of its certificate, and the search for the shortest trace.
#include "checker/engines/tables/transition_system.hpp"

#include <optional>

#include "checker/engines/smt/deadline.hpp"

namespace stormproof::tables {
namespace {

constexpr std::size_t longest_trace = 24;

z3::expr_vector as_vector(const Exprs& list) {
  z3::expr_vector vector{smt::SymbolicContext::current()};
  for (const Expr& expr : list) vector.push_back(expr);
  return vector;
}

struct SpacerAnswer {
  smt::Answer reachable = smt::Answer::unknown;
  std::optional<Expr> invariant;  ///< of unsat
  std::string why;                ///< of unknown
};

void add_rule(z3::fixedpoint& engine, const Exprs& bound, const Expr& body, const Expr& head,
              const std::string& name) {
  const Expr implication = z3::implies(body, head);
  Expr rule = bound.empty() ? implication : z3::forall(as_vector(bound), implication);
  engine.add_rule(rule, rule.ctx().str_symbol(name.c_str()));
}

Expr moved(const Expr& expr, z3::context& to) { return {to, Z3_translate(expr.ctx(), expr, to)}; }
Exprs moved(const Exprs& list, z3::context& to) {
  Exprs result;
  for (const Expr& expr : list) result.push_back(moved(expr, to));
  return result;
}
TransitionSystem moved(const TransitionSystem& system, z3::context& to) {
  TransitionSystem result{
      moved(system.variables, to), moved(system.initial, to), {}, moved(system.bad, to)};
  for (const SystemStep& step : system.steps) {
    result.steps.push_back(
        {step.name, moved(step.inputs, to), moved(step.guard, to), moved(step.next, to)});
  }
  return result;
}

/// In a context of its own: one in which a search was interrupted is not trusted any more.
SpacerAnswer ask_spacer(const TransitionSystem& original, const smt::Options& options) {
  z3::context& asking = smt::SymbolicContext::current();
  z3::context context;
  const smt::SymbolicContext current{context};
  const TransitionSystem system = moved(original, context);
  z3::fixedpoint engine{context};
  z3::params params{context};
  params.set("engine", context.str_symbol("spacer"));
  params.set("spacer.random_seed", options.seed);
  // Keep the relation as it is, so that its invariant can be asked for.
  params.set("xform.slice", false);
  params.set("xform.inline_linear", false);
  params.set("xform.inline_eager", false);
  engine.set(params);
  z3::sort_vector sorts{context};
  for (const Expr& variable : system.variables) sorts.push_back(variable.get_sort());
  z3::func_decl reached = context.function("reached", sorts, context.bool_sort());
  z3::func_decl broken = context.function("broken", z3::sort_vector{context}, context.bool_sort());
  engine.register_relation(reached);
  engine.register_relation(broken);
  const Expr here = reached(as_vector(system.variables));
  add_rule(engine, system.variables, system.initial, here, "initial");
  for (const SystemStep& step : system.steps) {
    Exprs bound = system.variables;
    bound.insert(bound.end(), step.inputs.begin(), step.inputs.end());
    add_rule(engine, bound, here && step.guard, reached(as_vector(step.next)), step.name);
  }
  add_rule(engine, system.variables, here && system.bad, broken(), "bad");
  SpacerAnswer answer;
  z3::func_decl_vector queries{context};
  queries.push_back(broken);
  smt::Deadline deadline{context, options.timeout / 2};  // what is left is for unrolling
  z3::check_result result = z3::unknown;
  try {
    result = engine.query(queries);
  } catch (const z3::exception& error) {
    if (!deadline.expired()) throw;
    answer.why = "time-out";
    return answer;
  }
  switch (result) {
    case z3::sat:
      answer.reachable = smt::Answer::sat;
      break;
    case z3::unsat: {
      answer.reachable = smt::Answer::unsat;
      Expr found = engine.get_cover_delta(-1, reached);
      answer.invariant = moved(found.substitute(as_vector(system.variables)).simplify(), asking);
      break;
    }
    case z3::unknown:
      answer.why = deadline.expired() ? "time-out" : engine.reason_unknown();
      break;
  }
  return answer;
}

/// The plain conditions that make `invariant` a proof. Whether all of them hold.
bool certify(Proof& proof, const TransitionSystem& system, const Expr& invariant) {
  bool holds = !proof.possible("initially: the invariant fails", {system.initial, !invariant});
  for (const SystemStep& step : system.steps) {
    const Expr after = with(invariant, system.variables, step.next);
    holds =
        !proof.possible(step.name + ": the invariant is lost", {invariant, step.guard, !after}) &&
        holds;
  }
  return !proof.possible("the invariant admits a bad state", {invariant, system.bad}) && holds;
}

std::string number(std::size_t k) { return std::to_string(k); }

/// A system unrolled over time: copies of its variables and inputs, and which step is taken.
class Unrolling {
 public:
  explicit Unrolling(const TransitionSystem& system)
      : system_{system}, context_{smt::SymbolicContext::current()} {
    states_.push_back(copies(system.variables, "@0"));
    conditions_.push_back(with(system.initial, system.variables, states_[0]));
  }

  /// Adds one more step.
  void extend() {
    const std::string suffix = "@" + number(states_.size());
    const Exprs before = states_.back();
    states_.push_back(copies(system_.variables, suffix));
    const Exprs& after = states_.back();
    taken_.emplace_back();
    inputs_.emplace_back();
    for (const SystemStep& step : system_.steps) {
      Exprs from = system_.variables;
      from.insert(from.end(), step.inputs.begin(), step.inputs.end());
      const Exprs inputs = copies(step.inputs, " of " + step.name + suffix);
      Exprs to = before;
      to.insert(to.end(), inputs.begin(), inputs.end());
      const Expr taken = context_.bool_const((step.name + suffix).c_str());
      Exprs effect{with(step.guard, from, to)};
      for (std::size_t k = 0; k < after.size(); ++k) {
        effect.push_back(after[k] == with(step.next[k], from, to));
      }
      conditions_.push_back(z3::implies(taken, all_of(effect)));
      taken_.back().push_back(taken);
      inputs_.back().push_back(inputs);
    }
    conditions_.push_back(any_of(taken_.back()));
  }

  /// The last state is bad.
  [[nodiscard]] Exprs ends_badly() const {
    Exprs conditions = conditions_;
    conditions.push_back(with(system_.bad, system_.variables, states_.back()));
    return conditions;
  }

  /// The steps that a model takes, with what changes at each.
  [[nodiscard]] std::vector<std::string> lines(const z3::model& model) const {
    std::vector<std::string> result;
    for (std::size_t t = 0; t < taken_.size(); ++t) {
      std::size_t step = 0;
      while (!is_true_in(model, taken_[t][step])) ++step;
      std::string line = "  " + number(t + 1) + ". " + system_.steps[step].name;
      const std::string inputs = input_text(model, system_.steps[step], inputs_[t][step]);
      if (!inputs.empty()) line += " (" + inputs + ")";
      result.push_back(line + changes(model, t));
    }
    return result;
  }

 private:
  /// The inputs of a step that are set, by their own names.
  static std::string input_text(const z3::model& model, const SystemStep& step,
                                const Exprs& copies_of_inputs) {
    std::string text;
    for (std::size_t k = 0; k < step.inputs.size(); ++k) {
      const std::string value = value_text(model, copies_of_inputs[k]);
      const bool hidden = step.inputs[k].decl().name().str().front() == hidden_input;
      if (hidden || value == "false" || value == "0") continue;
      text += text.empty() ? "" : ", ";
      text += step.inputs[k].decl().name().str() + (value == "true" ? "" : " = " + value);
    }
    return text;
  }
  /// What step `t` changes. Of a machine that moves only the new state is shown.
  [[nodiscard]] std::string changes(const z3::model& model, std::size_t t) const {
    std::string text;
    for (std::size_t k = 0; k < system_.variables.size(); ++k) {
      const std::string name = system_.variables[k].decl().name().str();
      const std::string now = value_text(model, states_[t + 1][k]);
      const bool left = now == "false" && name.find('=') != std::string::npos;
      if (left || now == value_text(model, states_[t][k])) continue;
      text += text.empty() ? ": " : ", ";
      text += now == "true" ? name : now == "false" ? "not " + name : name + " = " + now;
    }
    return text;
  }
  Exprs copies(const Exprs& originals, const std::string& suffix) const {
    Exprs result;
    for (const Expr& original : originals) {
      const std::string name = original.decl().name().str() + suffix;
      result.push_back(context_.constant(name.c_str(), original.get_sort()));
    }
    return result;
  }

  const TransitionSystem& system_;
  z3::context& context_;
  std::vector<Exprs> states_;
  std::vector<Exprs> taken_;                // by time and step
  std::vector<std::vector<Exprs>> inputs_;  // by time and step
  Exprs conditions_;
};

/// Looks for the shortest sequence of steps to a bad state. Returns whether there is one.
bool find_trace(Proof& proof, const TransitionSystem& system, const std::string& breaks) {
  Unrolling unrolling{system};
  for (std::size_t length = 0; length <= longest_trace; ++length) {
    if (length > 0) unrolling.extend();
    const auto decision =
        proof.ask("a bad state after " + number(length) + " steps", unrolling.ends_badly());
    if (decision.answer == smt::Answer::unknown) return false;
    if (decision.answer == smt::Answer::unsat) continue;
    proof.violate(breaks + ", after " + number(length) + " steps:");
    for (std::string& line : unrolling.lines(*decision.model)) proof.detail(std::move(line));
    return true;
  }
  return false;
}

}  // namespace

Expr with(const Expr& expr, const Exprs& variables, const Exprs& values) {
  Expr copy = expr;
  return copy.substitute(as_vector(variables), as_vector(values));
}

std::string prove_unreachable(Proof& proof, const TransitionSystem& system,
                              const std::string& breaks) {
  const SpacerAnswer answer = ask_spacer(system, proof.request().claims.options());
  if (answer.reachable != smt::Answer::unsat) {
    const bool found = find_trace(proof, system, breaks);
    if (!found && answer.reachable == smt::Answer::unknown) {
      proof.give_up("Spacer has no answer (" + answer.why + ")");
    } else if (!found) {
      proof.give_up("Spacer reaches a bad state, but no trace of up to " + number(longest_trace) +
                    " steps does");
    }
    return found ? "Spacer; shortest sequence of steps by unrolling" : "Spacer";
  }
  proof.detail("invariant:");
  for (const std::string& line : invariant_lines(*answer.invariant)) proof.detail("  " + line);
  if (!certify(proof, system, *answer.invariant)) {
    proof.give_up("Spacer's invariant does not pass its check");
  }
  return "Spacer, any number of steps; its invariant checked again (initially, at each step, at "
         "the end)";
}

}  // namespace stormproof::tables
