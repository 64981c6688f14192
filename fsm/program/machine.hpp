// Records a machine: its rows, with the guards and actions that have one body over any domain
// (fsm/domain.hpp) as terms over the fields of its input.
#pragma once

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>
#include <vector>

#include <boost/pfr.hpp>

#include "fsm/composition/outbox.hpp"
#include "fsm/composition/vocabulary.hpp"
#include "fsm/program/value.hpp"
#include "fsm/reflect.hpp"

namespace stormproof::fsm::program {

/// Visits the values of an aggregate, and of those in it, in their order. `Leaf`: their types.
template <class... Leaf, class Fields, class Visit>
void for_each_value(Fields& fields, Visit&& visit) {
  boost::pfr::for_each_field(fields, [&](auto& field) {
    using Field = std::remove_cvref_t<decltype(field)>;
    if constexpr ((std::is_same_v<Field, Leaf> || ...)) {
      visit(field);
    } else {
      for_each_value<Leaf...>(field, visit);
    }
  });
}

/// The sorts of the values of an input or an outbox, of which `Plain_` is the plain one.
template <class Plain_>
std::vector<Sort> sorts_of() {
  std::vector<Sort> sorts;
  const Plain_ plain{};
  for_each_value<bool, Plain::Int>(plain, [&]<class Field>(const Field&) {
    sorts.push_back(std::is_same_v<Field, bool> ? Sort::truth : Sort::number);
  });
  return sorts;
}

/// The values of an input or outbox. A number that nobody has set is 0.
template <class Fields>
std::vector<Ref> refs_of(const Fields& fields, const std::vector<Sort>& sorts) {
  std::vector<Ref> refs;
  const Ref unset = Value{false}.ref();
  for_each_value<Value>(fields, [&](const Value& value) {
    const bool is_unset = value.ref() == unset && sorts[refs.size()] == Sort::number;
    refs.push_back(is_unset ? Value{0}.ref() : value.ref());
  });
  return refs;
}

/// A guard that keeps the names of what it consists of.
template <class G>
struct GuardTerm {
  static Value of(const auto& input) {
    return Value::make(
        {.op = Op::named, .a = Value{G::template test<Terms>(input)}.ref(), .words = name_of<G>()});
  }
};
template <class G>
struct GuardTerm<Not<G>> {
  static Value of(const auto& input) { return !GuardTerm<G>::of(input); }
};
template <class... Gs>
struct GuardTerm<All<Gs...>> {
  static Value of(const auto& input) { return (GuardTerm<Gs>::of(input) && ...); }
};

/// The machine, with terms of the program that is being recorded.
template <class M>
Machine recorded_machine() {
  using Info = Reflect<M>;
  using Io = typename M::Io;
  const MachineInfo info = Info::info();
  Machine machine{.name = info.name,
                  .initial = info.initial,
                  .states = info.states,
                  .events = info.events,
                  .inputs = sorts_of<typename Io::template Input<Plain>>(),
                  .outputs = {},
                  .rows = {}};
  const std::vector<Sort> outputs = sorts_of<typename Io::template Output<Plain>>();
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    machine.outputs.push_back({composition::outbox_names<Io>[k], outputs[k]});
  }
  typename Io::template Input<Terms> input;
  std::int64_t k = 0;
  for_each_value<Value>(
      input, [&](Value& value) { value = Value::make({.op = Op::input, .value = k++}); });
  const std::array nothing{Value{false}.ref(), Value{0}.ref()};
  composition::for_each_type(typename Info::Rows{}, [&]<class R>() {
    Machine::Row row{.source = Info::template id<typename R::Source>,
                     .event = Info::template event_id<typename R::Evt>,
                     .target = Info::template id<typename R::Target>,
                     .guard = no_term,
                     .negated = false,
                     .out = {}};
    if constexpr (!std::is_same_v<typename R::Guard, none>) {
      row.guard = GuardTerm<typename R::Guard>::of(input).ref();
    }
    typename Io::template Output<Terms> output;
    if constexpr (!std::is_same_v<typename R::Action, none>) {
      R::Action::template act<Terms>(input, output);
    }
    row.out = refs_of(output, outputs);
    for (const Ref unset : nothing) std::ranges::replace(row.out, unset, no_term);
    machine.rows.push_back(std::move(row));
  });
  return machine;
}

}  // namespace stormproof::fsm::program
