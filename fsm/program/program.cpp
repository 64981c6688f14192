// Words of a program, what a mistake makes of its machines, and what it must not be.
#include "fsm/program/program.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

#include "fsm/program/value.hpp"
#include "fsm/row_mutation.hpp"

namespace stormproof::fsm::program {
namespace {

constexpr std::array<std::string_view, 22> words_of_steps{
    "let", "when",   "for",  "for",       "for",   "for",    "for",      "for",
    "for", "for",    "feed", "feed each", "renew", "set",    "set each", "after",
    "at",  "cancel", "emit", "raise",     "call",  "perform"};
constexpr std::array<std::string_view, 4> words_of_triggers{"received", "left", "due", "happens"};

/// Follows what runs within what.
class Nesting {
 public:
  explicit Nesting(const Program& program)
      : program_{program},
        rules_(program.rules.size(), Visit::none),
        procedures_(program.procedures.size(), Visit::none) {}

  void check() {
    for (std::size_t k = 0; k < rules_.size(); ++k) {
      enter(rules_[k], program_.rules[k].name, program_.rules[k].body);
    }
  }

 private:
  enum class Visit : std::uint8_t { none, inside, done };

  void enter(Visit& visit, std::string_view name, const Steps& body) {
    if (visit == Visit::inside) throw std::logic_error{std::string{name} + " runs within itself"};
    if (visit == Visit::done) return;
    visit = Visit::inside;
    follow(body);
    visit = Visit::done;
  }
  void follow(const Steps& steps) {
    for (const Step& step : steps) {
      if (step.what == Do::call || step.what == Do::perform) {
        const Procedure& procedure = program_.procedures[step.procedure];
        enter(procedures_[step.procedure], procedure.name, procedure.body);
      } else if (step.what == Do::raise) {
        const Rule* const rule = program_.rule_for(Trigger::happens, step.target);
        if (rule != nullptr) {
          enter(rules_[static_cast<std::size_t>(rule - program_.rules.data())], rule->name,
                rule->body);
        }
      }
      follow(step.body);
    }
  }

  const Program& program_;
  std::vector<Visit> rules_;
  std::vector<Visit> procedures_;
};

}  // namespace

thread_local Program* Recording::current_ = nullptr;

Ref Value::add(const Term& term) {
  std::vector<Term>& terms = Recording::current_->terms;
  terms.push_back(term);
  return static_cast<Ref>(terms.size() - 1);
}
Ref Value::constant(Op op, std::int64_t value) {
  const std::vector<Term>& terms = Recording::current_->terms;
  const auto known = std::ranges::find_if(
      terms, [&](const Term& term) { return term.op == op && term.value == value; });
  if (known != terms.end()) return static_cast<Ref>(known - terms.begin());
  return add({.op = op, .value = value});
}

Tag Program::find(std::string_view name_) const {
  const auto found = std::ranges::find(things, name_, &Thing::name);
  return found == things.end() ? no_thing : static_cast<Tag>(found - things.begin());
}
const Rule* Program::rule_for(Trigger trigger, Tag cause) const {
  const auto found = std::ranges::find_if(
      rules, [&](const Rule& rule) { return rule.trigger == trigger && rule.cause == cause; });
  return found == rules.end() ? nullptr : &*found;
}
bool Program::comes_from_outside(Tag thing) const {
  return std::ranges::find(from_outside, things[thing].name, &Reason::name) != from_outside.end();
}

std::string_view word_of(Do what) { return words_of_steps[static_cast<std::size_t>(what)]; }
std::string_view word_of(Trigger trigger) {
  return words_of_triggers[static_cast<std::size_t>(trigger)];
}

std::string effect_id(std::string_view scope, const Step& effect) {
  return std::string{scope} + "." + std::to_string(effect.number);
}

std::vector<Machine::Row> rows_of(const Machine& machine,
                                  const std::vector<TableMutation>& mistakes) {
  std::vector<Machine::Row> rows = machine.rows;
  mutate(rows, machine.name, mistakes);
  return rows;
}

void check(const Program& program) {
  std::map<std::string_view, std::string_view> names;
  for (const Thing& thing : program.things) {
    const auto [known, fresh] = names.emplace(thing.name, thing.full_name);
    if (fresh) continue;
    throw std::logic_error{std::string{known->second} + " and " + std::string{thing.full_name} +
                           " have one name in " + std::string{program.name}};
  }
  Nesting{program}.check();
}

}  // namespace stormproof::fsm::program
