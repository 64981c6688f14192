// Static peers (`discovery: static`): there is no group, announcements go to the first `peer_ports`
// ports of each host, and the k-th participant of a host has its k-th port.
// specs/guide/discovery-server.md, "Static peers".
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "model/scenario.hpp"

namespace stormproof::model::fastdds {

/// The participants of each host, ascending: the k-th has port k.
[[nodiscard]] std::map<HostId, std::vector<std::uint32_t>> participants_at_ports(
    const Deployment& deployment);

/// By participant: whether announcements to everybody reach it. All are, unless peers are static.
[[nodiscard]] std::vector<bool> reached_by_announcements(const Scenario& scenario);
/// Whether they reach everybody.
[[nodiscard]] bool announcements_reach_all(const Scenario& scenario);

}  // namespace stormproof::model::fastdds
