// Lists of the things that a composition declares (fsm/composition/vocabulary.hpp): what a store
// keeps, and which of them a layer of a host has that the layers below do not have.
#pragma once

#include <cstdint>
#include <type_traits>

#include "fsm/composition/vocabulary.hpp"

namespace stormproof::model {

namespace comp = fsm::composition;

/// What a thing is.
template <class T>
concept IsMachine = requires {
  typename T::Machine;
};
template <class T>
concept IsFlag = requires {
  typename T::IsFlag;
};
template <class T>
concept IsNumber = requires {
  typename T::IsNumber;
};
template <class T>
concept IsTimer = requires {
  T::counted;
};
/// Each descriptor has one.
template <class T>
inline constexpr bool is_of_descriptors = (T::owner.indices & comp::owner::descriptor_index) != 0;
/// The owner of a thing; of a thing of descriptors, their relation or writer.
template <class T>
inline constexpr comp::Owner owner_of_row{
    static_cast<std::uint8_t>(T::owner.indices & ~comp::owner::descriptor_index)};

namespace detail {
template <class T, class... Ts>
constexpr bool is_listed(fsm::TypeList<Ts...>) {
  return (std::is_same_v<T, Ts> || ...);
}
template <class Keep, class... Ts>
auto filtered(fsm::TypeList<Ts...>) -> typename comp::JoinedLists<
    std::conditional_t<Keep::template holds<Ts>, fsm::TypeList<Ts>, fsm::TypeList<>>...>::type;
template <class List>
struct NotIn {
  template <class T>
  static constexpr bool holds = !is_listed<T>(List{});
};
}  // namespace detail

/// Those of a list for which `Keep::holds<T>` is true.
template <class List, class Keep>
using Filtered = decltype(detail::filtered<Keep>(List{}));
/// Those of a list that are not in the other.
template <class List, class Other>
using Without = Filtered<List, detail::NotIn<Other>>;
/// All that the composition declares to exist.
template <class C>
using ThingsOf = comp::Joined<typename C::Parts, typename C::State, typename C::Timers>;
/// What it declares beside what the layers of a host up to `Base` have.
template <class C, class Base>
using ThingsBeside = Without<ThingsOf<C>, typename Base::OwnThings>;

}  // namespace stormproof::model
