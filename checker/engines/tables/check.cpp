// Which property is decided by which function, and the border that no exception crosses.
#include <array>
#include <exception>

#include <z3++.h>

#include "checker/engines/bounds/resting.hpp"
#include "checker/engines/tables/properties.hpp"
#include "checker/engines/tables/tables.hpp"
#include "model/implementations.hpp"

namespace stormproof::tables {
namespace {

using Decide = Finding (*)(const CheckRequest&);

constexpr std::array<std::string_view, 15> ids{"fsm.determinism",
                                               "fsm.totality",
                                               "fsm.reachability",
                                               "composition.total",
                                               "composition.live",
                                               "composition.pending",
                                               "order.total",
                                               "order.reception-first",
                                               "order.commutation",
                                               "safety.ack-implies-received",
                                               "safety.repair-only-if-asked",
                                               "safety.snapshot",
                                               "timer.single-heartbeat",
                                               "live.no-stall",
                                               "live.recovery"};
constexpr std::array<Decide, 15> functions{fsm_determinism,
                                           fsm_totality,
                                           fsm_reachability,
                                           composition_total,
                                           composition_live,
                                           composition_pending,
                                           order_total,
                                           order_reception_first,
                                           order_commutation,
                                           safety_ack_implies_received,
                                           safety_repair_only_if_asked,
                                           safety_snapshot,
                                           timer_single_heartbeat,
                                           live_no_stall,
                                           live_recovery};

/// Those about the tables and rules of an implementation, whatever the knobs of a profile.
bool is_of_rules(std::string_view property) {
  return property.starts_with("fsm.") || property == "order.commutation";
}

Finding failed(const std::string& why) {
  Finding finding;
  finding.engine = "tables";
  finding.how = "inconclusive: " + why;
  finding.details.push_back("inconclusive: " + why);
  return finding;
}

Finding decide(std::string_view property, Decide function, const CheckRequest& request) {
  try {
    if (!is_of_rules(property)) return function(request);
    const std::string rules{model::traits_of(request.scenario.dds).name};
    return checker::found_of_rules(request, std::string{property} + " of " + rules,
                                   [&] { return function(request); });
  } catch (const z3::exception& error) {
    return failed(std::string{"z3: "} + error.msg());
  } catch (const std::exception& error) {
    return failed(error.what());
  }
}

}  // namespace

std::span<const std::string_view> decidable() { return ids; }

checker::Findings check(std::span<const std::string_view> properties, const CheckRequest& request) {
  checker::Findings findings;
  for (const std::string_view property : properties) {
    for (std::size_t k = 0; k < ids.size(); ++k) {
      if (ids[k] != property) continue;
      if (request.on_progress && !request.on_progress(property)) return findings;
      findings.emplace_back(ids[k], decide(ids[k], functions[k], request));
    }
  }
  return findings;
}

}  // namespace stormproof::tables
