// Which packing does what.
#include "checker/engines/explorer/packing.hpp"

namespace stormproof::explorer {

std::unique_ptr<Packing> packing_of(const fsm::program::Program& program,
                                    const model::Scenario& running, const Scope& scope,
                                    const EventRules& rules) {
  const auto has = [&](std::string_view step) {
    return program.find(step) != fsm::program::no_thing;
  };
  if (has("Generate")) return paper_packing(running, scope);
  if (has("Pack")) return fastdds_packing(running, scope);
  if (has("Work")) return cyclone_packing(program, running, scope, rules);
  return std::make_unique<Packing>(running, scope);
}

}  // namespace stormproof::explorer
