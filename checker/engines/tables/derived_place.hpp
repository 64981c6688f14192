// Where a rule is derived: which of its indices are ours, and under which condition it gets there.
// What is here knows variables, machines and knobs; the words of rules are in
// checker/engines/tables/derived_world.hpp.
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "checker/engines/tables/derived.hpp"
#include "checker/engines/tables/machine_step.hpp"
#include "model/engine/composition_knobs.hpp"

namespace stormproof::tables {

class DerivedPlace {
 public:
  using D = smt::Symbolic;
  using Bool = smt::SymbolicBool;
  using Int = smt::SymbolicInt;
  using Says = DerivedTime::Says;

  DerivedPlace(Derived& derived, Foreign foreign)
      : derived_{&derived},
        foreign_{foreign},
        subject_is_ours_{(foreign & composition::owner::descriptor_index) == 0} {}

  /// The variable that is true in this state of the machine.
  template <class P>
  static std::string state_name(std::size_t state) {
    return tag_name<P>() + "=" + std::string{fsm::Reflect<typename P::Machine>::state_names[state]};
  }

 protected:
  Derivation& derivation() { return derived_->derivation; }
  [[nodiscard]] bool is_foreign(composition::Owner owner) const {
    return (owner.indices & foreign_) != 0;
  }
  /// The same without the two participants.
  static composition::Owner without_pair(composition::Owner owner) {
    return {static_cast<Foreign>(owner.indices & ~composition::owner::pair.indices)};
  }
  Bool unknown() { return Bool{derivation().unknown()}; }
  Bool or_others(const Bool& own) {
    return derivation().is(Unsound::others_never_ask) ? own : own || unknown();
  }
  /// How many there are with others, of which nothing is known.
  Int with_others(const Expr& own) {
    const Expr one = z3::ite(own, Int{1}.expr(), Int{0}.expr());
    return Int{derivation().is(Unsound::others_never_ask) ? one
                                                          : one + derivation().unknown_count()};
  }

  template <class Value, class Tag>
  Value knob(Tag tag) {
    if (!derived_->knob) return Value{model::knob_value(tag, derived_->dds)};
    return Value{derived_->knob({tag_name<Tag>(), [tag](const model::DdsProfile& dds) {
                                   return Value{model::knob_value(tag, dds)}.expr();
                                 }})};
  }

  void effect() { derived_->effect(path_, foreign_ == 0); }
  /// The same effects once more, from number `first` on.
  template <class Body>
  void again(unsigned first, Body&& body) {
    derived_->number = first;
    body();
  }
  /// The effects of a procedure or step, which is named like in the recorder.
  template <class P, class... Args, class Body>
  void aside(Body&& body) {
    if (!derived_->happens) return body();
    std::string name = tag_name<P>();
    [[maybe_unused]] const auto add = [&]<class Arg>() {
      if constexpr (std::is_empty_v<Arg>) name += " " + tag_name<Arg>();
    };
    (add.template operator()<Args>(), ...);
    derived_->aside(std::move(name), body);
  }
  template <class V, class Value>
  void assign(const Value& value) {
    if (is_foreign(V::owner)) return;
    if constexpr (requires { typename V::IsFlag; }) {
      derivation().assign(tag_name<V>(), path_, Bool{value}.expr());
    } else if (derivation().has(tag_name<V>())) {
      derivation().assign(tag_name<V>(), path_, Int{value}.expr());
    }
  }

  template <class P>
  void start_anew(const Expr& when) const {
    using Info = fsm::Reflect<typename P::Machine>;
    for (std::size_t k = 0; k < Info::state_count; ++k) {
      const bool start = k == Info::template id<typename P::Machine::initial_state>;
      derived_->derivation.assign(state_name<P>(k), when, Bool{start}.expr());
    }
  }
  template <class P, class E>
  auto step(const Expr& when, const typename P::Machine::Io::template Input<D>& input) {
    using Step = MachineStep<typename P::Machine>;
    const Step machine{derived_->mistakes.tables};
    OneHot before;
    for (std::size_t k = 0; k < Step::states; ++k) {
      before.push_back(is_foreign(P::owner) ? derivation().unknown()
                                            : derivation().now(state_name<P>(k)));
    }
    const auto effect = machine.template step<E>(before, input, when);
    if (!is_foreign(P::owner)) {
      for (std::size_t k = 0; k < Step::states; ++k) {
        derivation().now(state_name<P>(k)) = effect.next[k];
      }
    }
    return effect.outbox();
  }

  Derived* derived_;
  Foreign foreign_;
  bool subject_is_ours_;     ///< of a place that is about one descriptor
  bool is_reverse_ = false;  ///< the peer's side of our pair: ours, seen from there
  Expr path_ = Bool{true}.expr();
  std::optional<Says> packet_;
};

}  // namespace stormproof::tables
