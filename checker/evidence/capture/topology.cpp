// Participants, endpoints, hosts.
#include "checker/evidence/capture/topology.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace stormproof::capture {

namespace {

/// Participants that sent from a common address are on one host; so are those that share an
/// address with one of these, and so on. Returns a representative for each participant.
std::vector<std::size_t> connect(const std::vector<Participant>& participants) {
  std::vector<std::size_t> parent(participants.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&parent](std::size_t k) {
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
  };
  std::map<Address, std::size_t> owner;
  for (std::size_t k = 0; k < participants.size(); ++k) {
    for (const Address& address : participants[k].addresses) {
      const auto [found, is_new] = owner.emplace(address, k);
      if (!is_new) parent[root(k)] = root(found->second);
    }
  }
  for (std::size_t k = 0; k < parent.size(); ++k) parent[k] = root(k);
  return parent;
}

}  // namespace

std::size_t Participant::announced(EntityId sedp_writer) const {
  return static_cast<std::size_t>(std::ranges::count_if(endpoints, [&](const auto& entry) {
    return entry.second.announced_by == sedp_writer && !entry.second.is_gone;
  }));
}

const Participant* Topology::find(const GuidPrefix& prefix) const {
  const auto found = std::ranges::find(participants, prefix, &Participant::prefix);
  return found == participants.end() ? nullptr : &*found;
}

bool Topology::has_server() const {
  return std::ranges::any_of(participants, [](const Participant& one) {
    return !one.discovery.empty() && one.discovery != "SIMPLE";
  });
}

const Participant* Topology::server() const {
  const auto found = std::ranges::find_if(participants, &Participant::is_server);
  return found == participants.end() ? nullptr : &*found;
}

void TopologyBuilder::saw_message(const GuidPrefix& source, VendorId vendor, const Address& from,
                                  std::int64_t time_ns) {
  const auto [found, is_new] = participants_.try_emplace(source);
  Participant& participant = found->second;
  if (is_new) {
    participant.prefix = source;
    participant.first_ns = time_ns;
    participant.vendor = vendor;
  }
  participant.first_ns = std::min(participant.first_ns, time_ns);
  participant.last_ns = std::max(participant.last_ns, time_ns);
  participant.addresses.insert(from);
}

void TopologyBuilder::saw_participant(const GuidPrefix& source, const ParticipantData& data,
                                      std::int64_t time_ns) {
  if (!participants_.contains(source)) return;
  const GuidPrefix prefix = data.prefix.value_or(source);
  const auto [found, is_new] = participants_.try_emplace(prefix);
  Participant& participant = found->second;
  if (is_new) {
    participant.prefix = prefix;
    participant.first_ns = time_ns;
    for (const UdpEnd& locator : data.metatraffic_unicast) {
      participant.addresses.insert(locator.address);
    }
  }
  if (data.vendor) participant.vendor = *data.vendor;
  if (!data.name.empty()) participant.name = data.name;
  if (!data.version.empty()) participant.version = data.version;
  if (data.lease_ns) participant.lease_ns = data.lease_ns;
  if (data.domain) participant.domain = data.domain;
  if (!data.machine.empty()) participant.machine = data.machine;
  if (!data.discovery.empty()) participant.discovery = data.discovery;
  for (const UdpEnd& locator : data.metatraffic_unicast) {
    participant.locators.insert(locator);
    auto& since = announcements_[locator];
    // Repeated announcements tell nothing new.
    auto later = since.upper_bound(time_ns);
    if (later != since.begin() && std::prev(later)->second == prefix) continue;
    since[time_ns] = prefix;
  }
}

void TopologyBuilder::saw_endpoint(const GuidPrefix& source, EntityId sedp_writer,
                                   std::int64_t sequence_number, const EndpointData& data,
                                   std::int64_t time_ns) {
  if (!data.endpoint) return;
  // A Discovery Server passes on what others have described, with numbers of its own.
  const auto owner = participants_.find(data.endpoint->prefix);
  const bool is_relayed = data.endpoint->prefix != source && owner != participants_.end();
  const auto found = is_relayed ? owner : participants_.find(source);
  if (found == participants_.end()) return;
  const auto [entry, is_new] = found->second.endpoints.try_emplace(*data.endpoint);
  Endpoint& endpoint = entry->second;
  endpoint.first_ns = is_new ? time_ns : std::min(endpoint.first_ns, time_ns);
  if (!is_new && (is_relayed || sequence_number <= endpoint.sequence_number)) return;
  endpoint.entity = data.endpoint->entity;
  endpoint.announced_by = sedp_writer;
  endpoint.sequence_number = is_relayed ? 0 : sequence_number;
  endpoint.is_gone = data.is_gone;
  if (!data.topic.empty()) endpoint.topic = data.topic;
  if (!data.type.empty()) endpoint.type = data.type;
  endpoint.has_type_information = data.has_type_information;
  endpoint.type_hash = data.type_hash;
  if (!data.is_gone) endpoint.qos = data.qos;
}

std::optional<GuidPrefix> TopologyBuilder::receiver(const UdpEnd& locator,
                                                    std::int64_t time_ns) const {
  const auto found = announcements_.find(locator);
  if (found == announcements_.end()) return std::nullopt;
  const auto& since = found->second;
  const auto later = since.upper_bound(time_ns);
  return later == since.begin() ? later->second : std::prev(later)->second;
}

Topology TopologyBuilder::build() const {
  Topology topology;
  for (const auto& [prefix, participant] : participants_) {
    topology.participants.push_back(participant);
  }
  auto& list = topology.participants;
  std::ranges::stable_sort(list, {}, &Participant::first_ns);
  const std::vector<std::size_t> representative = connect(list);
  std::map<std::size_t, std::size_t> numbers;
  // Hosts are numbered by address, so that they do not depend on who starts first.
  std::map<Address, std::size_t> by_address;
  for (std::size_t k = 0; k < list.size(); ++k) {
    for (const Address& address : list[k].addresses) by_address.emplace(address, representative[k]);
  }
  for (const auto& [address, host] : by_address) numbers.emplace(host, numbers.size());
  for (std::size_t k = 0; k < list.size(); ++k) list[k].host = numbers[representative[k]];
  topology.hosts = numbers.size();
  std::ranges::stable_sort(list, {}, &Participant::host);
  return topology;
}

}  // namespace stormproof::capture
