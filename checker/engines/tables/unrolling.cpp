// Copies of a system's steps, and what a model says of them.
#include "checker/engines/tables/unrolling.hpp"

namespace stormproof::tables {
namespace {

/// The inputs of a step that are set, by their own names.
std::string input_text(const z3::model& model, const SystemStep& step, const Exprs& copies) {
  std::string text;
  for (std::size_t k = 0; k < step.inputs.size(); ++k) {
    const std::string value = value_text(model, copies[k]);
    const bool hidden = step.inputs[k].decl().name().str().front() == hidden_input;
    if (hidden || value == "false" || value == "0") continue;
    text += text.empty() ? "" : ", ";
    text += step.inputs[k].decl().name().str() + (value == "true" ? "" : " = " + value);
  }
  return text;
}

}  // namespace

Unrolling::Unrolling(const TransitionSystem& system)
    : system_{system}, context_{smt::SymbolicContext::current()} {
  states_.push_back(copies(system.variables, "@0"));
  conditions_.push_back(with(system.initial, system.variables, states_[0]));
}

void Unrolling::extend() {
  const std::string suffix = "@" + std::to_string(states_.size());
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
      const bool stays = z3::eq(step.next[k], system_.variables[k]);
      effect.push_back(after[k] == (stays ? before[k] : with(step.next[k], from, to)));
    }
    conditions_.push_back(z3::implies(taken, all_of(effect)));
    taken_.back().push_back(taken);
    inputs_.back().push_back(inputs);
  }
  conditions_.push_back(any_of(taken_.back()));
}

Exprs Unrolling::ends_badly() const {
  Exprs conditions = conditions_;
  conditions.push_back(with(system_.bad, system_.variables, states_.back()));
  return conditions;
}

std::vector<TakenStep> Unrolling::steps(const z3::model& model) const {
  std::vector<TakenStep> result;
  for (std::size_t t = 0; t < taken_.size(); ++t) {
    TakenStep taken;
    while (!is_true_in(model, taken_[t][taken.step])) ++taken.step;
    for (const Expr& input : inputs_[t][taken.step])
      taken.inputs.push_back(model.eval(input, true));
    result.push_back(std::move(taken));
  }
  return result;
}

std::vector<std::string> Unrolling::lines(const z3::model& model) const {
  std::vector<std::string> result;
  const std::vector<TakenStep> taken = steps(model);
  for (std::size_t t = 0; t < taken.size(); ++t) {
    const SystemStep& step = system_.steps[taken[t].step];
    std::string line = "  " + std::to_string(t + 1) + ". " + step.name;
    const std::string inputs = input_text(model, step, inputs_[t][taken[t].step]);
    if (!inputs.empty()) line += " (" + inputs + ")";
    result.push_back(line + changes(model, t));
  }
  return result;
}

Exprs Unrolling::start(const z3::model& model) const {
  Exprs values;
  for (const Expr& variable : states_.front()) values.push_back(model.eval(variable, true));
  return values;
}

/// What step `t` changes. Of a machine that moves only the new state is shown.
std::string Unrolling::changes(const z3::model& model, std::size_t t) const {
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

Exprs Unrolling::copies(const Exprs& originals, const std::string& suffix) const {
  Exprs result;
  for (const Expr& original : originals) {
    const std::string name = original.decl().name().str() + suffix;
    result.push_back(context_.constant(name.c_str(), original.get_sort()));
  }
  return result;
}

}  // namespace stormproof::tables
