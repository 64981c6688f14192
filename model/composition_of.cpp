// Compositions are listed in the order of implementations; the last one is that of lives.
#include "model/composition_of.hpp"

#include <algorithm>

#include "fsm/composition/compositions.hpp"
#include "fsm/program/programs.hpp"
#include "model/implementations.hpp"

namespace stormproof::model {

const fsm::composition::CompositionInfo& composition_of(ImplementationKind kind) {
  return fsm::composition::compositions()[composition_index(kind)];
}

const fsm::composition::CompositionInfo& composition_of(const DdsProfile& dds) {
  return composition_of(kind_of(dds));
}

const fsm::program::Program& program_of(const DdsProfile& dds) {
  return fsm::program::programs()[composition_index(kind_of(dds))];
}

const fsm::program::Program& program_of_exchange(const DdsProfile& dds) {
  if (!traits_of(dds).has_server) return program_of(dds);
  const auto& all = fsm::program::programs();
  return *std::ranges::find(all, "fastdds", &fsm::program::Program::name);
}

bool is_living_fastdds(const Scenario& scenario) {
  return scenario.deployment.life && traits_of(scenario.dds).has_living_composition;
}

const fsm::composition::CompositionInfo& composition_of(const Scenario& scenario) {
  return is_living_fastdds(scenario) ? fsm::composition::compositions().back()
                                     : composition_of(scenario.dds);
}

}  // namespace stormproof::model
