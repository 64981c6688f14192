// All laws, family by family; and which of them are about runs, time and the network as such.
#include <algorithm>
#include <array>
#include <vector>

#include "props/laws/families.hpp"

namespace stormproof::props {

std::span<const Law> laws() {
  static const std::vector<Law> all = [] {
    std::vector<Law> list;
    for (const auto family :
         {repetition_laws, naming_laws, time_laws, byte_laws, workload_laws, quiet_laws,
          obligation_laws, introduction_laws, opening_laws, request_laws, reminder_laws,
          control_laws, lookup_laws, sample_laws, accounting_laws, causality_laws, service_laws,
          bound_laws, adaptive_laws}) {
      const std::span<const Law> part = family();
      list.insert(list.end(), part.begin(), part.end());
    }
    return list;
  }();
  return all;
}

namespace {
/// They hold whatever writers do, with a server, too. The others count what the paper and Fast DDS
/// send, or know when their timers are due.
constexpr std::array<std::string_view, 19> of_all_writers{
    "law.determinism",     "law.observation",        "law.later-limit",     "law.earlier-limit",
    "law.run-until",       "law.unused-values",      "law.route-names",     "law.time-translation",
    "law.work-conserving", "law.channel-use",        "law.delays",          "law.causality",
    "law.knowledge",       "law.single-stage-order", "law.unlimited-queue", "law.unsent-losses",
    "law.lost-is-late",    "law.physical-bound",     "law.time-scaling"};
}  // namespace

bool speaks_of(const Law& law, const model::Scenario& scenario) {
  const bool of_all = std::ranges::find(of_all_writers, law.id) != of_all_writers.end();
  return (of_all || !traits_of(scenario).has_server) && law.applies(scenario);
}

}  // namespace stormproof::props
