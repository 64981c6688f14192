// Who told whom in a capture: the facts that reasons are decided from, collected once.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "checker/evidence/capture/counting.hpp"

namespace stormproof::doctor {

/// Of one participant, by its number in the topology.
struct Contact {
  std::set<std::uint32_t> domains{};      ///< that it announces itself in, by the ports
  std::vector<std::int64_t> announced{};  ///< when it announced itself to the group
  std::uint64_t multicast_data = 0;       ///< SEDP to the group
  std::uint64_t answers = 0;              ///< SEDP to participants of other hosts, or to the group
  std::uint64_t told = 0;                 ///< SEDP to it, from other hosts
  std::uint64_t directed = 0;             ///< announcements to addresses, not to the group
  std::int64_t last_ns = INT64_MIN;       ///< when it sent something last
  std::int64_t gone_ns = INT64_MIN;       ///< when it said last that it leaves
};

class Contacts {
 public:
  Contacts(const capture::Conversation& conversation, const capture::Counting& counting);

  [[nodiscard]] const capture::Conversation& conversation() const { return conversation_; }
  [[nodiscard]] const capture::Counting& counting() const { return counting_; }
  [[nodiscard]] const capture::Topology& topology() const { return conversation_.topology; }
  [[nodiscard]] const Contact& of(std::size_t participant) const { return all_[participant]; }
  [[nodiscard]] std::size_t size() const { return all_.size(); }
  /// The number of the participant; nothing of one that the topology has not.
  [[nodiscard]] std::optional<std::size_t> number_of(const capture::GuidPrefix& prefix) const;
  /// "12.30 s": since the capture began.
  [[nodiscard]] std::string time_text(std::int64_t time_ns) const;
  /// SEDP messages from one to another participant of another host.
  [[nodiscard]] std::uint64_t messages(std::size_t from, std::size_t to) const;
  /// SEDP messages to participants that announce nothing here, by where they go.
  [[nodiscard]] const std::map<capture::UdpEnd, std::uint64_t>& unseen() const { return unseen_; }
  /// Participants of each host.
  [[nodiscard]] const std::vector<std::vector<std::size_t>>& hosts() const { return hosts_; }

  /// "host 1 (10.0.0.2)".
  [[nodiscard]] std::string host_text(std::size_t host) const;
  /// "participant 3 of host 1 (10.0.0.2)".
  [[nodiscard]] std::string text(std::size_t participant) const;

 private:
  void add(const capture::Event& event);

  const capture::Conversation& conversation_;
  const capture::Counting& counting_;
  std::map<capture::GuidPrefix, std::size_t> number_;
  std::vector<Contact> all_;
  std::map<std::pair<std::size_t, std::size_t>, std::uint64_t> messages_;
  std::map<capture::UdpEnd, std::uint64_t> unseen_;
  std::vector<std::vector<std::size_t>> hosts_;
};

/// What the participant says its lease is, or the longest of a shipped profile.
[[nodiscard]] std::int64_t lease_of(const Contacts& contacts, std::size_t participant);
/// What is no silence of a participant yet: half its lease, and longer than it ever waited between
/// two announcements, or than Cyclone DDS does.
[[nodiscard]] std::int64_t longest_pause_ns(const Contacts& contacts, std::size_t participant);

}  // namespace stormproof::doctor
