// Changes to a simulated capture that conforms, one or more for each kind of fault, and the event
// at which each is to be found.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "checker/evidence/conform/conform.hpp"
#include "model/scenario.hpp"
#include "tests/checker/evidence/conform/edits.hpp"

namespace stormproof::conform::testing {

/// Participants on hosts of their own, created from 2 ms on one after the other; every packet takes
/// 1 ms, and the run goes on after discovery. Three participants send HEARTBEATs with their DATA.
[[nodiscard]] model::Scenario quiet(std::uint32_t participants,
                                    std::vector<std::uint64_t> lost = {});

/// With a Discovery Server alone on its host, and three clients on hosts of their own, the last of
/// which comes 0.7 s later; otherwise as `quiet`.
[[nodiscard]] model::Scenario served(model::Discovery discovery,
                                     std::vector<std::uint64_t> lost = {});

struct Case {
  Fault fault{};
  std::string name{};
  /// Changes the capture and returns the event that is wrong then.
  std::function<std::size_t(Conversation&)> change{};
  std::string need{};  ///< the first one; empty: none
  std::uint32_t participants = 2;
  bool may_lose = true;
  std::vector<std::uint64_t> lost_packets{};
  bool has_server = false;
};

inline std::ostream& operator<<(std::ostream& out, const Case& one) { return out << one.name; }

[[nodiscard]] std::vector<Case> all_cases();

}  // namespace stormproof::conform::testing
