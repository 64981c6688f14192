// The deployment: who takes part, on which host, from when on, and with how many user endpoints
// (the paper's structural discovery workload; specs/guide/model.md, section "Deployment"). Pure
// data; a scenario file or a caller fills it in.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/dds_profile.hpp"
#include "model/host.hpp"
#include "model/shared_value.hpp"
#include "model/units.hpp"

namespace stormproof::model {

/// One DDS participant. The numbers of user endpoints come on top of the profile's default
/// descriptors.
struct Participant {
  HostId host;
  std::uint32_t publications = 0;   ///< user publications, 0 … Deployment::max_endpoints
  std::uint32_t subscriptions = 0;  ///< user subscriptions, 0 … Deployment::max_endpoints
  Nanoseconds start;           ///< ≥ 0; before it the participant ignores all that reaches it
  Nanoseconds endpoints_done;  ///< ≥ start; all endpoints created (not of `implementation: paper`)
  /// Under Cyclone DDS what reaches the participant before `open` is lost (≤ start, which it is if
  /// absent); what reaches it from then on and before `ready` is received then (≥ start, which it
  /// is if absent). In a life under Fast DDS what reaches it before `ready` is lost.
  std::optional<Nanoseconds> open = {};
  std::optional<Nanoseconds> ready = {};
  /// Its own profile, of the implementation of the scenario's; absent: it has that one.
  Shared<DdsProfile> dds = {};
  /// Which Discovery Servers of the deployment's list it is a client of; empty: of all.
  std::vector<std::uint64_t> servers = {};

  bool operator==(const Participant&) const = default;
};

/// A Discovery Server (`discovery: server` and `super_client`): one more that takes part, numbered
/// after all participants, without endpoints, from time 0 on (model/servers.hpp).
struct DiscoveryServer {
  HostId host;
  std::vector<std::uint64_t> servers = {};  ///< of the same list, those that it looks for

  bool operator==(const DiscoveryServer&) const = default;
};

/// Ranges from which the start times of a deployment are drawn. Real processes never start at
/// exactly the same time, and a storm depends on it, so live runs are predicted as a distribution
/// over such schedules.
struct Schedule {
  Nanoseconds start_min;           ///< ≥ 0
  Nanoseconds start_max;           ///< ≥ start_min
  Nanoseconds endpoints_done_min;  ///< ≥ 0
  Nanoseconds endpoints_done_max;  ///< ≥ endpoints_done_min
  std::uint64_t seed = 0;          ///< of the one schedule that a single run uses
  /// How long before its start a participant hears, ≥ 0; absent: participants keep their `open`.
  std::optional<Nanoseconds> open_before = {};

  bool operator==(const Schedule&) const = default;
};

/// Before the run, `writer` holds `reader` as matched and up to date, and `reader` has forgotten
/// `writer`.
struct StaleRelation {
  std::uint32_t writer = 0;
  std::uint32_t reader = 0;

  bool operator==(const StaleRelation&) const = default;
};
/// From that time on nothing that the participant emits is received, and it processes nothing.
struct Mute {
  std::uint32_t participant = 0;
  Nanoseconds from;

  bool operator==(const Mute&) const = default;
};
/// Of whom a side of an outage has the number: of one participant, of all of a host, or of nobody,
/// as it is everybody.
enum class Reach : std::uint8_t { participant, host, all };
/// A packet of another host whose reception would be at start ≤ t < end is not received. One
/// direction.
struct Outage {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  Nanoseconds start;
  Nanoseconds end;
  Reach from_reach = Reach::participant;
  Reach to_reach = Reach::participant;

  bool operator==(const Outage&) const = default;
};

/// Who a participant is when it comes back: itself, whom others may still know, or somebody whom
/// nobody has met.
enum class Identity : std::uint8_t { same, fresh };
/// Whether it tells the others before.
enum class Goodbye : std::uint8_t { no, yes };
/// The participant stops, and comes back with nothing of what it knew.
struct Restart {
  std::uint32_t participant = 0;
  Nanoseconds stop;
  Nanoseconds start;  ///< > stop
  Identity identity = Identity::same;
  /// Whether it says that it goes (`implementation: cyclone` only).
  Goodbye goodbye = Goodbye::no;

  bool operator==(const Restart&) const = default;
};
/// A participant deletes all that it has, says that it goes, and is gone for ever.
struct Leave {
  std::uint32_t participant = 0;
  Nanoseconds at;

  bool operator==(const Leave&) const = default;
};
/// The lease of one participant.
struct Lease {
  std::uint32_t participant = 0;
  Nanoseconds duration;

  bool operator==(const Lease&) const = default;
};

/// User endpoints that a participant creates in the run, and may delete again.
struct LateEndpoints {
  std::uint32_t participant = 0;
  std::uint32_t publications = 0;
  std::uint32_t subscriptions = 0;
  Nanoseconds at;
  std::optional<Nanoseconds> until = {};  ///< > at

  bool operator==(const LateEndpoints&) const = default;
};

/// A user endpoint that a participant has from the beginning and deletes in the run.
struct Deletion {
  std::uint32_t participant = 0;
  std::optional<std::uint32_t> publication = {};   ///< which of its user publications, or
  std::optional<std::uint32_t> subscription = {};  ///< which of its user subscriptions
  Nanoseconds at;

  bool operator==(const Deletion&) const = default;
};

/// What happened before the run, and what happens to participants in it; only with
/// rules that know it (model/life.hpp, `ImplementationTraits::knows_lives`).
struct Life {
  std::vector<StaleRelation> stale;
  std::vector<Mute> mute;
  std::vector<Outage> outages;
  std::vector<Restart> restarts = {};
  /// How long a participant is remembered of which nothing is heard; absent: for ever.
  std::optional<Nanoseconds> lease = {};
  std::vector<Lease> leases = {};  ///< of those with another one
  std::vector<LateEndpoints> endpoints = {};
  std::vector<Deletion> deletions = {};
  std::vector<Leave> leaves = {};

  bool operator==(const Life&) const = default;
};

/// Endpoints say which type their topic has, by `implementation: fastdds`. Of each participant so
/// many of its endpoints have a type that nobody else knows (model/fastdds/types.hpp).
struct EndpointTypes {
  std::uint32_t unknown_per_participant = 0;

  bool operator==(const EndpointTypes&) const = default;
};

struct Deployment {
  /// Largest deployment that is accepted. 4,000 participants on two hosts are 16 million relations.
  static constexpr std::uint32_t max_participants = 4'000;
  static constexpr std::uint32_t max_endpoints = 100'000;

  std::vector<Participant> participants;  ///< numbered in this order
  /// By number, at least as many as participants are on; empty: stations of one access point
  /// (model/host.hpp).
  std::vector<Host> hosts = {};
  std::vector<AccessPoint> access_points = {};  ///< of the hosts; empty: one
  std::vector<DiscoveryServer> servers = {};    ///< empty: one on host 0, if there is any
  /// Between a wired host and the distribution system, each way, ≥ 1.
  std::optional<Nanoseconds> wired_delay = {};
  /// `wired_delay`, or half of what two hosts of the profile `wired` have between them.
  [[nodiscard]] Nanoseconds delay_of_cable() const {
    return wired_delay.value_or(Nanoseconds{50'000});
  }
  /// Delay of same-host packets, ≥ 0 (not of `implementation: paper`).
  Nanoseconds loopback_delay{2'000'000};
  /// Between two packets that a participant sends, ≥ 0 (`implementation: cyclone` only).
  std::optional<Nanoseconds> send_time = {};
  /// `send_time`, or what was measured on the machine of the live runs.
  [[nodiscard]] Nanoseconds time_to_send() const { return send_time.value_or(Nanoseconds{50'000}); }

  /// Between two datagrams that the sending thread of a Discovery Server sends, ≥ 0 (`discovery:
  /// server` and `super_client` only).
  std::optional<Nanoseconds> send_cost = {};
  /// `send_cost`, or what was measured on the machine of the live runs.
  [[nodiscard]] Nanoseconds cost_to_send() const { return send_cost.value_or(Nanoseconds{50'000}); }

  std::optional<EndpointTypes> types = {};
  std::optional<Life> life = {};

  /// The ranges that `start` and `endpoints_done` of the participants were drawn from, if they were
  /// drawn.
  std::optional<Schedule> schedule;

  /// Draws every participant's `start` and `endpoints_done` (not before its start) uniformly from
  /// the ranges of the schedule, which must exist, and lets each hear from `open_before` before its
  /// start on. The same seed gives the same times on every machine.
  void draw_schedule(std::uint64_t seed);

  /// What each node brings along, beside the participant's own publication and subscription of
  /// `ros_discovery_info` (rcl, rclcpp: rosout, parameter events, six services of parameters). The
  /// default descriptors of a profile are those of a participant with one node.
  static constexpr std::uint32_t publications_of_a_node = 8;
  static constexpr std::uint32_t subscriptions_of_a_node = 7;
  static constexpr std::uint32_t endpoints_of_a_node =
      publications_of_a_node + subscriptions_of_a_node;

  /// The short form: host 0's participants first, each with ceil(E/2) publications and floor(E/2)
  /// subscriptions. With `nodes_per_participant` k, each k of them on a host, in this order, are
  /// nodes of one participant instead; the last one of a host may have fewer.
  [[nodiscard]] static Deployment homogeneous(std::uint32_t hosts,
                                              std::uint32_t participants_per_host,
                                              std::uint32_t endpoints_per_participant,
                                              std::uint32_t nodes_per_participant = 1);

  [[nodiscard]] std::uint32_t size() const {
    return static_cast<std::uint32_t>(participants.size());
  }
  /// Number of different hosts that carry at least one participant.
  [[nodiscard]] std::uint32_t host_count() const;
  /// Number of participants of the host that has most of them.
  [[nodiscard]] std::uint32_t most_on_a_host() const;
  /// Whether at least one cross-host pair exists; without one there is nothing to discover.
  [[nodiscard]] bool has_cross_host_pair() const { return host_count() > 1; }

  bool operator==(const Deployment&) const = default;
};

}  // namespace stormproof::model
