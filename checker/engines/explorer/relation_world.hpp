// One relation as a world for the explorer, or those of one writer to several readers, or of both
// writers of a participant: which rule each event is, and what must hold after it. The rules are
// those of a recorded program, the same that the simulator executes, in the order in which it does,
// so a path of the explorer can be run by the simulator.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "checker/engines/explorer/packing.hpp"
#include "checker/engines/explorer/rule_runner.hpp"
#include "model/mutation.hpp"

namespace stormproof::explorer {

class RelationWorld {
 public:
  using State = WorldState;
  using Program = fsm::program::Program;
  using Tag = fsm::program::Tag;

  /// `running` is the scenario that runs, `specification` the one whose τ_S has to be honoured. The
  /// rules are those of the profile's implementation, or those that are given.
  RelationWorld(const model::Scenario& running, const model::Scenario& specification,
                const Scope& scope, const model::Mutation& mutation);
  RelationWorld(const Program& program, const model::Scenario& running,
                const model::Scenario& specification, const Scope& scope,
                const model::Mutation& mutation);

  /// The initial state; `frame` is empty.
  State start(Frame& frame);
  /// `slot` happens.
  void fire(State& state, Frame& frame, const Slot& slot);

  [[nodiscard]] bool complete(const State& state) const {
    return received(state) == (std::uint32_t{1} << deliveries()) - 1;
  }
  /// A bit for each relation and descriptor, relation by relation.
  [[nodiscard]] std::uint32_t received(const State& state) const;
  [[nodiscard]] unsigned deliveries() const;
  [[nodiscard]] unsigned descriptors(unsigned relation = 0) const {
    return runner_.descriptors(relation);
  }
  [[nodiscard]] const Scope& scope() const { return scope_; }
  [[nodiscard]] const EventRules& rules() const { return rules_; }
  [[nodiscard]] bool sorts_slots() const { return relations() > 1 || packing_->has_two_ends(); }
  [[nodiscard]] std::size_t used_words() const { return layout_.words(); }
  /// The state in words.
  [[nodiscard]] std::string describe(const State& state) const;

  [[nodiscard]] const Program& program() const { return program_; }
  /// Where a thing of the program is in a state.
  [[nodiscard]] const Layout& layout() const { return layout_; }

 private:
  [[nodiscard]] unsigned relations() const { return scope_.readers * scope_.writers; }
  [[nodiscard]] Specialised specialised(const model::Mutation& mutation);
  [[nodiscard]] Layout laid_out();
  void happen(const Slot& slot);
  void schedule_openings(Frame& frame) const;
  void start_creations(State& state, Frame& frame) const;
  void create(const Slot& slot);
  /// The sides of all writers with the slot's reader.
  void open(Slot slot, What side);
  [[nodiscard]] View view_of(const State& state, unsigned relation) const;
  [[nodiscard]] std::string describe(const State& state, unsigned relation) const;

  const Program& program_;
  const model::Scenario running_;
  const std::int64_t suppression_ns_;
  const Scope scope_;
  const EventRules rules_;
  const bool live_bitmaps_;
  const bool opens_at_once_;
  const bool leaves_later_;  ///< suppression begins when a repair has left the source
  const Tag view_;  ///< the writer's view of a descriptor, if it has one: the paper's letter
  std::vector<std::uint8_t> letters_;  ///< by its state: 1, 2 or 3 of U, S or A
  const std::unique_ptr<Packing> packing_;
  RuleRunner::Remembered remembered_;
  const Layout layout_;
  Specialised rules_of_events_;
  RuleRunner runner_;
};

}  // namespace stormproof::explorer
