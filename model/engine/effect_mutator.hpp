// Makes the mistakes of a run between the machines (fsm/composition/effect_mutation.hpp), and tells
// the probe of each effect if it asks for them.
#pragma once

#include "fsm/composition/watched_world.hpp"
#include "model/engine/run_state.hpp"

namespace stormproof::model {

class EffectMutator final : public fsm::composition::Watcher {
 public:
  explicit EffectMutator(const RunState& run) : run_{run} {}

  /// Whether there is anything to watch in this run.
  [[nodiscard]] bool is_needed() const {
    const bool wrong = run_.mutation != nullptr && !run_.mutation->effects.empty();
    return wrong || (run_.probe != nullptr && run_.probe->wants_effects());
  }
  void happens(fsm::composition::EffectKey key) override {
    if (run_.probe != nullptr) run_.probe->effect(key);
  }
  [[nodiscard]] Change change_of(fsm::composition::EffectKey key) const override {
    if (run_.mutation == nullptr) return Change::none;
    for (const fsm::composition::EffectMutation& mutation : run_.mutation->effects) {
      if (mutation.key == key) return mutation.change;
    }
    return Change::none;
  }

 private:
  const RunState& run_;
};

}  // namespace stormproof::model
