// The law of the flyweight: one shared MSM object that steps many machines by their stored numbers
// does for each of them exactly what an MSM object of its own would do, whatever the order of
// events; and so does a stepper, whatever it remembers of the steps before.
#pragma once

#include <memory>
#include <vector>

#include <boost/pfr.hpp>
#include <rapidcheck.h>

#include "fsm/msm.hpp"
#include "fsm/stepper.hpp"

namespace stormproof::fsm {

/// One event of a random sequence: for which machine, which event, with which of the known inputs.
struct RandomEvent {
  std::size_t machine;
  std::size_t event;
  std::size_t input;
};

template <class Machine>
class FlyweightLaw {
 public:
  using Info = Reflect<Machine>;
  using Input = typename Flyweight<Machine>::Input;
  using Output = typename Flyweight<Machine>::Output;
  static constexpr std::size_t machine_count = 3;

  explicit FlyweightLaw(const std::vector<Input>& inputs) : inputs_{inputs} {
    for (std::size_t k = 0; k < machine_count; ++k) {
      states_.push_back(Flyweight<Machine>::initial);
      own_.push_back(std::make_unique<BackEnd<Machine>>());
      own_.back()->start();
    }
  }

  void process(const RandomEvent& random) { dispatch(random, typename Info::Events{}); }

  /// For use with rc::prop: random sequences over `inputs`.
  static void check(const std::vector<Input>& inputs) {
    FlyweightLaw law{inputs};
    const auto index = [](std::size_t count) { return rc::gen::inRange<std::size_t>(0, count); };
    const auto one = rc::gen::construct<RandomEvent>(
        index(machine_count), index(Info::Events::size), index(inputs.size()));
    for (const RandomEvent& random : *rc::gen::container<std::vector<RandomEvent>>(one)) {
      law.process(random);
    }
  }

 private:
  template <class... Events>
  void dispatch(const RandomEvent& random, TypeList<Events...>) {
    ((random.event == Info::template event_id<Events> ? step<Events>(random) : void()), ...);
  }

  template <class Event>
  void step(const RandomEvent& random) {
    const Input& input = inputs_[random.input];
    Output shared{};
    Output own{};
    StateId& state = states_[random.machine];
    StateId stepped = state;
    const Output of_stepper = stepper_.template step<Event>(stepped, input);
    state = engine_.template step<Event>(state, input, shared);
    own_[random.machine]->process_event(Event{{input, own}});
    RC_ASSERT(static_cast<int>(state) == own_[random.machine]->current_state()[0]);
    RC_ASSERT(boost::pfr::eq_fields(shared, own));
    RC_ASSERT(stepped == state);
    RC_ASSERT(boost::pfr::eq_fields(of_stepper, own));
  }

  const std::vector<Input>& inputs_;
  Flyweight<Machine> engine_;
  Stepper<Machine> stepper_;
  std::vector<StateId> states_;
  std::vector<std::unique_ptr<BackEnd<Machine>>> own_;
};

inline void showValue(const RandomEvent& random, std::ostream& out) {
  out << "machine " << random.machine << ", event " << random.event << ", input " << random.input;
}

}  // namespace stormproof::fsm
