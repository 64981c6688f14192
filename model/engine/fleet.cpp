// Turns names into numbers.
#include "model/engine/fleet.hpp"

#include <algorithm>

#include "model/life.hpp"
#include "model/servers.hpp"

namespace stormproof::model {

Fleet::Fleet(const Scenario& scenario) : is_listed_{!scenario.deployment.hosts.empty()} {
  const Deployment& deployment = scenario.deployment;
  std::uint32_t most = 0;
  for (std::uint32_t i = 0; i < deployment.size() + server_count(deployment); ++i) {
    hosts_.push_back(model::host_of(deployment, i).value);
    most = std::max(most, hosts_.back());
  }
  take_access_points(deployment);
  for (const Host& host : deployment.hosts) take_host(deployment, host);
  all_.resize(std::max<std::size_t>(all_.size(), std::size_t{most} + 1));
}

void Fleet::take_access_points(const Deployment& deployment) {
  for (const AccessPoint& point : deployment.access_points) {
    const auto name = std::ranges::find(names_, point.channel);
    radios_.push_back(static_cast<std::uint32_t>(name - names_.begin()));
    if (name == names_.end()) names_.push_back(point.channel);
  }
  if (radios_.empty()) {
    radios_.push_back(0);
    names_.emplace_back();
  }
  group_interval_.resize(radios_.size());
}

void Fleet::take_host(const Deployment& deployment, const Host& host) {
  One one;
  one.wired = host.link == Link::wired;
  one.rate = host.rate;
  if (host.access_point) {
    const auto point =
        std::ranges::find(deployment.access_points, *host.access_point, &AccessPoint::name);
    one.access_point = static_cast<std::uint32_t>(point - deployment.access_points.begin());
  }
  if (host.power_save) {
    one.beacon_interval = host.power_save->beacon_interval;
    group_interval_[one.access_point] = one.beacon_interval * host.power_save->dtim;
  }
  all_.push_back(one);
}

Nanoseconds Fleet::awake(std::uint32_t host, Nanoseconds now) const {
  return next_multiple(now, all_[host].beacon_interval);
}

Nanoseconds Fleet::next_multiple(Nanoseconds now, Nanoseconds interval) {
  if (interval.count() == 0) return now;
  const std::int64_t beacons = (now.count() + interval.count() - 1) / interval.count();
  return interval * beacons;
}

}  // namespace stormproof::model
