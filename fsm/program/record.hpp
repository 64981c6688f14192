// Records a whole composition: what it has, its rules, and what it calls what every composition
// has. `Composition` is a type as `fsm::composition::paper::Paper`.
#pragma once

#include <tuple>

#include "fsm/composition/heartbeat_clock.hpp"
#include "fsm/composition/reader.hpp"
#include "fsm/program/recorder.hpp"

namespace stormproof::fsm::program {

namespace detail {
template <class Composition, class R>
constexpr Rule::Group group_of() {
  const auto is_in = []<class... Rs>(TypeList<Rs...>) { return (std::is_same_v<R, Rs> || ...); };
  if constexpr (requires { typename Composition::Exchange; }) {
    if (is_in(typename Composition::Exchange{})) return Rule::Group::exchange;
  }
  if constexpr (requires { typename Composition::Announcing; }) {
    if (is_in(typename Composition::Announcing{})) return Rule::Group::announcing;
  }
  return Rule::Group::other;
}

template <class P>
constexpr Trigger trigger_of(composition::Received<P>) {
  return Trigger::received;
}
template <class P>
constexpr Trigger trigger_of(composition::LeftSource<P>) {
  return Trigger::left;
}
template <class T>
constexpr Trigger trigger_of(composition::Due<T>) {
  return Trigger::due;
}
template <class O>
constexpr Trigger trigger_of(composition::Happens<O>) {
  return Trigger::happens;
}
}  // namespace detail

/// What a composition calls what every composition has.
template <class Composition>
void record_roles(Program& program, Recorder& recorder) {
  program.is_open = recorder.tag<typename Composition::IsOpen>();
  if constexpr (requires { typename Composition::IsQueued; }) {
    program.is_queued = recorder.tag<typename Composition::IsQueued>();
  }
  program.acknack = recorder.tag<typename Composition::AckNack>();
  if constexpr (requires { Composition::bitmap(); }) {
    const auto add = [&]<class F, class V>(const composition::Says<F, V>& saying) {
      program.bitmap.emplace_back(recorder.tag<F>(), recorder.given(saying).value);
    };
    std::apply([&](const auto&... each) { (add(each), ...); }, Composition::bitmap());
  }
  if constexpr (requires { typename Composition::FirstSamples; }) {
    composition::for_each_type(typename Composition::FirstSamples{}, [&]<class V>() {
      program.first_samples.push_back(recorder.tag<V>());
    });
  }
  if constexpr (requires { Composition::open_sides(recorder); }) {
    program.opening = recorder.record("opening", [&] { Composition::open_sides(recorder); });
  }
  program.now = recorder.tag<composition::Now>();
  program.response_delay = recorder.tag<composition::ResponseDelay>();
  program.heartbeat_period = recorder.tag<composition::HeartbeatPeriod>();
}

template <class Composition>
Program recorded() {
  Program program;
  program.name = Composition::name;
  const Recording recording{program};
  Recorder recorder{program};
  const auto list = [&](std::vector<Tag>& tags) {
    return [&]<class T>() { tags.push_back(recorder.tag<T>()); };
  };
  composition::for_each_type(typename Composition::Parts{}, list(program.parts));
  composition::for_each_type(typename Composition::Timers{}, list(program.timers));
  composition::for_each_type(typename Composition::State{}, list(program.state));
  composition::for_each_type(typename Composition::Packets{}, list(program.packets));
  composition::for_each_type(typename Composition::Occasions{}, list(program.occasions));
  composition::for_each_type(typename Composition::Rules{}, [&]<class R>() {
    using Cause = typename R::Trigger::Cause;
    Rule rule{.name = name_of<R>(),
              .trigger = detail::trigger_of(typename R::Trigger{}),
              .cause = recorder.tag<Cause>(),
              .owner = R::owner,
              .group = detail::group_of<Composition, R>(),
              .body = recorder.record(name_of<R>(), [&] { R::run(recorder); })};
    program.rules.push_back(std::move(rule));
  });
  for (const composition::Unused& unused : Composition::unused) {
    program.unused.push_back({unused.part, unused.name, unused.reason});
  }
  for (const composition::FromOutside& cause : Composition::from_outside) {
    program.from_outside.push_back({"", cause.name, cause.reason});
  }
  record_roles<Composition>(program, recorder);
  check(program);
  return program;
}

}  // namespace stormproof::fsm::program
