// How the rules of a composition hang together: what causes what, in which order a page tells it,
// and which rules act on one side. Everything follows from the effects; nothing is drawn here.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "fsm/composition/composition_info.hpp"

namespace stormproof::draw {

/// Ids of the rules, procedures and steps with an effect of such a kind on `target`, each once.
[[nodiscard]] std::vector<std::string> causes_of(
    const fsm::composition::CompositionInfo& composition, std::string_view target,
    std::initializer_list<std::string_view> kinds);

/// Ids of those that call the procedure, or perform the step, of this id.
[[nodiscard]] std::vector<std::string> callers_of(
    const fsm::composition::CompositionInfo& composition, std::string_view id);

/// Ids of the rules that a packet, timer or occasion triggers.
[[nodiscard]] std::vector<std::string> handlers_of(
    const fsm::composition::CompositionInfo& composition, std::string_view cause);

/// Where an effect leads: to the handlers of a packet, timer or occasion, to a procedure or step.
[[nodiscard]] std::vector<std::string> led_to(const fsm::composition::CompositionInfo& composition,
                                              const fsm::composition::EffectInfo& effect);

/// All rules, procedures and steps: rules as they stand, what they call or perform after the last
/// that does. The pointers are into `composition`.
[[nodiscard]] std::vector<const fsm::composition::RuleInfo*> reading_order(
    const fsm::composition::CompositionInfo& composition);

/// Rules that act on one side: those that share a machine, state or timer, that send the same
/// packet, or that call each other. A step belongs to those who perform it, if they are one side.
struct Party {
  std::string name;  ///< "writer side"; of packets that are not known the first machine's name
  std::vector<std::string> rules;  ///< ids, of procedures and steps, too
  std::vector<fsm::composition::PartInfo> parts;
  std::vector<std::string_view> timers, state;
  std::vector<std::string_view> packets;  ///< that it sends
};
/// In the order of their first rules. Steps of several sides are in none.
[[nodiscard]] std::vector<Party> parties(const fsm::composition::CompositionInfo& composition);

/// The party with this rule; none: nullptr.
[[nodiscard]] const Party* party_of(const std::vector<Party>& parties, std::string_view rule);

}  // namespace stormproof::draw
