// What a machine does on every (state, event, input) of an enumeration, found by evaluating the
// guards of its reflected rows, by letting Boost.MSM process the same event and by interpreting the
// table. It exists so that totality, determinism, reachability and the agreement of the three are
// one loop and a few questions.
// The result is plain data, so that each machine's template code is compiled once, in the file of
// its inputs (tests/fsm/surveys).
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <boost/pfr.hpp>

#include "fsm/msm.hpp"
#include "fsm/reflect.hpp"
#include "tests/fsm/flyweight_law.hpp"
#include "tests/fsm/table_law.hpp"

namespace stormproof::fsm {

/// Findings about one (state, event) pair, over all inputs of the enumeration.
struct PairSurvey {
  StateId state = 0;
  std::uint8_t event = 0;
  bool has_row = false;
  std::uint64_t inputs = 0;
  std::uint64_t none_enabled = 0;     ///< inputs on which no row is enabled
  std::uint64_t several_enabled = 0;  ///< inputs on which two rows or more are enabled
  std::uint64_t disagreements = 0;    ///< inputs on which MSM did not do what the enabled row says
  std::uint64_t interpreted_otherwise = 0;  ///< inputs on which the interpreted table differs
};

struct MachineSurvey {
  MachineInfo info;
  std::function<void()> flyweight_law;         ///< to be checked by RapidCheck
  std::vector<PairSurvey> pairs;               ///< every state with every event
  std::vector<std::uint64_t> enabled_by_row;   ///< inputs on which the row is enabled in its state
  std::vector<std::uint64_t> rejected_by_row;  ///< inputs on which its guard is false
  std::set<StateId> reached;                   ///< from the initial state, over enabled rows
  std::vector<int> msm_ids;                    ///< MSM's own number of each state, by our number
};

template <class Guard, class Input>
bool enabled(const Input& input) {
  if constexpr (std::is_same_v<Guard, none>)
    return true;
  else
    return Guard::template test<Plain>(input);
}

template <class Machine>
using Inputs = std::vector<typename Flyweight<Machine>::Input>;

template <class Machine>
class Surveyor {
 public:
  using Info = Reflect<Machine>;
  using Input = typename Flyweight<Machine>::Input;
  using Output = typename Flyweight<Machine>::Output;

  explicit Surveyor(Inputs<Machine> inputs) : inputs_{std::move(inputs)} {}

  MachineSurvey run() {
    result_.info = Info::info();
    result_.flyweight_law = [inputs = inputs_] { FlyweightLaw<Machine>::check(inputs); };
    result_.enabled_by_row.assign(result_.info.rows.size(), 0);
    result_.rejected_by_row.assign(result_.info.rows.size(), 0);
    for (StateId state = 0; state < Info::state_count; ++state) {
      visit_events(state, typename Info::Events{});
    }
    close_reached();
    list_msm_ids(typename Info::States{});
    return std::move(result_);
  }

 private:
  /// What the rows say about one event.
  struct Expectation {
    int rows = 0;
    StateId target = 0;
    Output output{};
  };

  template <class... Events>
  void visit_events(StateId state, TypeList<Events...>) {
    (visit<Events>(state), ...);
  }

  template <class Event>
  void visit(StateId state) {
    PairSurvey pair;
    pair.state = state;
    pair.event = Info::template event_id<Event>;
    for (const Input& input : inputs_) {
      Expectation expected;
      expected.target = state;
      std::size_t row = 0;
      apply_rows<Event>(state, input, expected, pair, row, typename Info::Rows{});
      ++pair.inputs;
      pair.none_enabled += expected.rows == 0 ? 1 : 0;
      pair.several_enabled += expected.rows > 1 ? 1 : 0;
      Output output{};
      const StateId after = engine_.template step<Event>(state, input, output);
      const bool same = after == expected.target && boost::pfr::eq_fields(output, expected.output);
      pair.disagreements += same ? 0 : 1;
      const bool agrees = interpreter_agrees<Machine, Event>(table_, engine_, state, input);
      pair.interpreted_otherwise += agrees ? 0 : 1;
    }
    result_.pairs.push_back(pair);
  }

  template <class Event, class... Rows>
  void apply_rows(StateId state, const Input& input, Expectation& expected, PairSurvey& pair,
                  std::size_t& row, TypeList<Rows...>) {
    (apply_row<Event, Rows>(state, input, expected, pair, row++), ...);
  }

  template <class Event, class Row>
  void apply_row(StateId state, const Input& input, Expectation& expected, PairSurvey& pair,
                 std::size_t row) {
    if constexpr (std::is_same_v<Event, typename Row::Evt>) {
      if (state != Info::template id<typename Row::Source>) return;
      pair.has_row = true;
      if (!enabled<typename Row::Guard>(input)) {
        ++result_.rejected_by_row[row];
        return;
      }
      ++result_.enabled_by_row[row];
      ++expected.rows;
      expected.target = Info::template id<typename Row::Target>;
      expected.output = Output{};
      if constexpr (!std::is_same_v<typename Row::Action, none>) {
        Row::Action::template act<Plain>(input, expected.output);
      }
    }
  }

  void close_reached() {
    result_.reached.insert(result_.info.initial);
    for (std::size_t round = 0; round < Info::state_count; ++round) {
      for (std::size_t row = 0; row < result_.info.rows.size(); ++row) {
        const RowInfo& info = result_.info.rows[row];
        const bool usable =
            result_.reached.contains(info.source) && result_.enabled_by_row[row] > 0;
        if (usable) result_.reached.insert(info.target);
      }
    }
  }

  template <class... States>
  void list_msm_ids(TypeList<States...>) {
    using Stt = typename BackEnd<Machine>::stt;
    result_.msm_ids = {boost::msm::back::get_state_id<Stt, States>::value...};
  }

  Inputs<Machine> inputs_;
  Flyweight<Machine> engine_;
  TableInterpreter<Machine> table_;
  MachineSurvey result_;
};

template <class Machine>
MachineSurvey survey(Inputs<Machine> inputs) {
  return Surveyor<Machine>{std::move(inputs)}.run();
}

/// The machines' surveys, each compiled in a file of its machine, which lists inputs.
MachineSurvey survey_descriptor_repair();
MachineSurvey survey_discovery_reader();
MachineSurvey survey_heartbeat_timer();
MachineSurvey survey_initial_acknack();
MachineSurvey survey_announcer();
MachineSurvey survey_channel();
MachineSurvey survey_change_for_reader();
MachineSurvey survey_single_shot();
MachineSurvey survey_control_writer();
MachineSurvey survey_control_reader();
MachineSurvey survey_cautious_reader();
MachineSurvey survey_matched_reader();
MachineSurvey survey_heartbeat_pacer();
MachineSurvey survey_event_thread();
MachineSurvey survey_movable_timer();
MachineSurvey survey_reopening_repair();

/// All of them, in the order of `machines()`.
[[nodiscard]] std::vector<MachineSurvey> all_surveys();

}  // namespace stormproof::fsm
