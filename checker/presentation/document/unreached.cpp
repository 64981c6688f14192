// Static peers ask the first ports of each host (model/fastdds/peer_ports.hpp).
#include "checker/presentation/document/unreached.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "checker/presentation/text/numbers.hpp"
#include "model/fastdds/peer_ports.hpp"

namespace stormproof::report {

std::string unreached(const model::Scenario& scenario) {
  const std::vector<bool> reached = model::fastdds::reached_by_announcements(scenario);
  const auto left_out = static_cast<std::uint64_t>(std::ranges::count(reached, false));
  if (left_out == 0) return {};
  const std::uint32_t ports = scenario.dds.peer_ports;
  return fmt::format(
      "Announcements go to {} of each host (dds.peer_ports), so {} of {} are at none that is "
      "asked: process {} of a host is announced to by nobody, and two of its kind on different "
      "hosts never find each other. maxInitialPeersRange of the transport raises it.",
      plural(ports, "port"), plural(left_out, "participant"), reached.size(), ports + 1);
}

}  // namespace stormproof::report
