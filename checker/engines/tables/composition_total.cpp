// composition.total: what there is in the composition of the scenario's implementation is used and
// caused by its rules, or a reason is given (fsm/composition/completeness.cpp decides that). A
// mutant that forgets an event has rules that do not schedule it.
#include "checker/engines/tables/proof.hpp"
#include "checker/engines/tables/properties.hpp"
#include "fsm/composition/amended.hpp"
#include "model/composition_of.hpp"
#include "model/engine/timer_kinds.hpp"
#include "model/implementations.hpp"

namespace stormproof::tables {
namespace {

namespace composition = fsm::composition;
using composition::CompositionInfo;

/// The timers of a composition that are events of this kind.
template <class Composition>
std::vector<std::string_view> timers_of(model::EventKind kind) {
  std::vector<std::string_view> names;
  composition::for_each_type(typename Composition::Timers{}, [&]<class T>() {
    if (model::event_kind_of<T> == kind) names.push_back(fsm::name_of<T>());
  });
  return names;
}

void forget(std::vector<composition::RuleInfo>& rules, std::string_view timer) {
  for (composition::RuleInfo& rule : rules) {
    std::erase_if(rule.effects, [&](const composition::EffectInfo& effect) {
      return effect.target == timer && (effect.kind == "after" || effect.kind == "at");
    });
  }
}

/// The composition of the scenario's implementation, with the mutant's mistakes.
CompositionInfo composition_of(const Proof& proof) {
  CompositionInfo info = model::composition_of(proof.scenario());
  for (const composition::EffectMutation& mistake : proof.mistakes().effects) {
    if (mistake.change != composition::EffectMutation::Change::drop) continue;
    for (auto* rules : {&info.rules, &info.procedures}) {
      for (composition::RuleInfo& rule : *rules) {
        std::erase_if(rule.effects, [&](const composition::EffectInfo& effect) {
          return effect.key == mistake.key;
        });
      }
    }
  }
  for (const model::EventMutation& mistake : proof.mistakes().events) {
    if (mistake.change != model::EventMutation::Change::forget) continue;
    const auto timers = model::visit_composition(proof.scenario().dds,
                                                 [&]<class Composition>(model::Of<Composition>) {
                                                   return timers_of<Composition>(mistake.kind);
                                                 });
    for (const std::string_view timer : timers) {
      for (auto* rules : {&info.rules, &info.procedures, &info.steps}) forget(*rules, timer);
    }
  }
  return info;
}

}  // namespace

Finding composition_total(const CheckRequest& request) {
  Proof proof{"composition.total", request};
  const CompositionInfo info = composition_of(proof);
  for (const composition::Forgotten& one : what_is_forgotten(info)) {
    const std::string where = one.where.empty() ? "" : " (" + one.where + ")";
    proof.violate(one.what + where + "; expected: " + one.expected);
  }
  std::size_t fields = 0;
  std::size_t events = 0;
  for (const composition::PartInfo& part : info.parts) {
    fields += part.outbox.size();
    events += part.events.size();
  }
  for (const composition::UnusedInfo& unused : info.unused) {
    proof.detail("unused: " + std::string{unused.part} + "." + std::string{unused.name} + ", " +
                 std::string{unused.reason});
  }
  for (const composition::FromOutsideInfo& cause : info.from_outside) {
    proof.detail("from outside: " + std::string{cause.name} + ", " + std::string{cause.reason});
  }
  const auto count = [](std::size_t number, const char* things) {
    return std::to_string(number) + " " + things;
  };
  return proof.finish(
      "every thing in the composition '" + std::string{info.name} +
      "': " + count(fields, "outbox fields, ") + count(events, "events, ") +
      count(info.timers.size(), "timers, ") + count(info.packets.size(), "packets, ") +
      count(info.occasions.size(), "occasions, ") + count(info.state.size(), "flags and numbers"));
}

}  // namespace stormproof::tables
