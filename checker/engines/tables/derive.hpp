// Derives the steps of a whole composition: each rule once for us, and once for another of each
// index of its owner, in the world of checker/engines/tables/derived_world.hpp.
#pragma once

#include "checker/engines/tables/derived_world.hpp"
#include "fsm/composition/first_value.hpp"
#include "fsm/composition/watched_world.hpp"
#include "model/engine/effect_mutator.hpp"

namespace stormproof::tables {

/// Whether a rule waits for the packet's having left its source.
template <class P, class Rules>
bool waits_for_source() {
  bool waits = false;
  composition::for_each_type(Rules{}, [&]<class R>() {
    waits = waits || std::is_same_v<typename R::Trigger, composition::LeftSource<P>>;
  });
  return waits;
}

/// Runs the rule, as it is or with a mistake at an effect.
template <class R, class Composition>
void run_rule(DerivedWorld<Composition>& world, const model::Mutation& mistakes) {
  model::EffectMutator watcher{&mistakes};
  if (!watcher.is_needed()) return R::run(world);
  composition::WatchedWorld watched{world, watcher, composition::Trail{fsm::name_of<R>()}};
  R::run(watched);
  watcher.go_on();
}

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
    if constexpr (requires { typename V::IsFlag; }) {
      derivation.declare(tag_name<V>(), composition::first_value<V>() != 0);
    }
  });
  if constexpr (requires { typename Composition::FirstSamples; }) {
    derivation.number_descriptors();
    composition::for_each_type(typename Composition::FirstSamples{},
                               [&]<class V>() { derivation.declare_count(tag_name<V>()); });
  }
  composition::for_each_type(typename Composition::Timers{}, [&]<class T>() {
    if (derived.counts<T>()) {
      derivation.declare_count("pending " + tag_name<T>());
      derivation.declare_count("counted " + tag_name<T>());
    } else {
      derivation.declare("pending " + tag_name<T>(), false);
      derivation.declare("started " + tag_name<T>(), comes_from_outside<T, Composition>());
    }
    if (derived.time != nullptr) derived.time->declare_timer(tag_name<T>(), derived.counts<T>());
  });
  composition::for_each_type(typename Composition::Packets{}, [&]<class P>() {
    for (const auto& content : DerivedPacket<P>::all_contents()) {
      derivation.declare(content.first, false);
    }
    if (derived.time == nullptr) return;
    derived.time->declare_packet(tag_name<P>(), waits_for_source<P, typename Composition::Rules>());
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
      run_rule<R>(world, derived.mistakes);
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
  if (derived.time != nullptr) derived.time->derive_passing();
}

}  // namespace stormproof::tables
