// Which sighting of a datagram counts.
#include "checker/evidence/capture/merge.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <tuple>

namespace stormproof::capture {

namespace {

/// Indices of the sightings of one datagram, at most one of each capture.
using Group = std::vector<std::size_t>;

std::vector<Group> group(std::span<const Sighting> sightings) {
  using Identity = std::tuple<UdpEnd, UdpEnd, std::uint32_t, std::size_t, std::uint64_t>;
  struct Equal {
    std::vector<std::size_t> groups{};               ///< of the first, second, … of them
    std::map<std::uint32_t, std::size_t> counted{};  ///< how many each capture had so far
  };
  std::map<Identity, Equal> known;
  std::vector<Group> groups;
  for (std::size_t k = 0; k < sightings.size(); ++k) {
    const Sighting& one = sightings[k];
    Equal& equal = known[{one.source, one.destination, one.ip_id, one.length, one.digest}];
    const std::size_t occurrence = equal.counted[one.capture]++;
    if (occurrence == equal.groups.size()) {
      equal.groups.push_back(groups.size());
      groups.emplace_back();
    }
    groups[equal.groups[occurrence]].push_back(k);
  }
  return groups;
}

/// The capture that belongs to each source address.
std::map<Address, std::uint32_t> captures_of_sources(std::span<const Sighting> sightings,
                                                     const std::vector<Group>& groups) {
  std::map<Address, std::map<std::uint32_t, std::size_t>> votes;
  for (const Group& seen : groups) {
    const std::size_t first =
        *std::ranges::min_element(seen, {}, [&](std::size_t k) { return sightings[k].time_ns; });
    ++votes[sightings[first].source.address][sightings[first].capture];
  }
  std::map<Address, std::uint32_t> result;
  for (const auto& [address, counts] : votes) {
    result[address] =
        std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; })->first;
  }
  return result;
}

}  // namespace

std::uint64_t digest_of(Bytes payload) {
  return std::hash<std::string_view>{}(
      {reinterpret_cast<const char*>(payload.data()), payload.size()});
}

std::vector<bool> merge(std::span<const Sighting> sightings) {
  const std::vector<Group> groups = group(sightings);
  const auto own_capture = captures_of_sources(sightings, groups);
  std::vector<bool> counts(sightings.size(), false);
  for (const Group& seen : groups) {
    const std::uint32_t own = own_capture.at(sightings[seen.front()].source.address);
    const std::size_t chosen = *std::ranges::min_element(seen, {}, [&](std::size_t k) {
      return std::pair{sightings[k].capture != own, sightings[k].time_ns};
    });
    counts[chosen] = true;
  }
  return counts;
}

}  // namespace stormproof::capture
