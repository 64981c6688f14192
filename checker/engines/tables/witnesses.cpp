// The search for something new, one step at a time; two or three where one leads nowhere.
#include "checker/engines/tables/witnesses.hpp"

#include <algorithm>

#include "checker/engines/smt/deadline.hpp"
#include "checker/engines/tables/unrolling.hpp"

namespace stormproof::tables {
namespace {

constexpr std::size_t longest_look = 3;

z3::context& context_of_search() { return smt::SymbolicContext::current(); }

/// Something that a step can do for the first time: give `variable` the value `to`.
struct Novelty {
  std::size_t step = 0;
  std::size_t variable = 0;
  bool to = false;
  Expr literal;
};

class NoveltySearch {
 public:
  NoveltySearch(const TransitionSystem& system, const std::vector<bool>& is_mark,
                const smt::Options& options)
      : system_{system},
        is_mark_{is_mark},
        options_{options},
        solver_{context_of_search(), z3::solver::simple()} {
    solver_.set(smt::solver_parameters(context_of_search(), options));
    Exprs start;
    for (std::size_t v = 0; v < system.variables.size(); ++v) {
      start.push_back(start_of(v));
      seen_[0].push_back(start.back().is_false());
      seen_[1].push_back(start.back().is_true());
    }
    add_novelties();
    add_state(start);
  }

  Witnesses run() {
    smt::Deadline deadline{context_of_search(), options_.timeout, options_.interrupted};
    while (marks_are_open()) {
      const z3::check_result answer = advance();
      if (answer == z3::unsat) break;
      if (answer == z3::unknown) {
        result_.gap = deadline.expired() ? deadline.why() : "no answer";
        break;
      }
    }
    for (std::size_t v = 0; v < is_mark_.size(); ++v) {
      result_.found.push_back(is_mark_[v] && seen_[1][v]);
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] Expr start_of(std::size_t variable) const {
    return system_.initial.arg(static_cast<unsigned>(variable)).arg(1);
  }
  [[nodiscard]] bool marks_are_open() const {
    for (std::size_t v = 0; v < is_mark_.size(); ++v) {
      if (is_mark_[v] && !seen_[1][v]) return true;
    }
    return false;
  }

  void add_novelties() {
    for (std::size_t s = 0; s < system_.steps.size(); ++s) {
      const SystemStep& step = system_.steps[s];
      for (std::size_t v = 0; v < step.next.size(); ++v) {
        if (!step.next[v].is_bool() || z3::eq(step.next[v], system_.variables[v])) continue;
        const Expr next =
            is_mark_[v] ? with(step.next[v], {system_.variables[v]}, {start_of(v)}) : step.next[v];
        for (const bool to : {false, true}) {
          if (seen_[to ? 1 : 0][v]) continue;
          const Expr happens = (to ? next : !next).simplify();
          if (happens.is_false()) continue;
          const std::string name = "new " + std::to_string(novelties_.size());
          novelties_.push_back({s, v, to, context_of_search().bool_const(name.c_str())});
          solver_.add(z3::implies(novelties_.back().literal, step.guard && happens));
        }
      }
    }
  }
  /// The state has these values. Marks are read by nothing, so it does not tell of them.
  [[nodiscard]] Expr is_state(const Exprs& values) const {
    Exprs parts;
    for (std::size_t v = 0; v < values.size(); ++v) {
      if (!is_mark_[v]) parts.push_back(system_.variables[v] == values[v]);
    }
    return all_of(parts);
  }
  void add_state(const Exprs& values) {
    const std::string name = "state " + std::to_string(states_.size());
    literals_.push_back(context_of_search().bool_const(name.c_str()));
    solver_.add(z3::implies(literals_.back(), is_state(values)));
    states_.push_back(values);
  }

  /// Takes steps to something new, if there are any.
  z3::check_result advance() {
    z3::check_result answer = look();
    if (answer == z3::sat) return take_found(solver_.get_model());
    for (std::size_t length = 2; answer == z3::unsat && length <= longest_look; ++length) {
      answer = look_ahead(length);
    }
    return answer;
  }
  /// One step: from the state that was reached last, if there is one there, so that what has
  /// happened adds up; else from any.
  z3::check_result look() {
    Exprs open;
    for (const Novelty& novelty : novelties_) {
      if (!seen_[novelty.to ? 1 : 0][novelty.variable]) open.push_back(novelty.literal);
    }
    const std::string name = "look " + std::to_string(states_.size());
    const Expr look = context_of_search().bool_const(name.c_str());
    solver_.add(z3::implies(look, any_of(open) && any_of(literals_)));
    Expr assumed[] = {look, literals_.back()};
    const z3::check_result answer = solver_.check(2, assumed);
    return answer == z3::unsat ? solver_.check(1, assumed) : answer;
  }
  z3::check_result take_found(const z3::model& model) {
    std::size_t from = 0;
    while (from < states_.size() && !is_true_in(model, literals_[from])) ++from;
    const auto found = std::ranges::find_if(novelties_, [&](const Novelty& novelty) {
      return !seen_[novelty.to ? 1 : 0][novelty.variable] && is_true_in(model, novelty.literal);
    });
    if (from == states_.size() || found == novelties_.end()) return z3::unknown;
    TakenStep step{found->step, {}};
    for (const Expr& input : system_.steps[step.step].inputs) {
      step.inputs.push_back(model.eval(input, true));
    }
    return take(from, step) ? z3::sat : z3::unknown;
  }

  /// Several steps from any state that is reached.
  z3::check_result look_ahead(std::size_t length) {
    TransitionSystem ahead = system_;
    Exprs here;
    Exprs unmarked;
    Exprs open;
    for (const Exprs& state : states_) here.push_back(is_state(state));
    for (std::size_t v = 0; v < is_mark_.size(); ++v) {
      if (is_mark_[v]) unmarked.push_back(!system_.variables[v]);
      for (const bool to : {false, true}) {
        if (!system_.variables[v].is_bool() || seen_[to ? 1 : 0][v]) continue;
        open.push_back(to ? system_.variables[v] : !system_.variables[v]);
      }
    }
    ahead.initial = any_of(here) && all_of(unmarked);
    ahead.bad = any_of(open);
    Unrolling unrolling{ahead};
    for (std::size_t k = 0; k < length; ++k) unrolling.extend();
    z3::solver solver{context_of_search(), z3::solver::simple()};
    solver.set(smt::solver_parameters(context_of_search(), options_));
    for (const Expr& condition : unrolling.ends_badly()) solver.add(condition);
    const z3::check_result answer = solver.check();
    if (answer != z3::sat) return answer;
    const z3::model model = solver.get_model();
    const Exprs start = unrolling.start(model);
    std::size_t from = 0;
    while (from < states_.size() && !same(states_[from], start)) ++from;
    if (from == states_.size()) return z3::unknown;
    for (const TakenStep& step : unrolling.steps(model)) {
      if (!take(from, step)) return z3::unknown;
      from = states_.size() - 1;
    }
    return z3::sat;
  }
  [[nodiscard]] bool same(const Exprs& a, const Exprs& b) const {
    for (std::size_t v = 0; v < a.size(); ++v) {
      if (!is_mark_[v] && !z3::eq(a[v], b[v])) return false;
    }
    return true;
  }

  /// Takes a step by evaluating it. Whether it can be taken there.
  bool take(std::size_t from, const TakenStep& taken) {
    const SystemStep& step = system_.steps[taken.step];
    Exprs variables = system_.variables;
    variables.insert(variables.end(), step.inputs.begin(), step.inputs.end());
    Exprs values = states_[from];
    values.insert(values.end(), taken.inputs.begin(), taken.inputs.end());
    if (!with(step.guard, variables, values).simplify().is_true()) return false;
    WitnessStep line{from, step.name, inputs_in_words(step, taken), {}};
    Exprs after;
    for (std::size_t v = 0; v < step.next.size(); ++v) {
      const bool stays = z3::eq(step.next[v], system_.variables[v]);
      after.push_back(stays ? states_[from][v] : with(step.next[v], variables, values).simplify());
      for (const bool to : {false, true}) {
        if (seen_[to ? 1 : 0][v] || !(to ? after[v].is_true() : after[v].is_false())) continue;
        seen_[to ? 1 : 0][v] = true;
        if (is_mark_[v]) line.marks.push_back(v);
      }
    }
    result_.steps.push_back(std::move(line));
    add_state(after);
    return true;
  }
  static std::string inputs_in_words(const SystemStep& step, const TakenStep& taken) {
    std::string words;
    for (std::size_t k = 0; k < step.inputs.size(); ++k) {
      const std::string name = step.inputs[k].decl().name().str();
      if (name.front() == hidden_input || !taken.inputs[k].is_true()) continue;
      words += (words.empty() ? "" : ", ") + name;
    }
    return words;
  }

  const TransitionSystem& system_;
  const std::vector<bool>& is_mark_;
  const smt::Options& options_;
  z3::solver solver_;
  std::vector<Novelty> novelties_;
  std::vector<Exprs> states_;  ///< values by variable
  Exprs literals_;             ///< by state: it is this one
  std::vector<bool> seen_[2];  ///< by value and variable
  Witnesses result_;
};

}  // namespace

Witnesses find_witnesses(const TransitionSystem& system, const std::vector<bool>& is_mark,
                         const smt::Options& options) {
  return NoveltySearch{system, is_mark, options}.run();
}

}  // namespace stormproof::tables
