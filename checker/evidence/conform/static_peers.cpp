// Rounds of copies from the copies to one participant.
#include "checker/evidence/conform/static_peers.hpp"

#include <algorithm>

#include "checker/evidence/capture/topology.hpp"
#include "checker/evidence/conform/words.hpp"

namespace stormproof::conform {

namespace {

/// Copies up to `singles` are a round each, the others two by two; nothing if they cannot be.
std::optional<std::vector<Announcement>> rounds(const std::vector<Announcement>& copies,
                                                std::size_t singles, std::int64_t most_apart_ns) {
  std::vector<Announcement> found(copies.begin(),
                                  copies.begin() + static_cast<std::ptrdiff_t>(singles));
  for (std::size_t k = singles; k < copies.size(); k += 2) {
    // The capture may end between the two.
    if (k + 1 < copies.size() && copies[k + 1].time_ns - copies[k].time_ns > most_apart_ns) {
      return std::nullopt;
    }
    found.push_back(copies[k]);
  }
  return found;
}

}  // namespace

std::optional<std::uint32_t> port_index(const capture::Participant& participant) {
  constexpr std::uint32_t base = 7400;
  constexpr std::uint32_t of_a_domain = 250;
  constexpr std::uint32_t metatraffic = 10;
  if (participant.locators.empty()) return std::nullopt;
  const std::uint32_t port = participant.locators.begin()->port;
  if (port < base + metatraffic) return std::nullopt;
  const std::uint32_t offset = (port - base) % of_a_domain;
  if (offset < metatraffic || offset % 2 != 0) return std::nullopt;
  return (offset - metatraffic) / 2;
}

StaticPeers::StaticPeers(const Dialogue& dialogue, std::size_t participant, std::uint32_t ports,
                         const Bounds& bounds)
    : dialogue_{dialogue},
      participant_{participant},
      ports_{ports},
      bounds_{bounds},
      copies_(dialogue.participants()) {
  for (const Announcement& one : dialogue.announcements[participant]) {
    if (one.destination) ++copies_[*one.destination];
  }
}

bool StaticPeers::reaches(std::size_t destination) const {
  const auto& participants = dialogue_.conversation.topology.participants;
  if (participants[destination].host == participants[participant_].host) return false;
  const auto index = port_index(participants[destination]);
  return index && *index < ports_;
}

std::optional<std::size_t> StaticPeers::witness() const {
  for (std::size_t j = 0; j < dialogue_.participants(); ++j) {
    if (reaches(j)) return j;
  }
  return std::nullopt;
}

std::vector<std::vector<Announcement>> StaticPeers::ways(
    const std::vector<std::optional<std::int64_t>>& known_since) const {
  const std::optional<std::size_t> to = witness();
  if (!to) return {{}};
  std::vector<Announcement> copies;
  for (const Announcement& one : dialogue_.announcements[participant_]) {
    if (one.destination == to) copies.push_back(one);
  }
  std::vector<std::vector<Announcement>> found;
  const std::int64_t most_apart_ns = bounds_.most_send_lag_ns + capture_resolution_ns;
  for (std::size_t singles = 0; singles <= copies.size(); ++singles) {
    const bool may_be_known =
        singles == copies.size() ||
        (known_since[*to] && copies[singles].time_ns + capture_resolution_ns >= *known_since[*to]);
    if (!may_be_known) continue;
    if (auto way = rounds(copies, singles, most_apart_ns)) found.push_back(*std::move(way));
  }
  std::stable_partition(found.begin(), found.end(),
                        [&](const std::vector<Announcement>& way) { return agree(way); });
  return found;
}

/// Of each round but the last, which the capture may cut off, a port has had its copy.
bool StaticPeers::agree(const std::vector<Announcement>& rounds) const {
  for (std::size_t j = 0; j < dialogue_.participants(); ++j) {
    const std::size_t copies = copies_to(j);
    if (copies > most_in_a_round(j) * rounds.size()) return false;
    if (reaches(j) && copies + 1 < rounds.size()) return false;
  }
  return true;
}

}  // namespace stormproof::conform
