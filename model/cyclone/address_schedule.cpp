// Keeps what each participant knows of each address.
#include "model/cyclone/address_schedule.hpp"

#include <algorithm>
#include <map>

#include "model/cyclone/life_periods.hpp"
#include "model/cyclone/packer.hpp"

namespace stormproof::model::cyclone {

AddressSchedule::Rules::Rules(const DdsProfile& dds)
    : initial_delay{dds.spdp.initial_prune_delay.value_or(Nanoseconds{}).count()},
      discovered_delay{dds.spdp.discovered_prune_delay.value_or(Nanoseconds{}).count()},
      has_group{dds.allow_multicast != AllowMulticast::never},
      only_group{dds.allow_multicast == AllowMulticast::always},
      prunes{cyclone::prunes(dds)},
      interval{said_interval(dds).value_or(usual_interval).count()} {}

AddressSchedule::AddressSchedule(const Scenario& scenario)
    : participants_{scenario.deployment.size()}, addresses_(participants_) {
  // The k-th participant of a host has its k-th port.
  std::map<HostId, std::uint32_t> on_host;
  std::vector<std::uint32_t> port_of;  // by address
  std::uint32_t most = 0;
  for (Number i = 0; i < participants_; ++i) {
    const DdsProfile& dds = dds_of(scenario, i);
    rules_.emplace_back(dds);
    if (!rules_[i].only_group) most = std::max(most, dds.peers);
    port_of.push_back(on_host[scenario.deployment.participants[i].host]++);
  }
  for (const auto& [host, count] : on_host) {
    for (std::uint32_t port = count; port < most; ++port) {
      ports_.push_back(host);
      port_of.push_back(port);
    }
  }
  for (Number i = 0; i < participants_; ++i) {
    if (rules_[i].only_group) continue;
    addresses_[i].resize(port_of.size());
    for (Number a = 0; a < port_of.size(); ++a) {
      if (a == i) continue;
      Address& address = addresses_[i][a];
      address.is_peer = port_of[a] < dds_of(scenario, i).peers;
      if (address.is_peer && !rules_[i].prunes) address.state = State::live;
    }
  }
}

void AddressSchedule::start(Number i, std::int64_t now) {
  const Rules& rules = rules_[i];
  if (!rules.prunes || rules.only_group) return;
  for (Address& address : addresses_[i]) {
    if (!address.is_peer) continue;
    address.prune = now + rules.initial_delay;
    if (address.state == State::live) continue;
    address.state = State::ageing;
    address.next = now + rules.interval;
  }
}

void AddressSchedule::recognised(Number i, Number other) {
  if (!rules_[i].only_group) addresses_[i][other].state = State::live;
}

void AddressSchedule::lease_ended(Number i, Number other, std::int64_t now) {
  const Rules& rules = rules_[i];
  if (rules.prunes && !rules.only_group) let_age(rules, addresses_[i][other], now);
}

void AddressSchedule::said_goodbye(Number i, Number other, std::int64_t now) {
  const Rules& rules = rules_[i];
  if (!rules.prunes || rules.only_group) return;
  Address& address = addresses_[i][other];
  if (address.is_peer && address.prune > now) return let_age(rules, address, now);
  address.state = State::unknown;
}

void AddressSchedule::let_age(const Rules& rules, Address& address, std::int64_t now) {
  address.state = State::ageing;
  address.prune = std::max(address.prune, now + rules.discovered_delay);
  address.next = now + rules.interval;
}

std::vector<AddressSchedule::Number> AddressSchedule::of_announcement(Number i, bool all) const {
  std::vector<Number> addresses;
  if (rules_[i].has_group) addresses.push_back(group);
  for (Number a = 0; a < addresses_[i].size(); ++a) {
    const State state = addresses_[i][a].state;
    if (state == State::live || (all && state == State::ageing)) addresses.push_back(a);
  }
  return addresses;
}

std::int64_t AddressSchedule::next(Number i) const {
  std::int64_t next = 0;
  for (const Address& address : addresses_[i]) {
    if (address.state != State::ageing) continue;
    const std::int64_t due = std::min(address.next, address.prune);
    next = next == 0 ? due : std::min(next, due);
  }
  return next;
}

std::vector<AddressSchedule::Number> AddressSchedule::age(Number i, std::int64_t now) {
  std::vector<Number> addresses;
  for (Number a = 0; a < addresses_[i].size(); ++a) {
    Address& address = addresses_[i][a];
    if (address.state != State::ageing || std::min(address.next, address.prune) > now) continue;
    if (address.prune <= now) {
      address.state = State::unknown;
    } else {
      address.next = now + rules_[i].interval;
      addresses.push_back(a);
    }
  }
  return addresses;
}

}  // namespace stormproof::model::cyclone
