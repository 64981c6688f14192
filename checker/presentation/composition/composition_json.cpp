// A composition as JSON. Its keys: specs/guide/compositions.md.
#include <optional>

#include "checker/presentation/composition/composition_drawing.hpp"
#include "checker/presentation/composition/composition_words.hpp"
#include "checker/presentation/json/describe.hpp"

namespace stormproof::fsm::composition {

template <class V>
void describe(V& v, const PartInfo& part) {
  v("name", part.name);
  v("machine", part.machine);
  v("owner", part.owner);
  v("events", part.events);
  v("outbox", part.outbox);
}

template <class V>
void describe(V& v, const ThingInfo& thing) {
  v("name", thing.name);
  v("owner", thing.owner);
}

template <class V>
void describe(V& v, const EffectInfo& effect) {
  const bool waits = effect.kind == "after";
  v("id", effect.id);
  v("kind", effect.kind);
  v("target", effect.target);
  v.or_null("owner", effect.owner);
  v.or_null("condition", draw::condition_words(effect));
  v.or_null("delay", waits ? effect.detail : "");
  v.or_null("detail", waits ? "" : effect.detail);
}

/// Procedures and steps have no trigger.
template <class V>
void describe(V& v, const RuleInfo& rule) {
  v("id", rule.id);
  if (!rule.trigger.empty()) {
    v("trigger", rule.trigger);
    v("cause", rule.cause);
    v("owner", rule.owner);
  }
  v("effects", rule.effects);
}

}  // namespace stormproof::fsm::composition

namespace stormproof::draw {

nlohmann::ordered_json composition_json(const fsm::composition::CompositionInfo& composition) {
  report::JsonObject object;
  object("composition", composition.name);
  object("machines", composition.parts);
  object("packets", composition.packets);
  object("timers", composition.timers);
  object("state", composition.state);
  nlohmann::ordered_json facts = nlohmann::ordered_json::object();
  for (const auto& [name, definition] : composition.facts) facts[std::string{name}] = definition;
  object("facts", facts);
  object("rules", composition.rules);
  object("procedures", composition.procedures);
  object("steps", composition.steps);
  return std::move(object).take();
}

}  // namespace stormproof::draw
