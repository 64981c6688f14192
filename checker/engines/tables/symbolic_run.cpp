// Variables that come into being when they are read.
#include "checker/engines/tables/symbolic_run.hpp"

#include "checker/engines/tables/machine_step.hpp"
#include "fsm/composition/vocabulary.hpp"

namespace stormproof::tables {
namespace {

Exprs values_of(const std::map<std::string, Expr>& unknowns) {
  Exprs list;
  for (const auto& [name, unknown] : unknowns) list.push_back(unknown);
  return list;
}

}  // namespace

Place Place::of(std::uint8_t indices) const {
  namespace index = fsm::composition::owner;
  Place place;
  if ((indices & index::participant_index) != 0) place.participant = participant;
  if ((indices & index::stream_index) != 0) place.stream = stream;
  if ((indices & index::peer_index) != 0) place.peer = peer;
  if ((indices & index::descriptor_index) != 0) place.descriptor = descriptor;
  return place;
}

std::string Place::text() const {
  const Place ours;
  std::string text;
  const auto add = [&](const char* index, int value, int own) {
    if (value != own)
      text += (text.empty() ? "" : ", ") + std::string{index} + std::to_string(value);
  };
  add("participant ", participant, ours.participant);
  add("stream ", stream, ours.stream);
  add("reader ", peer, ours.peer);
  add("descriptor ", descriptor, ours.descriptor);
  return text.empty() ? text : " (" + text + ")";
}

Expr& SymbolicRun::truth(const std::string& name) {
  const Expr unknown = smt::SymbolicBool::named(name).expr();
  return variables_.try_emplace(name, Variable{unknown, unknown}).first->second.now;
}

Expr& SymbolicRun::number(const std::string& name) {
  const Expr unknown = smt::SymbolicInt::named(name).expr();
  return variables_.try_emplace(name, Variable{unknown, unknown}).first->second.now;
}

void SymbolicRun::machine(const std::vector<std::string>& states) {
  if (machines_.contains(states.front())) return;
  Exprs& at_first = machines_[states.front()];
  for (const std::string& state : states) {
    (void)truth(state);
    at_first.push_back(variables_.at(state).at_first);
  }
}

Expr SymbolicRun::knob(const Expr& unknown) {
  return knobs_.try_emplace(unknown.decl().name().str(), unknown).first->second;
}
Expr SymbolicRun::input(const Expr& unknown) {
  return inputs_.try_emplace(unknown.decl().name().str(), unknown).first->second;
}

Exprs SymbolicRun::knobs() const { return values_of(knobs_); }
Exprs SymbolicRun::inputs() const { return values_of(inputs_); }

Expr SymbolicRun::possible() const {
  Exprs conditions;
  for (const auto& [name, states] : machines_) conditions.push_back(exactly_one(states));
  for (const auto& [name, variable] : variables_) {
    if (variable.at_first.is_int()) conditions.push_back(variable.at_first >= 0);
  }
  return all_of(conditions);
}

}  // namespace stormproof::tables
