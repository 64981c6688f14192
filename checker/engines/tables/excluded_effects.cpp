// Evaluates the conditions of all rules and procedures with three truth values: what follows from
// knobs, and unknown.
#include "checker/engines/tables/excluded_effects.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "fsm/program/program.hpp"
#include "model/composition_of.hpp"
#include "model/config/knobs/other_choices.hpp"
#include "model/engine/program_things.hpp"
#include "model/implementations.hpp"

namespace stormproof::tables {
namespace {

using fsm::program::Op;
using fsm::program::Program;
using fsm::program::Ref;
using fsm::program::Step;
using fsm::program::Steps;
using fsm::program::Term;
using Truth = std::optional<bool>;

class Excluded {
 public:
  /// `one_server`: no client of a server is a server itself.
  Excluded(const Program& program, const model::DdsProfile& dds, bool one_server = false)
      : program_{program}, dds_{dds}, one_server_{one_server} {
    for (const auto& rule : program.rules) walk(rule.name, rule.body, false);
    for (const auto& procedure : program.procedures) {
      if (!procedure.is_contract) walk(procedure.name, procedure.body, false);
    }
  }

  [[nodiscard]] const std::vector<std::string>& ids() const { return ids_; }
  [[nodiscard]] bool has(const std::string& id) const {
    return std::ranges::find(ids_, id) != ids_.end();
  }

 private:
  void walk(std::string_view scope, const Steps& steps, bool is_excluded) {
    for (const Step& step : steps) {
      const bool is_false = step.what == fsm::program::Do::when && truth(step.value) == false;
      if (step.number > 0 && is_excluded) ids_.push_back(effect_id(scope, step));
      walk(scope, step.body, is_excluded || is_false);
    }
  }

  [[nodiscard]] Truth truth(Ref ref) const {
    if (ref == fsm::program::no_term) return std::nullopt;
    const Term& term = program_.terms[ref];
    switch (term.op) {
      case Op::truth:
        return term.value != 0;
      case Op::let:
        return truth(term.a);
      case Op::read:
        return of_thing(program_.things[term.tag]);
      case Op::negation: {
        const Truth a = truth(term.a);
        return a ? Truth{!*a} : a;
      }
      case Op::both:
        return joined(term, false);
      case Op::either:
        return joined(term, true);
      default:
        return std::nullopt;
    }
  }
  /// `decisive`: the value of one side that is that of both together.
  [[nodiscard]] Truth joined(const Term& term, bool decisive) const {
    const Truth a = truth(term.a);
    const Truth b = truth(term.b);
    if (a == decisive || b == decisive) return decisive;
    return a && b ? Truth{!decisive} : std::nullopt;
  }
  /// A fact by its definition.
  [[nodiscard]] Truth of_thing(const fsm::program::Thing& thing) const {
    if (one_server_ && thing.name == "FromServer") return false;
    if (thing.kind == fsm::program::Thing::Kind::fact) return truth(thing.definition);
    if (thing.kind != fsm::program::Thing::Kind::toggle) return std::nullopt;
    const auto value = model::knob_value(thing, dds_);
    return value ? Truth{*value != 0} : std::nullopt;
  }

  const Program& program_;
  const model::DdsProfile& dds_;
  const bool one_server_;
  std::vector<std::string> ids_;
};

}  // namespace

std::vector<ImpossibleEffects> excluded_effects(const model::DdsProfile& dds) {
  const Program& program = model::program_of(dds);
  std::vector<std::string> left = Excluded{program, dds}.ids();
  std::vector<ImpossibleEffects> all;
  for (const model::config::OtherChoices& knob : model::config::other_choices(dds)) {
    if (left.empty()) break;
    ImpossibleEffects group{knob.key + ": " + knob.value, {}};
    for (const model::DdsProfile& other : knob.others) {
      if (model::kind_of(other) != model::kind_of(dds)) continue;
      const Excluded there{program, other};
      std::erase_if(left, [&](const std::string& id) {
        if (there.has(id)) return false;
        group.effects.push_back(id);
        return true;
      });
    }
    if (!group.effects.empty()) all.push_back(std::move(group));
  }
  if (!left.empty()) all.push_back({"the knobs together", std::move(left)});
  return all;
}

ImpossibleEffects effects_between_servers(const model::DdsProfile& dds) {
  const Program& program = model::program_of(dds);
  const Excluded always{program, dds};
  ImpossibleEffects group{"deployment.servers: one", Excluded{program, dds, true}.ids()};
  std::erase_if(group.effects, [&](const std::string& id) { return always.has(id); });
  return group;
}

}  // namespace stormproof::tables
