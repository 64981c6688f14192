// Rows as options of an `if`.
#include "checker/engines/promela/table_macros.hpp"

#include <algorithm>

#include <fmt/core.h>

namespace stormproof::promela {

using fsm::program::no_term;
using fsm::program::Op;
using fsm::program::Term;

std::string TableMacros::state(fsm::StateId number) const {
  return fmt::format("{}_{}", machine_->name, machine_->states[number]);
}
std::string TableMacros::outbox(std::size_t field) const {
  return fmt::format("{}_{}", machine_->name, machine_->outputs[field].name);
}
std::string TableMacros::name(std::uint8_t event) const {
  return fmt::format("{}_{}", machine_->name, machine_->events[event]);
}

std::vector<TableMacros::Ref> TableMacros::tests(std::uint8_t event) const {
  std::vector<Ref> tests = leaves(event);
  for (Ref& leaf : tests) leaf = (*terms_)[leaf].a;
  return tests;
}
bool TableMacros::asks(std::uint8_t event, std::size_t field) const {
  return std::ranges::any_of(
      rows_, [&](const Row& row) { return row.event == event && asks(row, field); });
}
bool TableMacros::asks(const Row& row, std::size_t field) const {
  return machine_->outputs[field].sort == fsm::program::Sort::truth && row.out[field] != no_term;
}

std::string TableMacros::states() const {
  std::string text;
  for (std::size_t k = 0; k < machine_->states.size(); ++k) {
    text += fmt::format("#define {} {}\n", state(static_cast<fsm::StateId>(k)), k);
  }
  return text;
}
std::string TableMacros::macro(std::uint8_t event) const {
  std::string text = fmt::format("inline {}(state, d", name(event));
  for (const Ref leaf : leaves(event)) text += fmt::format(", {}", (*terms_)[leaf].words);
  text += ") {\n  if\n";
  for (auto row = rows_.begin(); row != rows_.end(); ++row) {
    if (row->event == event) text += option(*row, {row + 1, rows_.end()});
  }
  return text + "  :: else\n  fi\n}\n";
}

std::vector<TableMacros::Ref> TableMacros::leaves(std::uint8_t event) const {
  std::vector<Ref> leaves;
  for (const Row& row : machine_->rows) {  // as written: mistakes do not change the arguments
    if (row.event == event) add_leaves(leaves, row.guard);
  }
  return leaves;
}
void TableMacros::add_leaves(std::vector<Ref>& leaves, Ref guard) const {
  if (guard == no_term) return;
  const Term& term = (*terms_)[guard];
  if (term.op != Op::named) {
    add_leaves(leaves, term.a);
    add_leaves(leaves, term.b);
    return;
  }
  const auto same = [&](Ref known) { return (*terms_)[known].words == term.words; };
  if (std::ranges::none_of(leaves, same)) leaves.push_back(guard);
}

Truth TableMacros::formula(Ref guard, const Leaf& leaf) const {
  const Term& term = (*terms_)[guard];
  if (term.op == Op::named) return leaf(term.words);
  if (term.op == Op::negation) return !formula(term.a, leaf);
  return formula(term.a, leaf) && formula(term.b, leaf);
}
Truth TableMacros::guard(const Row& row, const Leaf& leaf) const {
  const Truth holds = row.guard == no_term ? Truth{true} : formula(row.guard, leaf);
  return row.negated ? !holds : holds;
}
/// Whether both guards can hold at once, as far as their formulas tell.
bool TableMacros::overlap(const Row& a, const Row& b) const {
  const std::vector<Ref> all = leaves(a.event);
  for (unsigned bits = 0; bits < 1U << all.size(); ++bits) {
    const auto leaf = [&](std::string_view words) -> Truth {
      const auto place = std::ranges::find(all, words, [&](Ref k) { return (*terms_)[k].words; });
      return (bits >> (place - all.begin()) & 1U) != 0;
    };
    if ((guard(a, leaf) && guard(b, leaf)).is(true)) return true;
  }
  return false;
}
/// Of two rows that are enabled the later one wins.
std::string TableMacros::option(const Row& row, std::span<const Row> later_rows) const {
  const auto leaf = [](std::string_view words) { return Truth{Expression{std::string{words}}}; };
  Truth fires = guard(row, leaf);
  for (const Row& later : later_rows) {
    if (later.source == row.source && later.event == row.event && overlap(row, later)) {
      fires = fires && !guard(later, leaf);
    }
  }
  if (fires.is(false)) return "";
  std::string text = fmt::format("  :: state == {}", state(row.source));
  if (!fires.is(true)) text += " && " + fires.expression().text;
  text += fmt::format(" -> state = {}", state(row.target));
  for (std::size_t k = 0; k < fields(); ++k) {
    if (asks(row, k)) text += fmt::format("; {0} = {0} | (1 << d)", outbox(k));
  }
  return text + "\n";
}

}  // namespace stormproof::promela
