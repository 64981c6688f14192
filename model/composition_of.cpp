// Compositions are listed in the order of implementations; the last ones are those of lives.
#include "model/composition_of.hpp"

#include <algorithm>
#include <string>

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

bool is_living(const Scenario& scenario) {
  const bool lives = scenario.deployment.life || announces_to_ports(scenario);
  return lives && traits_of(scenario.dds).has_living_composition;
}

const fsm::composition::CompositionInfo& living_composition_of(const DdsProfile& dds) {
  const std::string name = std::string{composition_of(dds).name} + "-living";
  return *std::ranges::find(fsm::composition::compositions(), name,
                            &fsm::composition::CompositionInfo::name);
}

const fsm::composition::CompositionInfo& composition_of(const Scenario& scenario) {
  return is_living(scenario) ? living_composition_of(scenario.dds) : composition_of(scenario.dds);
}

}  // namespace stormproof::model
