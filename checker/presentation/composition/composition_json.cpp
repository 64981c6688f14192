// A composition as JSON. Its keys: specs/guide/compositions.md.
#include <optional>

#include "checker/presentation/composition/composition_drawing.hpp"
#include "checker/presentation/composition/composition_words.hpp"
#include "checker/presentation/json/schema.hpp"

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
  v.unless_empty("trigger", rule.trigger);
  v.unless_empty("cause", rule.cause);
  v.unless_empty("owner", rule.owner);
  v("effects", rule.effects);
}

template <class V>
void describe(V& v, const CompositionInfo& composition) {
  nlohmann::ordered_map<std::string, std::string> facts;
  for (const auto& [name, definition] : composition.facts) facts[std::string{name}] = definition;
  v("composition", composition.name);
  v("machines", composition.parts);
  v("packets", composition.packets);
  v("timers", composition.timers);
  v("state", composition.state);
  v("facts", facts);
  v("rules", composition.rules);
  v("procedures", composition.procedures);
  v("steps", composition.steps);
}

}  // namespace stormproof::fsm::composition

namespace stormproof::draw {

nlohmann::ordered_json composition_json(const fsm::composition::CompositionInfo& composition) {
  return report::json_of(composition);
}

nlohmann::ordered_json composition_schema(report::SchemaDefinitions& definitions) {
  return report::schema_form<fsm::composition::CompositionInfo>(definitions);
}

}  // namespace stormproof::draw
