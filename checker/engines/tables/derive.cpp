// Derives the steps of a whole composition: each rule once for us, and once for another of each
// index of its owner, by the reader of checker/engines/tables/derived_world.hpp.
#include "checker/engines/tables/derived_world.hpp"
#include "checker/engines/tables/machine_step.hpp"

namespace stormproof::tables {
namespace {

using fsm::program::Program;
using fsm::program::Rule;
using fsm::program::Tag;
using fsm::program::Thing;

/// Declares the variables of the composition.
class Declaration {
 public:
  Declaration(const Program& program, Derived& derived) : program_{program}, derived_{derived} {}

  void declare() {
    for (const Tag part : program_.parts) {
      const fsm::program::Machine& machine = program_.machine_of(part);
      for (std::size_t k = 0; k < machine.states.size(); ++k) {
        system().declare(state_name(program_, part, k), k == machine.initial);
      }
    }
    for (const Tag tag : program_.state) {
      const Thing& state = program_.things[tag];
      if (state.kind == Thing::Kind::flag) system().declare(name(tag), state.first != 0);
    }
    if (!program_.first_samples.empty()) system().number_descriptors();
    for (const Tag number : program_.first_samples) system().declare_count(name(number));
    for (const Tag timer : program_.timers) declare_timer(timer);
    for (const Tag packet : program_.packets) {
      for (const auto& content : all_contents(program_, packet)) {
        system().declare(content.first, false);
      }
      if (derived_.time == nullptr) continue;
      const bool leaves = program_.rule_for(fsm::program::Trigger::left, packet) != nullptr;
      derived_.time->declare_packet(name(packet), leaves);
    }
    if (!derived_.happens) return;
    for (const Tag occasion : program_.occasions) {
      system().declare("raised " + name(occasion), false);
    }
  }

 private:
  [[nodiscard]] Derivation& system() const { return derived_.derivation; }
  [[nodiscard]] std::string name(Tag tag) const { return std::string{program_.things[tag].name}; }

  void declare_timer(Tag timer) {
    const bool counted = derived_.counts(program_.things[timer]);
    if (counted) {
      system().declare_count("pending " + name(timer));
      system().declare_count("counted " + name(timer));
    } else {
      system().declare("pending " + name(timer), false);
      system().declare("started " + name(timer), program_.comes_from_outside(timer));
    }
    if (derived_.time != nullptr) derived_.time->declare_timer(name(timer), counted);
  }

  const Program& program_;
  Derived& derived_;
};

void derive_for(const Program& program, Derived& derived, const Rule& rule, Foreign foreign,
                const std::string& prefix) {
  derived.derivation.begin();
  DerivedWorld::Execution execution{program, derived.mistakes.effects};
  DerivedWorld world{execution, derived, foreign, rule.name};
  world.trigger(rule);
  world.run_rule(rule);
  if (derived.ended) {
    DerivedWorld us{execution, derived, 0};
    derived.ended(us.bitmap().at("Listed"));
  }
  derived.derivation.end(prefix + std::string{rule.name});
}

/// One step for us, and one for another of each index of the rule's owner.
void derive_steps(const Program& program, Derived& derived, const Rule& rule) {
  namespace owner = fsm::composition::owner;
  derive_for(program, derived, rule, 0, "");
  if (derived.derivation.is(Unsound::rules_for_us_only)) return;
  const auto other = [&](Foreign index, const char* prefix) {
    if ((rule.owner.indices & index) != 0) derive_for(program, derived, rule, index, prefix);
  };
  other(owner::peer_index, "another reader: ");
  other(owner::stream_index, "another stream: ");
  other(owner::descriptor_index, "another descriptor: ");
}

}  // namespace

void derive(const Program& program, Derived& derived) {
  Declaration{program, derived}.declare();
  for (const Rule& rule : program.rules) {
    if (derived.happens || rule.group == Rule::Group::exchange) {
      derive_steps(program, derived, rule);
    }
  }
  if (derived.time != nullptr) derived.time->derive_passing();
}

}  // namespace stormproof::tables
