// Turns the transition table of an MSM front end into plain data: states, events and rows with
// names and numbers. Everything that is not execution (diagrams, proofs, the list of ignored pairs,
// traces) reads this, so no rule is ever written a second time. Where MSM compiles a machine
// (fsm/msm.hpp), the state numbers are checked against its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "fsm/front_end.hpp"
#include "fsm/machine_info.hpp"

namespace stormproof::fsm {

template <class... Ts>
struct TypeList {
  static constexpr std::size_t size = sizeof...(Ts);
};

namespace detail {

template <class List, class T>
struct PushBack;
template <class... Ts, class T>
struct PushBack<TypeList<Ts...>, T> {
  using type = TypeList<Ts..., T>;
};
struct PushBackFn {
  template <class List, class Numbered>
  struct apply : PushBack<List, typename Numbered::AsWritten> {};
};

template <class List, class T>
struct AddUnique;
template <class... Ts, class T>
struct AddUnique<TypeList<Ts...>, T> {
  using type =
      std::conditional_t<(std::is_same_v<Ts, T> || ...), TypeList<Ts...>, TypeList<Ts..., T>>;
};

// The distinct `Get<Row>::type` of a list of rows, in order of first appearance, appended to
// `List`.
template <class List, template <class> class Get, class Rows>
struct Distinct {
  using type = List;
};
template <class List, template <class> class Get, class First, class... Rest>
struct Distinct<List, Get, TypeList<First, Rest...>>
    : Distinct<typename AddUnique<List, typename Get<First>::type>::type, Get, TypeList<Rest...>> {
};

template <class R>
struct SourceOf {
  using type = typename R::Source;
};
template <class R>
struct TargetOf {
  using type = typename R::Target;
};
template <class R>
struct EventOf {
  using type = typename R::Evt;
};

template <class T, class... Ts>
constexpr std::size_t position(TypeList<Ts...>) {
  constexpr std::array<bool, sizeof...(Ts)> same{std::is_same_v<T, Ts>...};
  std::size_t k = 0;
  while (k < same.size() && !same[k]) ++k;
  return k;
}

}  // namespace detail

namespace detail {
template <class T>
constexpr std::string_view find_full_name() {
  const std::string_view text = __PRETTY_FUNCTION__;
  const auto begin = text.find("T = ") + 4;
  return text.substr(begin, text.find_first_of(";]", begin) - begin);
}
template <class T>
constexpr std::string_view find_name() {
  const std::string_view qualified = find_full_name<T>();
  const auto last = qualified.rfind("::");
  return last == std::string_view::npos ? qualified : qualified.substr(last + 2);
}
/// Found when the program is compiled: observers ask for it at every transition.
template <class T>
inline constexpr std::string_view found_name = find_name<T>();
}  // namespace detail

/// The unqualified name of a type, for states, events, guards and actions: `U`, `AckNackReceived`.
template <class T>
constexpr std::string_view name_of() {
  return detail::found_name<T>;
}
/// With its namespaces.
template <class T>
constexpr std::string_view full_name_of() {
  return detail::find_full_name<T>();
}

namespace detail {
/// The name of a guard in words: `Listed`, `not Listed`, `Waiting and not DispatchPending`.
template <class G>
struct GuardName {
  static std::string text() { return std::string{name_of<G>()}; }
};
template <class G>
struct GuardName<Not<G>> {
  static std::string text() { return "not " + GuardName<G>::text(); }
};
template <class First, class... Rest>
struct GuardName<All<First, Rest...>> {
  static std::string text() {
    return (GuardName<First>::text() + ... + (" and " + GuardName<Rest>::text()));
  }
};
}  // namespace detail

/// Compile-time view of the front end `Machine`.
template <class Machine>
struct Reflect {
  using Rows = typename boost::mpl::fold<typename Machine::transition_table, TypeList<>,
                                         detail::PushBackFn>::type;
  using Sources = typename detail::Distinct<TypeList<>, detail::SourceOf, Rows>::type;
  /// MSM numbers the sources in order of appearance, then the states that are only targets.
  using States = typename detail::Distinct<Sources, detail::TargetOf, Rows>::type;
  using Events = typename detail::Distinct<TypeList<>, detail::EventOf, Rows>::type;

  static constexpr std::size_t state_count = States::size;

  template <class S>
  static constexpr StateId id = [] {
    constexpr std::size_t own = detail::position<S>(States{});
    static_assert(own < state_count, "not a state of this machine");
    return static_cast<StateId>(own);
  }();

  template <class E>
  static constexpr std::uint8_t event_id = [] {
    constexpr std::size_t own = detail::position<E>(Events{});
    static_assert(own < Events::size, "not an event of this machine");
    return static_cast<std::uint8_t>(own);
  }();

  /// Names of the states by number.
  static constexpr auto state_names = []<class... Ss>(TypeList<Ss...>) {
    return std::array<std::string_view, sizeof...(Ss)>{name_of<Ss>()...};
  }(States{});

  static MachineInfo info() {
    MachineInfo machine{name_of<Machine>(), id<typename Machine::initial_state>, {}, {}, {}};
    machine.states.assign(state_names.begin(), state_names.end());
    [&]<class... Es>(TypeList<Es...>) { (machine.events.push_back(name_of<Es>()), ...); }(Events{});
    [&]<class... Rs>(TypeList<Rs...>) {
      (machine.rows.push_back(
           {id<typename Rs::Source>, event_id<typename Rs::Evt>, id<typename Rs::Target>,
            detail::GuardName<typename Rs::Guard>::text(), name_of<typename Rs::Action>()}),
       ...);
    }(Rows{});
    return machine;
  }
};

}  // namespace stormproof::fsm
