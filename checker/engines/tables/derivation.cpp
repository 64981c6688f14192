// Collects variables and steps, and leaves out what cannot matter.
#include "checker/engines/tables/derivation.hpp"

#include <algorithm>
#include <set>

namespace stormproof::tables {
namespace {

z3::context& context_of_derivation() { return smt::SymbolicContext::current(); }

/// The numbers (`z3::expr::id`) of the constants in an expression.
class ConstantsOf {
 public:
  const std::set<unsigned>& operator()(const Expr& expr) {
    const auto [entry, fresh] = known_.try_emplace(expr.id());
    if (!fresh) return entry->second;
    std::set<unsigned> found;
    if (expr.is_const() && expr.decl().decl_kind() == Z3_OP_UNINTERPRETED) found.insert(expr.id());
    for (unsigned k = 0; k < expr.num_args(); ++k) {
      const std::set<unsigned> inner = (*this)(expr.arg(k));
      found.insert(inner.begin(), inner.end());
    }
    return known_[expr.id()] = std::move(found);
  }

 private:
  std::map<unsigned, std::set<unsigned>> known_;
};

/// Without the variables for which `keep` is false; these must not occur in what is kept.
TransitionSystem restricted(const TransitionSystem& system, const std::vector<bool>& keep) {
  TransitionSystem result{{}, system.initial, {}, system.bad};
  for (std::size_t v = 0; v < keep.size(); ++v) {
    if (keep[v]) result.variables.push_back(system.variables[v]);
  }
  for (const SystemStep& step : system.steps) {
    SystemStep smaller{step.name, {}, step.guard, {}};
    bool changes = false;
    for (std::size_t v = 0; v < keep.size(); ++v) {
      if (!keep[v]) continue;
      smaller.next.push_back(step.next[v]);
      changes = changes || !z3::eq(step.next[v], system.variables[v]);
    }
    if (!changes) continue;
    ConstantsOf constants;
    std::set<unsigned> used = constants(step.guard);
    for (const Expr& next : smaller.next) {
      const auto& more = constants(next);
      used.insert(more.begin(), more.end());
    }
    for (const Expr& input : step.inputs) {
      if (used.contains(input.id())) smaller.inputs.push_back(input);
    }
    result.steps.push_back(std::move(smaller));
  }
  return result;
}

/// The initial condition is a conjunction of `variable = value`, in their order.
Expr initial_value(const TransitionSystem& system, std::size_t variable) {
  return system.initial.arg(static_cast<unsigned>(variable)).arg(1);
}
/// That condition for fewer variables.
Expr restricted_initial(const Expr& initial, const Exprs& variables) {
  std::set<unsigned> kept;
  for (const Expr& variable : variables) kept.insert(variable.id());
  Exprs parts;
  for (unsigned k = 0; k < initial.num_args(); ++k) {
    if (kept.contains(initial.arg(k).arg(0).id())) parts.push_back(initial.arg(k));
  }
  return all_of(parts);
}

/// All expressions of a step with values in place of variables, in one go: the guard, then `next`.
Exprs with_values(const SystemStep& step, const Exprs& from, const Exprs& to) {
  z3::expr_vector parts{context_of_derivation()};
  parts.push_back(step.guard);
  z3::sort_vector sorts{context_of_derivation()};
  sorts.push_back(step.guard.get_sort());
  for (const Expr& next : step.next) {
    parts.push_back(next);
    sorts.push_back(next.get_sort());
  }
  const z3::func_decl all =
      context_of_derivation().function("all of a step", sorts, context_of_derivation().bool_sort());
  const Expr whole = with(all(parts), from, to).simplify();
  Exprs result;
  for (unsigned k = 0; k < whole.num_args(); ++k) result.push_back(whole.arg(k));
  return result;
}

/// The variables on which `bad` depends, over any number of steps.
std::vector<bool> seen_by(const TransitionSystem& system) {
  ConstantsOf constants;
  std::set<unsigned> seen = constants(system.bad);
  std::vector<bool> keep(system.variables.size(), false);
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t v = 0; v < keep.size(); ++v) {
      if (keep[v] || !seen.contains(system.variables[v].id())) continue;
      keep[v] = true;
      grows = true;
      for (const SystemStep& step : system.steps) {
        if (z3::eq(step.next[v], system.variables[v])) continue;
        for (const Expr& part : {step.guard, step.next[v]}) {
          const std::set<unsigned>& more = constants(part);
          seen.insert(more.begin(), more.end());
        }
      }
    }
  }
  return keep;
}

}  // namespace

std::vector<bool> never_changing(const TransitionSystem& system) {
  std::vector<bool> fixed(system.variables.size(), true);
  for (bool stable = false; !stable;) {
    stable = true;
    Exprs from;
    Exprs to;
    for (std::size_t v = 0; v < fixed.size(); ++v) {
      if (!fixed[v]) continue;
      from.push_back(system.variables[v]);
      to.push_back(initial_value(system, v));
    }
    for (const SystemStep& step : system.steps) {
      const Exprs after = with_values(step, from, to);
      if (after[0].is_false()) continue;
      for (std::size_t v = 0; v < fixed.size(); ++v) {
        if (!fixed[v] || z3::eq(after[v + 1], initial_value(system, v))) continue;
        fixed[v] = false;
        stable = false;
      }
    }
  }
  return fixed;
}

TransitionSystem with(const TransitionSystem& system, const Exprs& constants, const Exprs& values) {
  TransitionSystem result = system;
  for (SystemStep& step : result.steps) {
    const Exprs after = with_values(step, constants, values);
    step.guard = after[0];
    step.next.assign(after.begin() + 1, after.end());
  }
  std::erase_if(result.steps, [](const SystemStep& step) { return step.guard.is_false(); });
  result.bad = with(result.bad, constants, values).simplify();
  return result;
}

TransitionSystem without(const std::vector<bool>& never_changing, const TransitionSystem& system) {
  std::vector<bool> keep = never_changing;
  Exprs from;
  Exprs to;
  for (std::size_t v = 0; v < keep.size(); ++v) {
    keep[v] = !keep[v];
    if (keep[v]) continue;
    from.push_back(system.variables[v]);
    to.push_back(initial_value(system, v));
  }
  TransitionSystem result = restricted(with(system, from, to), keep);
  result.initial = restricted_initial(system.initial, result.variables);
  return result;
}

Moving::Moving(const TransitionSystem& whole) : Moving{whole, never_changing(whole)} {}

Moving::Moving(const TransitionSystem& whole, const std::vector<bool>& never)
    : system{without(never, whole)} {
  for (std::size_t v = 0; v < never.size(); ++v) {
    if (!never[v]) continue;
    from_.push_back(whole.variables[v]);
    to_.push_back(initial_value(whole, v));
  }
}

Expr Moving::operator()(const Expr& expr) const { return with(expr, from_, to_).simplify(); }

std::vector<bool> reasons(const TransitionSystem& system, const std::vector<bool>& never_changing,
                          std::vector<bool> of) {
  ConstantsOf constants;
  std::set<unsigned> seen;
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t v = 0; v < of.size(); ++v) {
      if (!of[v] && (!never_changing[v] || !seen.contains(system.variables[v].id()))) continue;
      if (!of[v]) grows = true;
      of[v] = true;
      for (const SystemStep& step : system.steps) {
        if (z3::eq(step.next[v], system.variables[v])) continue;
        for (const Expr& part : {step.guard, step.next[v]}) {
          const std::size_t before = seen.size();
          const std::set<unsigned>& more = constants(part);
          seen.insert(more.begin(), more.end());
          grows = grows || seen.size() > before;
        }
      }
    }
  }
  return of;
}

void Derivation::declare(const std::string& name, bool start) {
  index_[name] = variables_.size();
  variables_.push_back(context_of_derivation().bool_const(name.c_str()));
  start_.push_back(context_of_derivation().bool_val(start));
}

void Derivation::declare_count(const std::string& name) {
  index_[name] = variables_.size();
  variables_.push_back(context_of_derivation().int_const(name.c_str()));
  start_.push_back(context_of_derivation().int_val(0));
}

void Derivation::start_with(const std::string& name, bool value) {
  start_.at(index_.at(name)) = context_of_derivation().bool_val(value);
}

void Derivation::begin() {
  now_ = variables_;
  inputs_.clear();
  guard_ = context_of_derivation().bool_val(true);
}

void Derivation::end(const std::string& name) {
  bool changes = false;
  for (std::size_t v = 0; v < now_.size(); ++v) {
    now_[v] = now_[v].simplify();
    changes = changes || !z3::eq(now_[v], variables_[v]);
  }
  const Expr guard = guard_.simplify();
  if (changes && !guard.is_false()) steps_.push_back({name, inputs_, guard, now_});
}

void Derivation::assign(const std::string& name, const Expr& when, const Expr& value) {
  Expr& target = now(name);
  target = z3::ite(when, value, target).simplify();
}

Expr Derivation::input(const std::string& name) {
  inputs_.push_back(context_of_derivation().bool_const(name.c_str()));
  return inputs_.back();
}

Expr Derivation::unknown() { return input(hidden_input + std::to_string(inputs_.size())); }

Expr Derivation::unknown_count() {
  // Each step numbers its inputs anew: a name of two types cvc5 does not read.
  const std::string name = std::string{hidden_input, 'n'} + std::to_string(inputs_.size());
  inputs_.push_back(context_of_derivation().int_const(name.c_str()));
  require(inputs_.back() >= 0);
  return inputs_.back();
}

void Derivation::number_descriptors() { number_ = context_of_derivation().int_const(its_number); }

Expr Derivation::count_of_first(const Expr& ours_is_one) {
  const Expr count = unknown_count();
  require(*number_ >= 1);
  require((*number_ <= count) == ours_is_one);
  return count;
}

TransitionSystem Derivation::system() const {
  Exprs initial;
  for (std::size_t v = 0; v < variables_.size(); ++v) initial.push_back(variables_[v] == start_[v]);
  return {variables_, all_of(initial), steps_, context_of_derivation().bool_val(false)};
}

TransitionSystem what_matters(const TransitionSystem& system) {
  TransitionSystem smaller = without(never_changing(system), system);
  const Expr initial = smaller.initial;
  smaller = restricted(smaller, seen_by(smaller));
  smaller.initial = restricted_initial(initial, smaller.variables);
  return smaller;
}

}  // namespace stormproof::tables
