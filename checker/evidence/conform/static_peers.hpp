// Announcements with static peers (`discovery: static`): instead of a multicast, a round of copies,
// one to each of the first ports of every host, behind those to the participants that are known. A
// capture shows the copies; which of them are one round is found from those to one participant,
// which is sent one in each round, and from the round on in which it is known a second one.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "checker/evidence/conform/bounds.hpp"
#include "checker/evidence/conform/dialogue.hpp"

namespace stormproof::conform {

/// The number of a participant's port on its host, from 0 on, by the usual ports of RTPS (2.5,
/// section 9.6.1); nothing if it has another.
[[nodiscard]] std::optional<std::uint32_t> port_index(const capture::Participant& participant);

class StaticPeers {
 public:
  /// Of the announcements of `participant`, which go to `ports` ports of each host.
  StaticPeers(const Dialogue& dialogue, std::size_t participant, std::uint32_t ports,
              const Bounds& bounds);

  /// Whether every round has a copy for it, known or not.
  [[nodiscard]] bool reaches(std::size_t destination) const;

  /// How many copies a round has for it, at most.
  [[nodiscard]] std::size_t most_in_a_round(std::size_t destination) const {
    return reaches(destination) ? 2 : 1;
  }
  [[nodiscard]] std::size_t copies_to(std::size_t destination) const {
    return copies_[destination];
  }

  /// The rounds that the copies can have been, if a participant can be known from `known_since` on:
  /// first those with which all copies agree. One without rounds if the copies do not tell.
  [[nodiscard]] std::vector<std::vector<Announcement>> ways(
      const std::vector<std::optional<std::int64_t>>& known_since) const;

 private:
  [[nodiscard]] std::optional<std::size_t> witness() const;
  [[nodiscard]] bool agree(const std::vector<Announcement>& rounds) const;

  const Dialogue& dialogue_;
  std::size_t participant_;
  std::uint32_t ports_;
  const Bounds& bounds_;
  std::vector<std::size_t> copies_;  // by destination
};

}  // namespace stormproof::conform
