// Derives the steps of a whole composition: each rule once for us, and once for another of each
// index of its owner, in the world of checker/engines/tables/derived_world.hpp.
#pragma once

#include "checker/engines/tables/derived_world.hpp"

namespace stormproof::tables {

/// Declares the variables of the composition.
template <class Composition>
void declare(Derived& derived) {
  using World = DerivedWorld<Composition>;
  Derivation& derivation = derived.derivation;
  composition::for_each_type(typename Composition::Parts{}, [&]<class P>() {
    using Info = fsm::Reflect<typename P::Machine>;
    for (std::size_t k = 0; k < Info::state_count; ++k) {
      const bool start = k == Info::template id<typename P::Machine::initial_state>;
      derivation.declare(World::template state_name<P>(k), start);
    }
  });
  composition::for_each_type(typename Composition::State{}, [&]<class V>() {
    if constexpr (requires { typename V::IsFlag; }) derivation.declare(tag_name<V>(), false);
  });
  composition::for_each_type(typename Composition::Timers{}, [&]<class T>() {
    if constexpr (T::counted) {
      derivation.declare_count("pending " + tag_name<T>());
      derivation.declare_count("counted " + tag_name<T>());
    } else {
      derivation.declare("pending " + tag_name<T>(), false);
      derivation.declare("started " + tag_name<T>(), comes_from_outside<T, Composition>());
    }
  });
  composition::for_each_type(typename Composition::Packets{}, [&]<class P>() {
    for (const auto& content : World::template all_contents<P>()) {
      derivation.declare(content.first, false);
    }
  });
  if (!derived.happens) return;
  composition::for_each_type(typename Composition::Occasions{}, [&]<class O>() {
    derivation.declare("raised " + tag_name<O>(), false);
  });
}

/// Derives a step from each of these rules: one for us, and one for another of each index of its
/// owner.
template <class Composition, class Rules>
void derive_steps(Derived& derived, Rules rules) {
  using World = DerivedWorld<Composition>;
  Derivation& derivation = derived.derivation;
  composition::for_each_type(rules, [&]<class R>() {
    const auto derive_for = [&](Foreign foreign, const std::string& prefix) {
      derivation.begin();
      derived.within = tag_name<R>();
      derived.number = 0;
      World world{derived, foreign};
      world.template trigger<typename R::Trigger>();
      R::run(world);
      if (derived.ended) {
        World us{derived, 0};
        derived.ended(us.template contents<typename Composition::AckNack>(Composition::bitmap())
                          .at(tag_name<composition::Listed>()));
      }
      derivation.end(prefix + tag_name<R>());
    };
    derive_for(0, "");
    if (derivation.is(Unsound::rules_for_us_only)) return;
    const auto other = [&](Foreign index, const char* prefix) {
      if ((R::owner.indices & index) != 0) derive_for(index, prefix);
    };
    other(composition::owner::peer_index, "another reader: ");
    other(composition::owner::stream_index, "another stream: ");
    other(composition::owner::descriptor_index, "another descriptor: ");
  });
}

/// Declares the variables and derives the steps: of the rules about relations and writers, or of
/// all.
template <class Composition>
void derive(Derived& derived) {
  declare<Composition>(derived);
  if (derived.happens) {
    derive_steps<Composition>(derived, typename Composition::Rules{});
  } else {
    derive_steps<Composition>(derived, typename Composition::Exchange{});
  }
}

}  // namespace stormproof::tables
