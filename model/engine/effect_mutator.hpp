// Makes the mistakes of a run between the machines (fsm/composition/effect_mutation.hpp), and tells
// the probe of each effect if it asks for them.
#pragma once

#include "fsm/composition/watched_world.hpp"
#include "model/mutation.hpp"
#include "model/probe.hpp"

namespace stormproof::model {

class EffectMutator final : public fsm::composition::Watcher {
 public:
  /// No mutation: the rules are correct; no probe: nobody is told.
  explicit EffectMutator(const Mutation* mutation, Probe* probe = nullptr)
      : mutation_{mutation}, probe_{probe} {}

  /// Whether there is anything to watch.
  [[nodiscard]] bool is_needed() const {
    const bool wrong = mutation_ != nullptr && !mutation_->effects.empty();
    return wrong || (probe_ != nullptr && probe_->wants_effects());
  }
  void happens(fsm::composition::EffectKey key) override {
    if (probe_ != nullptr) probe_->effect(key);
  }
  void decides(fsm::composition::EffectKey key, bool holds) override {
    if (probe_ != nullptr) probe_->decided(key, holds);
  }
  [[nodiscard]] Change change_of(fsm::composition::EffectKey key) const override {
    if (mutation_ == nullptr) return Change::none;
    for (const fsm::composition::EffectMutation& mutation : mutation_->effects) {
      if (mutation.key == key) return mutation.change;
    }
    return Change::none;
  }

 private:
  const Mutation* mutation_;
  Probe* probe_;
};

}  // namespace stormproof::model
