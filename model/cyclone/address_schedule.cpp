// Keeps what each participant knows of each address.
#include "model/cyclone/address_schedule.hpp"

#include <algorithm>
#include <map>

#include "model/cyclone/life_periods.hpp"
#include "model/cyclone/packer.hpp"

namespace stormproof::model::cyclone {

AddressSchedule::AddressSchedule(const Scenario& scenario)
    : dds_{scenario.dds},
      participants_{scenario.deployment.size()},
      has_group_{dds_.allow_multicast != AllowMulticast::never},
      only_group_{dds_.allow_multicast == AllowMulticast::always},
      prunes_{prunes(dds_)},
      interval_{said_interval(dds_).value_or(usual_interval).count()} {
  addresses_.resize(participants_);
  if (only_group_) return;
  // The k-th participant of a host has its k-th port.
  std::map<HostId, std::uint32_t> on_host;
  std::vector<bool> is_peer(participants_);
  for (Number i = 0; i < participants_; ++i) {
    is_peer[i] = on_host[scenario.deployment.participants[i].host]++ < dds_.peers;
  }
  for (const auto& [host, count] : on_host) {
    for (std::uint32_t port = count; port < dds_.peers; ++port) ports_.push_back(host);
  }
  const std::size_t all = participants_ + ports_.size();
  for (Number i = 0; i < participants_; ++i) {
    addresses_[i].resize(all);
    for (Number a = 0; a < all; ++a) {
      if (a == i) continue;
      Address& address = addresses_[i][a];
      address.is_peer = is_port(a) || is_peer[a];
      if (address.is_peer && !prunes_) address.state = State::live;
    }
  }
}

void AddressSchedule::start(Number i, std::int64_t now) {
  if (!prunes_ || only_group_) return;
  for (Address& address : addresses_[i]) {
    if (!address.is_peer) continue;
    address.prune = now + dds_.spdp.initial_prune_delay.value_or(Nanoseconds{}).count();
    if (address.state == State::live) continue;
    address.state = State::ageing;
    address.next = now + interval_;
  }
}

void AddressSchedule::recognised(Number i, Number other) {
  if (!only_group_) addresses_[i][other].state = State::live;
}

void AddressSchedule::lease_ended(Number i, Number other, std::int64_t now) {
  if (prunes_ && !only_group_) let_age(addresses_[i][other], now);
}

void AddressSchedule::said_goodbye(Number i, Number other, std::int64_t now) {
  if (!prunes_ || only_group_) return;
  Address& address = addresses_[i][other];
  if (address.is_peer && address.prune > now) return let_age(address, now);
  address.state = State::unknown;
}

void AddressSchedule::let_age(Address& address, std::int64_t now) const {
  address.state = State::ageing;
  const std::int64_t delay = dds_.spdp.discovered_prune_delay.value_or(Nanoseconds{}).count();
  address.prune = std::max(address.prune, now + delay);
  address.next = now + interval_;
}

std::vector<AddressSchedule::Number> AddressSchedule::of_announcement(Number i, bool all) const {
  std::vector<Number> addresses;
  if (has_group_) addresses.push_back(group);
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
      address.next = now + interval_;
      addresses.push_back(a);
    }
  }
  return addresses;
}

}  // namespace stormproof::model::cyclone
