// Which DDS profile each participant of a run has: one entry for each different one. Almost always
// there is a single one, and then nobody asks whose.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::model {

class Profiles {
 public:
  explicit Profiles(const Scenario& scenario) : different_{scenario.dds} {
    if (!is_mixed(scenario)) return;
    for (std::uint32_t i = 0; i < scenario.deployment.size(); ++i) {
      const DdsProfile& own = dds_of(scenario, i);
      const auto same = std::ranges::find(different_, own);
      number_of_.push_back(static_cast<std::uint32_t>(same - different_.begin()));
      if (same == different_.end()) different_.push_back(own);
    }
    number_of_.push_back(0);  // a Discovery Server, which is behind them
  }

  [[nodiscard]] bool are_mixed() const { return !number_of_.empty(); }
  /// The different ones; the scenario's own is the first.
  [[nodiscard]] const std::vector<DdsProfile>& different() const { return different_; }
  /// Which of them the participant has.
  [[nodiscard]] std::uint32_t number_of(std::uint32_t participant) const {
    return number_of_.empty() ? 0 : number_of_[participant];
  }
  [[nodiscard]] const DdsProfile& of(std::uint32_t participant) const {
    return different_[number_of(participant)];
  }

 private:
  std::vector<DdsProfile> different_;
  std::vector<std::uint32_t> number_of_;  // by participant; empty: all have the first
};

}  // namespace stormproof::model
