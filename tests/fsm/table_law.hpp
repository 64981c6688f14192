// The law of the interpreted table: unmutated, it does on every (state, event, input) exactly what
// Boost.MSM does, so that what is proved or mutated over reflected rows is about the machine that
// runs. The surveys count where it does not.
#pragma once

#include <boost/pfr.hpp>

#include "fsm/flyweight.hpp"
#include "fsm/row_table.hpp"

namespace stormproof::fsm {

/// Whether both engines go to the same state and ask for the same.
template <class Machine, class Event>
bool interpreter_agrees(const TableInterpreter<Machine>& table, Flyweight<Machine>& msm,
                        StateId state, const typename Flyweight<Machine>::Input& input) {
  typename Flyweight<Machine>::Output of_msm{};
  typename Flyweight<Machine>::Output of_table{};
  const StateId after = msm.template step<Event>(state, input, of_msm);
  const StepResult result =
      table.step(state, Reflect<Machine>::template event_id<Event>, input, of_table);
  return result.state == after && boost::pfr::eq_fields(of_msm, of_table);
}

}  // namespace stormproof::fsm
