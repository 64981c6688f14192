// Writes the Promela model of one relation of any composition: each rule about relations and
// writers (`Exchange`) once, as a process, in the world of checker/engines/promela/
// promela_world.hpp. Of the rules that announce there is what they come to: each participant hears
// of the other once, at some time. What comes from outside happens once, at any time. Control-only
// relations share nothing with this one.
#pragma once

#include <algorithm>

#include "checker/engines/promela/model_text.hpp"
#include "checker/engines/promela/promela_world.hpp"
#include "fsm/composition/watched_world.hpp"
#include "model/engine/effect_mutator.hpp"

namespace stormproof::promela {

/// Runs a rule in a world, as it is or with a mistake at an effect.
template <class R, class Composition>
void run_rule(PromelaWorld<Composition> world, const model::Mutation& mistakes) {
  model::EffectMutator watcher{&mistakes};
  if (!watcher.is_needed()) return R::run(world);
  composition::WatchedWorld watched{world, watcher, composition::Trail{fsm::name_of<R>()}};
  R::run(watched);
  watcher.go_on();
}

/// What an announcement does to the relation: that of its writer's participant when it reaches the
/// reader's for the first time, and the other way round.
struct WriterIsHeard {
  template <class W>
  static void run(W& w) {
    W::Composition::open_sides(w);
  }
};
struct ReaderIsHeard {
  template <class W>
  static void run(W& w) {
    w.reverse([](auto& back) { W::Composition::open_sides(back); });
  }
};

template <class Composition, class R>
void add_announcement(ModelText& model, Script& script, const model::DdsProfile& dds,
                      const model::Mutation& mistakes) {
  script.begin(false);
  run_rule<R>(PromelaWorld<Composition>{script, dds, mistakes}, mistakes);
  model.add_occasion(name<R>(), {{script.take_lines(), script.take_sends()}});
}

/// A rule's process, or nothing if its trigger has not been found to happen.
template <class Composition, class R>
void add_rule(ModelText& model, Script& script, const model::DdsProfile& dds,
              const model::Mutation& mistakes) {
  using Trigger = typename R::Trigger;
  using Cause = typename Trigger::Cause;
  constexpr bool at_source = std::is_same_v<Trigger, composition::LeftSource<Cause>>;
  const auto step = [&](int descriptor = 0) {
    PromelaWorld<Composition> world{script, dds, mistakes, descriptor};
    world.look_at(name<Cause>());
    script.begin(at_source);
    run_rule<R>(world, mistakes);
    return Step{script.take_lines(), script.take_sends()};
  };
  if constexpr (std::is_same_v<Trigger, composition::Happens<Cause>>) {
    const bool from_outside = std::ranges::any_of(Composition::from_outside, [](const auto& cause) {
      return cause.name == fsm::name_of<Cause>();
    });
    if (!from_outside) return;
    std::vector<Step> steps;
    for (unsigned d = 0; d < (of_descriptors<Cause> ? script.descriptors() : 1); ++d) {
      steps.push_back(step(static_cast<int>(d)));
    }
    model.add_occasion(name<R>(), steps);
  } else if constexpr (std::is_same_v<Trigger, composition::Due<Cause>>) {
    if (!script.is_found("due " + name<Cause>())) return;
    model.add_timer(name<R>(), name<Cause>(), Cause::counted, step());
  } else {
    if (!script.is_found("sent " + name<Cause>())) return;
    model.add_packet(name<R>(), name<Cause>(), at_source, step());
  }
}

/// The model with 1 … max_descriptors descriptors under a profile with the periodic policy.
/// `mistakes` are those of tables and effects that a mutant makes; others have no meaning here.
template <class Composition>
std::string promela_of(unsigned descriptors, const model::DdsProfile& dds,
                       const model::Mutation& mistakes = {}) {
  Script script{descriptors};
  script.declare("byte " + name<composition::X>() + ";\n");
  std::vector<std::string> acknowledged;
  composition::for_each_type(typename Composition::Parts{}, [&]<class P>() {
    if constexpr (of_descriptors<P>) {  // the writer's view
      PromelaWorld<Composition>{script, dds, mistakes}.template declare<P>();
      for (unsigned d = 0; d < descriptors; ++d) {
        acknowledged.push_back(fmt::format("({}[{}] == {})", name<P>(), d,
                                           TableMacros<typename P::Machine>::state("A")));
      }
    }
  });
  for (;;) {
    const std::size_t found = script.found();
    ModelText model{std::string{Composition::name}, descriptors};
    composition::for_each_type(typename Composition::Packets{}, [&]<class P>() {
      if (!script.is_found("sent " + name<P>())) return;
      composition::for_each_type(typename P::Fields{}, [&]<class F>() {
        const bool bitmap = std::derived_from<F, composition::DescriptorField>;
        model.add_field(name<P>(), name<F>(), bitmap, script);
      });
    });
    add_announcement<Composition, WriterIsHeard>(model, script, dds, mistakes);
    add_announcement<Composition, ReaderIsHeard>(model, script, dds, mistakes);
    composition::for_each_type(typename Composition::Exchange{}, [&]<class R>() {
      add_rule<Composition, R>(model, script, dds, mistakes);
    });
    if (script.found() != found) continue;
    return model.text(script, acknowledged, name<composition::X>());
  }
}

}  // namespace stormproof::promela
