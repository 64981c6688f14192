#include "checker/verification/mutate/happened.hpp"

namespace stormproof::mutate {

model::Reports EffectProbe::reports() const {
  model::Reports reports;
  reports.set(model::Report::effect);
  return reports;
}

/// Loops are asked even if nothing happens in them.
bool may_change(const fsm::composition::EffectMutation& mistake, const Happened& happened) {
  using enum fsm::composition::EffectMutation::Change;
  const bool did_not_hold = happened.did_not.contains(mistake.key);
  switch (mistake.change) {
    case first_only:
      return true;
    case always:
      return did_not_hold;
    case negated:
      return did_not_hold || happened.held.contains(mistake.key);
    default:
      return happened.effects.contains(mistake.key);
  }
}

}  // namespace stormproof::mutate
