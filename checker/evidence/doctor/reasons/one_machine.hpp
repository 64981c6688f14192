// Identities of machines that DATA(p) carries (PID_MACHINE_ID).
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "checker/evidence/capture/events.hpp"

namespace stormproof::doctor {

/// Hosts that announce the identity of one machine. From 3.2 on Fast DDS takes them for one host;
/// with a list of interfaces it then sends the others nothing.
struct OneMachine {
  std::string identity;
  std::set<std::size_t> hosts;
};
[[nodiscard]] std::vector<OneMachine> one_machines(const capture::Topology& topology);

}  // namespace stormproof::doctor
