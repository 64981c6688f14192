// Properties of machines, of the order of events, of the network and of results apply to all.
#include "props/applicability.hpp"

#include <algorithm>
#include <array>

#include "model/implementations.hpp"
#include "model/scenario.hpp"

namespace stormproof::props {

namespace {
constexpr std::array<std::string_view, 7> of_all{
    "fsm.determinism", "fsm.totality",          "fsm.reachability",   "composition.total",
    "order.total",     "order.reception-first", "safety.conservation"};

/// Their bounds and theorems count from instants at which timers are due.
constexpr std::array<std::string_view, 5> of_punctual_timers{
    "live.completion", "live.quiescence", "storm.single-copy", "storm.free-threshold",
    "storm.cannot-start"};

bool stalls(const model::Scenario& scenario) {
  return scenario.wireless.sender == model::Sender::stalls;
}
}  // namespace

std::string_view why_not_applicable(std::string_view property, const model::Scenario& scenario) {
  const std::string_view why = why_not_applicable(property, model::kind_of(scenario.dds));
  if (!why.empty() || !stalls(scenario)) return why;
  if (std::ranges::find(of_punctual_timers, property) == of_punctual_timers.end()) return {};
  return "it counts on timers that are served when they are due; a participant that stalls "
         "(sender: "
         "stalls) serves none as long as its packets wait for room, however long that is";
}

bool is_provable(std::string_view property, const model::Scenario& scenario) {
  if (!stalls(scenario)) return true;
  constexpr std::array<std::string_view, 3> of_rules{"fsm.", "order.", "composition."};
  return std::ranges::any_of(of_rules,
                             [&](std::string_view kind) { return property.starts_with(kind); });
}

std::string_view why_not_applicable(std::string_view property,
                                    model::ImplementationKind implementation) {
  if (model::traits_of(implementation).is_known_to_engines) return {};
  const bool is_general =
      property.starts_with("limit.") || std::ranges::find(of_all, property) != of_all.end();
  if (is_general) return {};
  return "it is stated for the writers of the paper and of Fast DDS; of this one only machines, "
         "network and results are checked";
}

}  // namespace stormproof::props
