// Whose a machine is, and what it is called: the numbers of `MachineRef` in participants.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "model/fastdds/control.hpp"
#include "model/probe.hpp"
#include "model/scenario.hpp"

namespace stormproof::page {

class MachineOwners {
 public:
  explicit MachineOwners(const model::Scenario& scenario) : scenario_{scenario} {}

  void run_started(const model::Topology& topology);

  /// Whether the machine stands between the participant and another, or is its own.
  [[nodiscard]] bool owns(std::uint32_t participant, const model::MachineRef& machine) const;
  /// "relation 3→7, publications", "participant 3", "channel 0".
  [[nodiscard]] std::string words_of(const model::MachineRef& machine) const;

 private:
  /// The writer's side and the reader's, twice the same if there is one.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> ends_of(
      const model::MachineRef& machine) const;

  const model::Scenario& scenario_;
  const model::Topology* topology_ = nullptr;
  std::uint32_t stride_ = 1;
  std::unique_ptr<model::fastdds::ControlRelations> control_;  // if there are any
};

}  // namespace stormproof::page
