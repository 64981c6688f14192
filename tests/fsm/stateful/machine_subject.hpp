// A machine as the subject of a stateful test: executed by Boost.MSM, or by the interpreted table
// if there is a mistake in it.
#pragma once

#include <span>
#include <utility>

#include "fsm/stepper.hpp"
#include "tests/fsm/stateful/reactor.hpp"

namespace stormproof::fsm::stateful {

using namespace stormproof::stateful;

using Mutations = std::span<const TableMutation>;

struct MachineSubject : Subject {
  std::string machine;  ///< `MachineInfo::name`
  /// The machine, with these mistakes in its table.
  std::function<std::unique_ptr<Reactor>(Mutations)> under_test;
};

[[nodiscard]] inline MachineSubject machine_subject(
    std::string name, std::string machine, std::vector<EventShape> events,
    std::function<std::unique_ptr<Model>()> model,
    std::function<std::unique_ptr<Reactor>(Mutations)> under_test) {
  return {{std::move(name), std::move(events), std::move(model)},
          std::move(machine),
          std::move(under_test)};
}

/// Executes a machine, and names its states.
template <class Machine>
struct Stepper : fsm::Stepper<Machine> {
  using fsm::Stepper<Machine>::Stepper;

  static std::string name(StateId state) {
    return std::string{Reflect<Machine>::state_names[state]};
  }
};

/// The subjects, each list from the file that has the machines.
[[nodiscard]] std::vector<MachineSubject> repair_subjects();
[[nodiscard]] std::vector<MachineSubject> reader_subjects();
[[nodiscard]] MachineSubject adaptive_subject();
[[nodiscard]] MachineSubject change_subject();
[[nodiscard]] std::vector<MachineSubject> timer_subjects();
[[nodiscard]] std::vector<MachineSubject> channel_subjects();
[[nodiscard]] MachineSubject cautious_subject();
[[nodiscard]] std::vector<MachineSubject> pacer_subjects();
[[nodiscard]] std::vector<MachineSubject> thread_subjects();

}  // namespace stormproof::fsm::stateful
