// One relation of Cyclone DDS as a world for the explorer: which rule each event is, and what must
// hold after it. The rules are those that the simulator executes, with its packer, in the order in
// which it does, so a path of the explorer can be run by the simulator.
#pragma once

#include <cstdint>
#include <string>

#include "checker/engines/explorer/cyclone_host.hpp"

namespace stormproof::explorer {

class CycloneWorld {
 public:
  using State = CycloneState;
  static constexpr bool sorts_slots() { return true; }
  static constexpr std::size_t state_words() { return sizeof(State) / sizeof(std::uint64_t); }

  /// `running` is the scenario that runs.
  CycloneWorld(const model::Scenario& running, const model::Scenario& specification,
               const Scope& scope, const model::Mutation& mutation);

  /// The initial state; `frame` is empty.
  State start(Frame& frame);
  /// `slot` happens.
  void fire(State& state, Frame& frame, const Slot& slot);

  [[nodiscard]] bool complete(const State& state) const {
    return received(state) == (std::uint32_t{1} << deliveries()) - 1;
  }
  /// A bit for each sample.
  [[nodiscard]] static std::uint32_t received(const State& state) { return state.get<comp::X>(); }
  [[nodiscard]] unsigned deliveries() const { return scope_.descriptors; }
  [[nodiscard]] const Scope& scope() const { return scope_; }
  [[nodiscard]] const EventRules& rules() const { return rules_; }
  /// The state in words.
  [[nodiscard]] std::string describe(const State& state) const;

 private:
  void happen(const Slot& slot);
  void receive(const Slot& part);

  const Scope scope_;
  const EventRules rules_;
  CycloneHost host_;
};

}  // namespace stormproof::explorer
