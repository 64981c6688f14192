// What a tag of the rules is, as a thing of a program: its kind, its owner and its names. What
// takes recording (a machine, a definition, the fields of a packet) is the recorder's.
#pragma once

#include <concepts>

#include "fsm/composition/first_value.hpp"
#include "fsm/composition/vocabulary.hpp"
#include "fsm/program/program.hpp"

namespace stormproof::fsm::program {

template <class T>
Thing thing_of() {
  using Kind = Thing::Kind;
  using namespace composition;
  Thing thing{.name = name_of<T>(), .full_name = full_name_of<T>()};
  if constexpr (requires { T::owner; }) thing.owner = T::owner;
  if constexpr (requires { typename T::Machine; }) {
    thing.kind = Kind::part;
  } else if constexpr (requires { T::counted; }) {
    thing.kind = Kind::timer;
    thing.counted = T::counted;
  } else if constexpr (requires { typename T::IsFlag; }) {
    thing.kind = Kind::flag;
    thing.first = first_value<T>();
  } else if constexpr (requires { typename T::IsNumber; }) {
    thing.kind = Kind::number;
    thing.first = first_value<T>();
  } else if constexpr (requires { typename T::Fields; }) {
    thing.kind = Kind::packet;
  } else if constexpr (std::derived_from<T, Fact>) {
    thing.kind = Kind::fact;
  } else if constexpr (std::derived_from<T, Switch>) {
    thing.kind = Kind::toggle;
  } else if constexpr (std::derived_from<T, Delay>) {
    thing.kind = Kind::delay;
  } else if constexpr (std::derived_from<T, Answer>) {
    thing.kind = Kind::answer;
  } else if constexpr (std::derived_from<T, Amount>) {
    thing.kind = Kind::amount;
  } else if constexpr (std::derived_from<T, DescriptorField>) {
    thing.kind = Kind::descriptor_field;
  } else if constexpr (std::derived_from<T, PacketField>) {
    thing.kind = Kind::packet_field;
  } else if constexpr (std::derived_from<T, PacketNumber>) {
    thing.kind = Kind::packet_number;
  } else if constexpr (std::derived_from<T, composition::Procedure>) {
    thing.kind = Kind::procedure;
  } else if constexpr (std::derived_from<T, Opaque>) {
    thing.kind = Kind::opaque;
  } else {
    static_assert(
        requires { T::owner; }, "what is it?");
    thing.kind = Kind::occasion;
  }
  return thing;
}

}  // namespace stormproof::fsm::program
