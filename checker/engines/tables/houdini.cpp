// Each model of "the candidates hold, a step is taken, and one of them does not hold any more"
// removes all candidates that do not hold after it, until there is none.
#include "checker/engines/tables/houdini.hpp"

#include <map>

#include "checker/engines/smt/deadline.hpp"
#include "checker/engines/tables/machine_step.hpp"

namespace stormproof::tables {
namespace {

class Search {
 public:
  Search(Proof& proof, const TransitionSystem& system, const Exprs& candidates)
      : proof_{proof},
        system_{system},
        candidates_{candidates},
        after_(system.steps.size()),
        result_{std::vector<bool>(candidates.size(), true),
                std::vector<std::string>(candidates.size()),
                std::vector<std::string>(candidates.size())} {}

  std::optional<Kept> run() {
    remove("initially", {system_.initial}, candidates_);
    // One round after the other, until every step has kept all that is left since the last loss.
    const std::size_t steps = system_.steps.size();
    for (std::size_t k = 0, kept_by = 0; kept_by < steps && !stopped_; ++k) {
      kept_by = keep(k % steps) ? kept_by + 1 : 1;
    }
    if (stopped_) return std::nullopt;
    return std::move(result_);
  }

 private:
  /// Whether the step breaks none that is kept.
  bool keep(std::size_t which) {
    const SystemStep& step = system_.steps[which];
    Exprs& after = after_[which];
    for (std::size_t k = after.size(); k < candidates_.size(); ++k) {
      after.push_back(with(candidates_[k], system_.variables, step.next));
    }
    bool all = true;
    while (!stopped_ && remove(step.name, {holding(candidates_), step.guard}, after)) all = false;
    return all;
  }
  [[nodiscard]] Expr holding(const Exprs& these) const {
    Exprs parts;
    for (std::size_t k = 0; k < these.size(); ++k) {
      if (result_.kept[k]) parts.push_back(these[k]);
    }
    return all_of(parts);
  }
  /// Removes what does not hold `after` in one case in which the conditions do; false: there is no
  /// such case.
  bool remove(const std::string& where, Exprs conditions, const Exprs& after) {
    z3::context& context = smt::SymbolicContext::current();
    z3::solver solver{context, z3::solver::simple()};
    const smt::Options& options = proof_.request().claims.options();
    solver.set(smt::solver_parameters(context, options));
    conditions.push_back(!holding(after));
    for (const Expr& condition : conditions) solver.add(condition);
    const smt::Deadline deadline{context, options.timeout, options.interrupted};

    const z3::check_result result = solver.check();

    if (result == z3::unsat) return false;
    if (result == z3::unknown) {
      stop(where + ": no answer in the search for an invariant");
      return false;
    }
    const z3::model model = solver.get_model();
    const std::string state = notable_in(model, system_.variables);
    bool removes = false;
    for (std::size_t k = 0; k < after.size(); ++k) {
      if (!result_.kept[k] || is_true_in(model, after[k])) continue;
      result_.kept[k] = false;
      result_.lost_at[k] = where;
      result_.lost_in[k] = state;
      removes = true;
    }
    if (!removes) stop(where + ": a model in the search for an invariant breaks none of them");
    return removes;
  }

  void stop(const std::string& why) {
    stopped_ = true;
    proof_.give_up(why);
  }

  Proof& proof_;
  const TransitionSystem& system_;
  const Exprs& candidates_;
  std::vector<Exprs> after_;  ///< by step, the candidates after it; empty until it is asked
  Kept result_;
  bool stopped_ = false;
};

}  // namespace

Exprs facts_of(const TransitionSystem& system) {
  Exprs facts;
  std::map<std::string, OneHot> machines;
  for (const Expr& variable : system.variables) {
    const std::string name = variable.decl().name().str();
    const std::size_t end = name.find('=');
    if (!variable.is_bool()) facts.push_back(variable >= 0);
    if (end != std::string::npos) machines[name.substr(0, end)].push_back(variable);
  }
  for (const auto& [name, states] : machines) facts.push_back(exactly_one(states));
  return facts;
}

std::optional<Kept> houdini(Proof& proof, const TransitionSystem& system, const Exprs& candidates) {
  return Search{proof, system, candidates}.run();
}

std::optional<std::vector<bool>> inductive_together(Proof& proof, const TransitionSystem& system,
                                                    const Exprs& candidates) {
  const std::optional<Kept> found = houdini(proof, system, candidates);
  if (!found) return std::nullopt;
  const std::vector<bool>& kept = found->kept;
  Exprs parts;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (kept[k]) parts.push_back(candidates[k]);
  }
  const Expr invariant = all_of(parts);
  TransitionSystem safe = system;
  safe.bad = !invariant;
  if (!certify(proof, safe, invariant)) {
    proof.give_up("an invariant that was found does not pass its check");
  }
  return kept;
}

}  // namespace stormproof::tables
