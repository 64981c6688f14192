// The composition that a profile's implementation executes, as data.
#pragma once

#include "fsm/composition/composition_info.hpp"
#include "fsm/program/program.hpp"
#include "model/dds_profile.hpp"
#include "model/scenario.hpp"

namespace stormproof::model {

[[nodiscard]] const fsm::composition::CompositionInfo& composition_of(const DdsProfile& dds);
[[nodiscard]] const fsm::composition::CompositionInfo& composition_of(ImplementationKind kind);
/// The same as a recorded program.
[[nodiscard]] const fsm::program::Program& program_of(const DdsProfile& dds);
/// The program by which descriptors are exchanged: what clients tell a Discovery Server is Fast
/// DDS's exchange, whoever opens its relations.
[[nodiscard]] const fsm::program::Program& program_of_exchange(const DdsProfile& dds);

/// Whether participants have a life under rules that are a composition of their own, which no
/// engine knows (fsm/composition/fastdds_life.hpp, cyclone_life.hpp). Those of Cyclone DDS also say
/// what is announced to peers.
[[nodiscard]] bool is_living(const Scenario& scenario);
/// That composition, of a profile that has one.
[[nodiscard]] const fsm::composition::CompositionInfo& living_composition_of(const DdsProfile& dds);
[[nodiscard]] const fsm::composition::CompositionInfo& composition_of(const Scenario& scenario);

}  // namespace stormproof::model
