// What the knobs of a composition (fsm/composition) are in a profile. Every world that runs
// scenarios reads them here.
#pragma once

#include "fsm/composition/amended_parts.hpp"
#include "fsm/composition/cyclone_life.hpp"
#include "fsm/composition/fastdds.hpp"
#include "fsm/composition/paper.hpp"
#include "fsm/composition/server.hpp"
#include "model/config/knobs/knob_member.hpp"
#include "model/dds_profile.hpp"
#include "model/implementations.hpp"

namespace stormproof::model {

namespace comp = fsm::composition;

namespace knobs_of_composition {

// What no single knob says.
inline bool value(comp::AcceptsUnmatched, const DdsProfile& dds) {
  const RelationRules rules = rules_of(dds);
  return rules.unmatched == Unmatched::accept ||
         rules.relation_opening != RelationOpening::each_side;
}
// The two numbers of one knob, "sedp.adaptive.epsilon".
inline std::int64_t value(comp::EpsilonNumerator, const DdsProfile& dds) {
  return dds.sedp.adaptive.epsilon_numerator;
}
inline std::int64_t value(comp::EpsilonDenominator, const DdsProfile& dds) {
  return dds.sedp.adaptive.epsilon_denominator;
}

// Those that say what they are (fsm/composition/knobs.hpp).
template <std::int64_t fixed>
std::int64_t value(comp::FixedDelay<fixed>, const DdsProfile&) {
  return fixed;
}
template <comp::Text key>
std::int64_t value(comp::DelayOf<key>, const DdsProfile& dds) {
  const auto& number = config::knob_of<comp::DelayOf<key>>(dds);
  if constexpr (requires { number.count(); }) {
    return number.count();
  } else {
    return number;
  }
}
template <comp::Text key, comp::Text... values>
bool value(comp::SwitchOf<key, values...>, const DdsProfile& dds) {
  return config::is_chosen<comp::SwitchOf<key, values...>>(dds);
}

}  // namespace knobs_of_composition

/// Whether the switch or delay is one of the profile; otherwise it is the deployment's.
template <class Knob>
inline constexpr bool is_knob = requires(const DdsProfile& dds) {
  knobs_of_composition::value(Knob{}, dds);
};
/// The value of a switch, or of a delay in ns.
template <class Knob>
[[nodiscard]] auto knob_value(Knob knob, const DdsProfile& dds) {
  return knobs_of_composition::value(knob, dds);
}

}  // namespace stormproof::model
