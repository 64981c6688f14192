// What the tables of hosts and access points cannot say: names that refer to each other, and what
// the stations of one access point have in common.
#include "model/config/knobs/host_knobs.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/ranges.h>

namespace stormproof::model::config {
namespace {

template <class Item>
std::optional<FleetFault> repeated_name(std::string_view list, const std::vector<Item>& items) {
  for (std::size_t k = 0; k < items.size(); ++k) {
    const auto before = items.begin() + static_cast<std::ptrdiff_t>(k);
    if (std::find_if(items.begin(), before,
                     [&](const Item& one) { return one.name == items[k].name; }) == before) {
      continue;
    }
    return FleetFault{list, k, name_key, "a name that no item before has"};
  }
  return std::nullopt;
}

std::string names_of(const std::vector<AccessPoint>& access_points) {
  std::vector<std::string> names;
  for (const AccessPoint& one : access_points) names.push_back(one.name);
  return fmt::format("one of {}", fmt::join(names, ", "));
}

/// An access point sends its beacons to all its stations at once.
std::optional<FleetFault> different_beacons(const Deployment& deployment) {
  std::map<std::string, PowerSave> beacons;
  for (std::size_t k = 0; k < deployment.hosts.size(); ++k) {
    const Host& host = deployment.hosts[k];
    if (!host.power_save) continue;
    const std::string first =
        deployment.access_points.empty() ? std::string{} : deployment.access_points.front().name;
    const auto [entry, is_new] =
        beacons.try_emplace(host.access_point.value_or(first), *host.power_save);
    if (is_new || entry->second == *host.power_save) continue;
    return FleetFault{hosts_key, k, power_save_key,
                      "what the other stations of its access point have that save power"};
  }
  return std::nullopt;
}

}  // namespace

std::optional<FleetFault> fault_of_fleet(const Deployment& deployment) {
  const auto& [hosts, points] = std::tie(deployment.hosts, deployment.access_points);
  if (auto fault = repeated_name(access_points_key, points)) return fault;
  if (auto fault = repeated_name(hosts_key, hosts)) return fault;
  if (hosts.empty() && !points.empty()) {
    return FleetFault{access_points_key, points.size(), {}, "a list of hosts beside it"};
  }
  for (const Participant& participant : deployment.participants) {
    if (hosts.empty() || participant.host.value < hosts.size()) continue;
    return FleetFault{hosts_key,
                      hosts.size(),
                      {},
                      fmt::format("a host {}, which a participant is on", participant.host.value)};
  }
  for (std::size_t k = 0; k < hosts.size(); ++k) {
    const auto& wanted = hosts[k].access_point;
    if (!wanted) continue;
    if (points.empty()) {
      return FleetFault{hosts_key, k, access_point_key, "no such key, or a list of access_points"};
    }
    if (std::ranges::find(points, *wanted, &AccessPoint::name) != points.end()) continue;
    return FleetFault{hosts_key, k, access_point_key, names_of(points)};
  }
  return different_beacons(deployment);
}

}  // namespace stormproof::model::config
