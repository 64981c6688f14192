// What of the rules a run without a mistake comes to: a run that never comes to a mistake is the
// run without it, and need not be looked at.
#pragma once

#include <set>

#include "fsm/composition/effect_mutation.hpp"
#include "model/probe.hpp"

namespace stormproof::mutate {

struct Happened {
  std::set<fsm::composition::EffectKey> effects;
  std::set<fsm::composition::EffectKey> held;     ///< conditions, at least once
  std::set<fsm::composition::EffectKey> did_not;  ///< conditions that did not hold, at least once
};

/// Adds what happens in the runs that it watches to `happened`, which must outlive it.
class EffectProbe final : public model::Probe {
 public:
  explicit EffectProbe(Happened& happened) : happened_{happened} {}

  [[nodiscard]] model::Reports reports() const override;
  [[nodiscard]] bool wants_effects() const override { return true; }
  void effect(fsm::composition::EffectKey key) override { happened_.effects.insert(key); }
  void decided(fsm::composition::EffectKey key, bool holds) override {
    (holds ? happened_.held : happened_.did_not).insert(key);
  }

 private:
  Happened& happened_;
};

/// Whether runs in which this happens without the mistake can be others with it.
[[nodiscard]] bool may_change(const fsm::composition::EffectMutation& mistake,
                              const Happened& happened);

}  // namespace stormproof::mutate
