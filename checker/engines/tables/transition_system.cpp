// Spacer, the check of its certificate, and the search for the shortest trace.
#include "checker/engines/tables/transition_system.hpp"

#include <functional>
#include <optional>

#include "checker/engines/smt/deadline.hpp"
#include "checker/engines/tables/unrolling.hpp"

namespace stormproof::tables {
namespace {

constexpr std::size_t longest_trace = 24;

/// Spacer finds an invariant soon, or hardly ever: this part of what a query may cost is for it,
/// and the whole again for each length of the unrolling.
constexpr unsigned spacer_share = 20;

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
  z3::config config;
  config.set(
      "rlimit",
      std::to_string(options.budget.z3 / spacer_share).c_str());  // an engine has no such parameter
  z3::context context{config};
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
  smt::Deadline deadline{context, options.timeout / spacer_share, options.interrupted};
  z3::check_result result = z3::unknown;
  try {
    result = engine.query(queries);
  } catch (const z3::exception& error) {
    answer.why = deadline.expired() ? deadline.why() : error.msg();
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
      answer.why = deadline.expired() ? deadline.why() : engine.reason_unknown();
      break;
  }
  return answer;
}

std::string number(std::size_t k) { return std::to_string(k); }

/// Looks for the shortest sequence of steps to a bad state: none, if none is found.
std::optional<std::vector<std::string>> find_trace(Proof& proof, const TransitionSystem& system) {
  Unrolling unrolling{system};
  for (std::size_t length = 0; length <= longest_trace; ++length) {
    if (length > 0) unrolling.extend();
    const auto decision =
        proof.ask("a bad state after " + number(length) + " steps", unrolling.ends_badly());
    if (decision.answer == smt::Answer::unknown) return std::nullopt;
    if (decision.answer == smt::Answer::sat) return unrolling.lines(*decision.model);
  }
  return std::nullopt;
}

/// Asks for each condition of a certificate whether it can fail, until `take` says that it is
/// enough.
void ask_conditions(Proof& proof, const TransitionSystem& system, const Expr& invariant,
                    const std::function<bool(const std::string&, smt::Answer)>& take) {
  const auto asked = [&](const std::string& query, const Exprs& conditions) {
    return take(query, proof.ask(query, conditions).answer);
  };
  if (!asked("initially: the invariant fails", {system.initial, !invariant})) return;
  for (const SystemStep& step : system.steps) {
    const Expr after = with(invariant, system.variables, step.next);
    if (!asked(step.name + ": the invariant is lost", {invariant, step.guard, !after})) return;
  }
  asked("the invariant admits a bad state", {invariant, system.bad});
}

/// Whether an invariant of another system is one of this system, and excludes its bad states.
bool is_proof(Proof& proof, const TransitionSystem& system, const Expr& invariant) {
  bool holds = true;
  ask_conditions(proof, system, invariant, [&](const std::string&, smt::Answer answer) {
    holds = answer == smt::Answer::unsat;
    return holds;
  });
  return holds;
}

/// The property, the variables and what is bad; not the steps.
std::string question_of(const Proof& proof, const TransitionSystem& system) {
  std::string text = proof.property();
  for (const Expr& variable : system.variables) text += "\n" + variable.decl().to_string();
  return text + "\n" + system.bad.to_string();
}

std::string text_of(const Expr& expr) {
  z3::solver solver{expr.ctx(), z3::solver::simple()};
  solver.add(expr);
  return solver.to_smt2();
}

/// Constants of the same names and sorts are those of the current context.
Exprs expressions_in(const std::string& text) {
  Exprs list;
  for (const Expr& expr : smt::SymbolicContext::current().parse_string(text.c_str())) {
    list.push_back(expr);
  }
  return list;
}

}  // namespace

Expr with(const Expr& expr, const Exprs& variables, const Exprs& values) {
  Expr copy = expr;
  return copy.substitute(as_vector(variables), as_vector(values));
}

bool certify(Proof& proof, const TransitionSystem& system, const Expr& invariant) {
  bool holds = true;
  ask_conditions(proof, system, invariant, [&](const std::string& query, smt::Answer answer) {
    if (answer == smt::Answer::sat) proof.dispute("an invariant was found, but " + query);
    holds = holds && answer == smt::Answer::unsat;
    return true;
  });
  return holds;
}

Reached reach_bad(Proof& proof, const TransitionSystem& system) {
  smt::Claims& claims = proof.request().claims;
  const std::string question = question_of(proof, system);
  if (const auto text = claims.remembered_invariant(question)) {
    const Expr invariant = all_of(expressions_in(*text));
    if (is_proof(proof, system, invariant)) {
      return {smt::Answer::unsat, invariant_lines(invariant), ""};
    }
  }
  const SpacerAnswer answer = ask_spacer(system, claims.options());
  if (answer.reachable == smt::Answer::unsat) {
    if (!certify(proof, system, *answer.invariant)) {
      return {smt::Answer::unknown, {}, "Spacer's invariant does not pass its check"};
    }
    claims.remember_invariant(question, text_of(*answer.invariant));
    return {smt::Answer::unsat, invariant_lines(*answer.invariant), ""};
  }
  if (auto trace = find_trace(proof, system)) return {smt::Answer::sat, std::move(*trace), ""};
  if (answer.reachable == smt::Answer::unknown) {
    return {smt::Answer::unknown, {}, "Spacer has no answer (" + answer.why + ")"};
  }
  return {
      smt::Answer::unknown,
      {},
      "Spacer reaches a bad state, but no trace of up to " + number(longest_trace) + " steps does"};
}

std::string prove_unreachable(Proof& proof, const TransitionSystem& system,
                              const std::string& breaks) {
  Reached reached = reach_bad(proof, system);
  if (reached.answer == smt::Answer::sat) {
    proof.violate(breaks + ", after " + number(reached.lines.size()) + " steps:");
    for (std::string& line : reached.lines) proof.detail(std::move(line));
    return "Spacer; shortest sequence of steps by unrolling";
  }
  if (reached.answer == smt::Answer::unknown) {
    proof.give_up(reached.why);
    return "Spacer";
  }
  proof.detail("invariant:");
  for (const std::string& line : reached.lines) proof.detail("  " + line);
  return "Spacer, any number of steps; its invariant checked again (initially, at each step, at "
         "the end)";
}

}  // namespace stormproof::tables
