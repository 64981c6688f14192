// Properties of machines, of the order of events, of the network and of results apply to all.
#include "props/applicability.hpp"

#include <algorithm>
#include <array>

#include "model/implementations.hpp"

namespace stormproof::props {

namespace {
constexpr std::array<std::string_view, 7> of_all{
    "fsm.determinism", "fsm.totality",          "fsm.reachability",   "composition.total",
    "order.total",     "order.reception-first", "safety.conservation"};
}  // namespace

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
