// What a specialised program needs: what it changes, what somebody notices, and where it is.
#include <algorithm>
#include <set>
#include <stdexcept>
#include <vector>

#include "checker/engines/explorer/specialise.hpp"

namespace stormproof::explorer {

using fsm::program::no_term;
using fsm::program::no_thing;
using fsm::program::Tag;
using Act = Specialised::Act;
using Op = fsm::program::Op;
using Step = Specialised::Step;
using Steps = Specialised::Steps;

namespace {

/// Visits all steps, also those within others.
template <class Visit>
void each_step(Steps& steps, Visit&& visit) {
  for (Step& step : steps) {
    visit(step);
    each_step(step.body, visit);
  }
}
template <class Visit>
void each_rule(Specialised& specialised, Visit&& visit) {
  for (Steps& rule : specialised.rules) visit(rule);
  for (auto& [name, rule] : specialised.occasions) visit(rule);
  for (Steps& acknack : specialised.acknacks) visit(acknack);
}

/// Finds what is asked for.
class Uses {
 public:
  explicit Uses(Specialised& specialised)
      : specialised_{specialised},
        used_(specialised.registers, false),
        seen_(specialised.terms.size(), false) {
    each_rule(specialised, [&](Steps& rule) { each_step(rule, [&](Step& step) { use(step); }); });
  }
  [[nodiscard]] bool operator[](Specialised::Register reg) const { return used_[reg]; }

 private:
  void use(const Step& step) {
    use(step.value);
    use(step.asked);
    for (const Specialised::Row& row : step.rows) {
      use(row.guard);
      for (const auto& [field, value] : row.out) use(value);
    }
    for (const Specialised::Says& each : step.says) use(each.value);
    for (const Specialised::Ref argument : step.with) use(argument);
  }
  void use(Specialised::Ref ref) {
    if (ref == no_term || seen_[ref]) return;
    seen_[ref] = true;
    const Specialised::Term& term = specialised_.terms[ref];
    if (term.op == Op::let) used_[term.reg] = true;
    for (const Specialised::Ref part : {term.a, term.b, term.c}) use(part);
  }

  const Specialised& specialised_;
  std::vector<bool> used_;
  std::vector<bool> seen_;
};

/// Whether something has gone.
bool drop_unused(Steps& steps, const Uses& uses) {
  bool has_gone = false;
  for (Step& step : steps) {
    has_gone |= drop_unused(step.body, uses);
    const auto is_unused = [&](Specialised::Register field) { return !uses[field]; };
    std::erase_if(step.outbox, is_unused);
    for (Specialised::Row& row : step.rows) {
      has_gone |=
          std::erase_if(row.out, [&](const auto& each) { return is_unused(each.first); }) > 0;
    }
  }
  has_gone |= std::erase_if(steps, [&](const Step& step) {
                if (step.act == Act::let) return !uses[step.reg];
                return step.act > Act::decide && step.act <= Act::for_queue && step.body.empty();
              }) > 0;
  return has_gone;
}

}  // namespace

std::vector<Tag> changed_things(Specialised& specialised) {
  std::set<Tag> changed;
  each_rule(specialised, [&](Steps& rule) {
    each_step(rule, [&](const Step& step) { changed.insert(step.tag); });
  });
  changed.erase(no_thing);
  return {changed.begin(), changed.end()};
}

void drop_unused(Specialised& specialised) {
  for (bool has_gone = true; has_gone;) {
    has_gone = false;
    const Uses uses{specialised};
    each_rule(specialised, [&](Steps& rule) { has_gone |= drop_unused(rule, uses); });
  }
}

void place(Specialised& specialised, const Layout& layout) {
  for (Specialised::Term& term : specialised.terms) {
    if (term.tag == no_thing) continue;
    term.kept = layout.of(term.tag);
    if (term.kept.is_kept()) continue;
    // It is as it was at first.
    const bool holds = term.op == Op::in_state && term.value == 0;
    term = {.op = Op::integer, .value = holds ? 1 : 0};
  }
  const auto find = [&](const auto& self, Steps& steps) -> void {
    for (Step& step : steps) {
      if (step.tag != no_thing) step.kept = layout.of(step.tag);
      step.each = layout.place_of(step.owner, 1) == 1;
      self(self, step.body);
    }
    std::erase_if(steps, [](const Step& step) {
      return step.tag != no_thing && !step.kept.is_kept() && step.act != Act::schedule;
    });
  };
  each_rule(specialised, [&](Steps& rule) { find(find, rule); });
}

}  // namespace stormproof::explorer
