// First what no knob allows, then each knob by itself, then the least set of knobs.
#include "checker/engines/tables/ruled_out.hpp"

#include <algorithm>

#include "checker/engines/smt/deadline.hpp"
#include "model/config/knobs/other_choices.hpp"

namespace stormproof::tables {
namespace {

using Flags = std::vector<bool>;

/// A key of the profile, and the knobs of the composition that follow from it alone.
struct Key {
  std::string text;
  Flags decides;
};

std::vector<Key> keys_of(const EffectSystem& effects, const model::DdsProfile& dds) {
  std::vector<Key> keys;
  std::vector<std::size_t> deciders(effects.knobs.size(), 0);
  for (const auto& knob : model::config::other_choices(dds)) {
    Key key{knob.key + ": " + knob.value, {}};
    for (std::size_t k = 0; k < effects.knobs.size(); ++k) {
      const Expr value = effects.knobs[k].value(dds);
      const bool depends = std::ranges::any_of(knob.others, [&](const model::DdsProfile& other) {
        return !z3::eq(effects.knobs[k].value(other), value);
      });
      key.decides.push_back(depends);
      if (depends) ++deciders[k];
    }
    keys.push_back(std::move(key));
  }
  for (Key& key : keys) {
    for (std::size_t k = 0; k < key.decides.size(); ++k) {
      if (deciders[k] > 1) key.decides[k] = false;
    }
  }
  std::erase_if(keys, [](const Key& key) {
    return std::ranges::find(key.decides, true) == key.decides.end();
  });
  return keys;
}

class Explanation {
 public:
  Explanation(Proof& proof, const EffectSystem& effects, Flags impossible)
      : proof_{proof},
        effects_{effects},
        open_{std::move(impossible)},
        keys_{keys_of(effects, proof.scenario().dds)} {}

  std::vector<RuledOut> run() {
    if (any_open()) try_fixed(Flags(effects_.knobs.size(), false), "");
    for (const Key& key : by_what_they_rule_out()) {
      if (any_open()) try_fixed(key.decides, key.text);
    }
    if (any_open()) try_together();
    return std::move(groups_);
  }

 private:
  [[nodiscard]] bool any_open() const { return std::ranges::find(open_, true) != open_.end(); }

  /// Those first that make the most conditions of effects false by themselves.
  [[nodiscard]] std::vector<Key> by_what_they_rule_out() const {
    std::vector<std::pair<std::size_t, const Key*>> order;
    for (const Key& key : keys_) order.emplace_back(conditions_made_false(key), &key);
    std::ranges::stable_sort(order, [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<Key> keys;
    for (const auto& entry : order) keys.push_back(*entry.second);
    return keys;
  }
  [[nodiscard]] std::size_t conditions_made_false(const Key& key) const {
    Exprs from;
    Exprs to;
    for (std::size_t k = 0; k < key.decides.size(); ++k) {
      if (!key.decides[k]) continue;
      from.push_back(effects_.unknowns[k]);
      to.push_back(effects_.knobs[k].value(proof_.scenario().dds));
    }
    std::size_t count = 0;
    for (std::size_t e = 0; e < open_.size(); ++e) {
      if (!open_[e]) continue;
      const Expr& mark = effects_.system.variables[e];
      for (const SystemStep& step : effects_.system.steps) {
        if (z3::eq(step.next[e], mark)) continue;
        if (z3::eq(with(step.next[e], from, to).simplify(), mark)) ++count;
      }
    }
    return count;
  }

  /// Whether effects that are open never happen with these knobs fixed.
  void try_fixed(const Flags& fixed, const std::string& by) {
    const TransitionSystem system = under(effects_, proof_.scenario().dds, fixed);
    Flags never = never_changing(system);
    add_unsatisfiable(system, never);
    RuledOut group{by, {}};
    Flags marks(system.variables.size(), false);
    for (std::size_t e = 0; e < open_.size(); ++e) {
      if (!open_[e] || !never[e]) continue;
      open_[e] = false;
      marks[e] = true;
      group.effects.push_back(e);
    }
    if (group.effects.empty()) return;
    certify(system, reasons(system, never, marks), by);
    groups_.push_back(std::move(group));
  }
  /// Simplifying does not tell all: the effects that are open and have no step either.
  void add_unsatisfiable(const TransitionSystem& system, Flags& never) const {
    Exprs kept;
    for (std::size_t v = 0; v < never.size(); ++v) {
      if (never[v]) kept.push_back(system.initial.arg(static_cast<unsigned>(v)));
    }
    for (std::size_t e = 0; e < open_.size(); ++e) {
      if (!open_[e] || never[e]) continue;
      const Expr unmarked = !system.variables[e];
      Exprs happens;
      for (const SystemStep& step : system.steps) {
        if (!z3::eq(step.next[e], system.variables[e]))
          happens.push_back(step.guard && step.next[e]);
      }
      const smt::Options& options = proof_.request().claims.options();
      z3::solver solver{proof_.context(), z3::solver::simple()};
      solver.set(smt::solver_parameters(proof_.context(), options));
      solver.add(all_of(kept) && unmarked && any_of(happens));
      const smt::Deadline deadline{proof_.context(), options.timeout, options.interrupted};
      never[e] = solver.check() == z3::unsat;
    }
  }
  /// All knobs that matter, then as few of them as possible.
  void try_together() {
    Flags fixed(effects_.knobs.size(), true);
    std::vector<Key> needed = keys_;
    const auto rules_out = [&](const Flags& knobs) {
      const TransitionSystem system = under(effects_, proof_.scenario().dds, knobs);
      Flags never = never_changing(system);
      add_unsatisfiable(system, never);
      for (std::size_t e = 0; e < open_.size(); ++e) {
        if (open_[e] && !never[e]) return false;
      }
      return true;
    };
    if (!rules_out(fixed)) return;
    for (const Key& key : keys_) {
      Flags fewer = fixed;
      for (std::size_t k = 0; k < fewer.size(); ++k) fewer[k] = fewer[k] && !key.decides[k];
      if (!rules_out(fewer)) continue;
      fixed = fewer;
      std::erase_if(needed, [&](const Key& other) { return other.text == key.text; });
    }
    std::string by;
    for (const Key& key : needed) by += (by.empty() ? "" : ", ") + key.text;
    try_fixed(fixed, by.empty() ? "the knobs together" : by);
  }

  /// No step changes any of `kept`, if none has been changed.
  void certify(const TransitionSystem& system, const Flags& kept, const std::string& by) {
    Exprs here;
    for (std::size_t v = 0; v < kept.size(); ++v) {
      if (kept[v]) here.push_back(system.initial.arg(static_cast<unsigned>(v)));
    }
    const Expr invariant = all_of(here);
    Exprs lost;
    for (const SystemStep& step : system.steps) {
      const Expr after = with(invariant, system.variables, step.next);
      if (!z3::eq(after, invariant)) lost.push_back(step.guard && !after);
    }
    const std::string words = by.empty() ? "whatever the knobs" : "with " + by;
    if (proof_.possible(words + ": something changes that never does", {invariant, any_of(lost)})) {
      proof_.give_up("what never changes " + words + " does not pass its check");
    }
  }

  Proof& proof_;
  const EffectSystem& effects_;
  Flags open_;
  std::vector<Key> keys_;
  std::vector<RuledOut> groups_;
};

}  // namespace

std::vector<RuledOut> why_ruled_out(Proof& proof, const EffectSystem& effects,
                                    std::vector<bool> impossible) {
  return Explanation{proof, effects, std::move(impossible)}.run();
}

}  // namespace stormproof::tables
