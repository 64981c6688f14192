// Steps the machines of one kind, with Boost.MSM; or, if there is a deliberate mistake in their
// table (fsm/table_mutation.hpp), with the interpreter of the mutated one. Whoever runs machines
// runs them through here: the simulator, the explorer, the monitors that follow a run, and the
// replay of captures.
//
// An event of which a machine reads nothing but truth values has few different steps. Each of them
// is taken once and remembered: from then on it costs a look into a table of a few hundred bytes,
// and a correct table costs no more than a mutated one. (A mutated row keeps its event, so what an
// event reads stays the same.) Where a table has no row for an event, nothing happens, and nobody
// has to be asked.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <utility>

#include <boost/pfr.hpp>

#include "fsm/flyweight.hpp"
#include "fsm/row_table.hpp"

namespace stormproof::fsm {

namespace detail {
/// Whether a guard or an action reads nothing but truth values.
template <class T>
inline constexpr bool reads_truths =
    std::same_as<T, none> || std::derived_from<T, Holds<T>> || std::derived_from<T, Sets<T>>;
template <class G>
inline constexpr bool reads_truths<Not<G>> = reads_truths<G>;
template <class... Gs>
inline constexpr bool reads_truths<All<Gs...>> = (reads_truths<Gs> && ...);

/// A machine's input: which of its fields are truth values.
template <class Input>
inline constexpr auto truth_fields = []<std::size_t... I>(std::index_sequence<I...>) {
  return std::array<bool, sizeof...(I)>{
      std::same_as<boost::pfr::tuple_element_t<I, Input>, bool>...};
}
(std::make_index_sequence<boost::pfr::tuple_size_v<Input>>{});

/// How the rows of a machine take an event.
template <class Machine, class Event>
struct Taken {
  using Info = Reflect<Machine>;
  using Input = typename Machine::Io::template Input<Plain>;

  /// Whether they read nothing but truth values.
  static constexpr bool by_truths = []<class... Rs>(TypeList<Rs...>) {
    const bool all = std::ranges::all_of(truth_fields<Input>, std::identity{});
    return all || ((!std::same_as<typename Rs::Evt, Event> ||
                    (reads_truths<typename Rs::Guard> && reads_truths<typename Rs::Action>)) &&
                   ...);
  }(typename Info::Rows{});

  /// The states that have a row for it.
  static constexpr auto states = []<class... Rs>(TypeList<Rs...>) {
    std::array<bool, Info::state_count> some{};
    ((std::same_as<typename Rs::Evt, Event>
          ? void(some[Info::template id<typename Rs::Source>] = true)
          : void()),
     ...);
    return some;
  }(typename Info::Rows{});
};
}  // namespace detail

/// Whether the machine has few different steps on the event: one for each state and some truth
/// values.
template <class Machine, class Event>
concept IsFinite =
    (std::ranges::count(detail::truth_fields<typename Machine::Io::template Input<Plain>>, true) <=
     4) &&
    detail::Taken<Machine, Event>::by_truths;

template <class Machine>
class Stepper {
 public:
  using Input = typename Flyweight<Machine>::Input;
  using Output = typename Flyweight<Machine>::Output;

  static constexpr StateId initial = Flyweight<Machine>::initial;

  /// Mutations of other machines' tables may be among them.
  explicit Stepper(std::span<const TableMutation> mutations = {}) {
    const bool concerned = std::ranges::any_of(mutations, [](const TableMutation& mutation) {
      return mutation.machine == name_of<Machine>();
    });
    if (concerned) mutated_ = std::make_unique<const TableInterpreter<Machine>>(mutations);
  }

  /// One step of a machine in `state`, which becomes the state after it. `row` receives the row
  /// that fired: `no_row` if none did.
  template <class Event>
  Output step(StateId& state, const Input& input, RowId& row) {
    if constexpr (IsFinite<Machine, Event>) {
      Step& step = steps_[place<Event>(state, input)];
      if (!step.known) [[unlikely]] {
        step.after = state;
        step.output = take<Event>(step.after, input, step.row);
        step.known = true;
      }
      state = step.after;
      row = step.row;
      return step.output;
    } else {
      if (!detail::Taken<Machine, Event>::states[state] && mutated_ == nullptr) {
        row = no_row;
        return {};
      }
      return take<Event>(state, input, row);
    }
  }
  template <class Event>
  Output step(StateId& state, const Input& input = {}) {
    RowId row = no_row;
    return step<Event>(state, input, row);
  }

 private:
  struct Step {
    Output output{};
    StateId after{};
    RowId row = no_row;
    bool known = false;
  };
  static constexpr auto truths = detail::truth_fields<Input>;
  static constexpr std::size_t step_count() {
    const auto count = static_cast<std::size_t>(std::ranges::count(truths, true));
    return count > 4 ? 0
                     : (Reflect<Machine>::Events::size * Reflect<Machine>::state_count) << count;
  }

  /// The place with a field of the input: only truth values decide.
  template <class Field>
  static std::size_t with(std::size_t place, const Field& field) {
    if constexpr (std::same_as<Field, bool>) place = place << 1 | (field ? 1U : 0U);
    return place;
  }
  template <class Event>
  static std::size_t place(StateId state, const Input& input) {
    constexpr std::size_t event = Reflect<Machine>::template event_id<Event>;
    std::size_t place = event * Reflect<Machine>::state_count + state;
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      ((place = with(place, boost::pfr::get<I>(input))), ...);
    }
    (std::make_index_sequence<truths.size()>{});
    return place;
  }

  template <class Event>
  [[gnu::noinline]] Output take(StateId& state, const Input& input, RowId& row) {
    Output output{};
    if (mutated_ != nullptr) [[unlikely]] {
      constexpr std::uint8_t event = Reflect<Machine>::template event_id<Event>;
      const StepResult result = mutated_->step(state, event, input, output);
      state = result.state;
      row = result.row;
    } else {
      state = engine_.template step<Event>(state, input, output, row);
    }
    return output;
  }

  Flyweight<Machine> engine_;
  std::unique_ptr<const TableInterpreter<Machine>> mutated_;  // in place of MSM, if any
  std::array<Step, step_count()> steps_{};
};

}  // namespace stormproof::fsm
