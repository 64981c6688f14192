// The implementations of DDS that there are: which composition of machines each executes, and what
// is true of each whatever its profile says. This is the one place that tells them apart;
// everybody else asks for the capability that they mean, or gives a function for each composition
// to `visit_composition`, and does not compile as long as one is missing. Who states something
// about one `Writer`, a theorem, a property or a law, asks whose it is: tests/structure lists them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "model/dds_profile.hpp"

namespace stormproof::fsm::composition {
namespace paper {
struct Paper;  // fsm/composition/paper.hpp
}
namespace fastdds {
struct FastDds;  // fsm/composition/fastdds.hpp
}
namespace server {
struct FastDdsServer;  // fsm/composition/server.hpp
}
namespace cyclone {
struct Cyclone;  // fsm/composition/cyclone.hpp
}
namespace amended {
struct Amended;  // fsm/composition/amended.hpp
}
}  // namespace stormproof::fsm::composition

namespace stormproof::model {

/// Rules of a relation that some implementations leave to the profile and others have built in.
struct RelationRules {
  RelationOpening relation_opening = RelationOpening::receiver;
  Unmatched unmatched = Unmatched::drop;
  InitialAckNackReply initial_acknack = InitialAckNackReply::bitmap;
  HeartbeatTimerKind heartbeat_timer = HeartbeatTimerKind::single;
};

/// The writers that bounds, theorems and monitors are about. Implementations that differ in how
/// they announce, create endpoints or pack may have the same writer. Another writer needs its own
/// bounds and theorems: those of these two say nothing about it.
enum class Writer : std::uint8_t {
  of_the_paper,  ///< each ACKNACK and each repair starts a timer of its own
  stateful,      ///< Fast DDS's StatefulWriter: one nack response for all requests, one suppression
                 ///< for all repairs of a reader, an asynchronous thread that sends
  of_server,     ///< Fast DDS's Discovery Server: a datagram for each reader, with a HEARTBEAT that
                 ///< announces everything, what a reader does not need left out
  of_cyclone     ///< it repeats whatever is asked for, and it is the reader who limits that; it has
                 ///< knobs of its own (`DdsProfile::cyclone`)
};

/// RTPS vendor ids: the two bytes of a vendor, as one number.
namespace vendor {
inline constexpr std::uint16_t fastdds = 0x010f;
inline constexpr std::uint16_t cyclonedds = 0x0110;
}  // namespace vendor

struct ImplementationTraits {
  std::string_view name = {};   ///< in profiles, lists and data: "fastdds"
  std::string_view whose = {};  ///< whose writer it is, for people: "Fast DDS"
  std::string_view rules = {};  ///< the same for all its rules: "Fast DDS's own rules"
  std::string_view guide = {};  ///< the page that states them

  /// Whose participants send that way; absent if no program does.
  std::optional<std::uint16_t> vendor = {};
  /// Relation rules that are built in. Absent: they are knobs of the profile.
  std::optional<RelationRules> fixed_rules = {};
  /// Whether the sizes of packets, and the number and sizes of default descriptors, are knobs of
  /// the profile; otherwise they are constants of the program.
  bool has_size_knobs = false;
  /// Descriptors come into being one after the other between `start` and `endpoints_done`, and each
  /// is sent at its creation to the readers that are matched then; all other DATA is asked for.
  /// HEARTBEATs announce those that exist. Otherwise all descriptors exist at `start`.
  bool creates_endpoints_over_time = false;
  /// Participants discover those of their own host, too, through packets that take
  /// `loopback_delay`. Otherwise same-host pairs do not exist.
  bool discovers_same_host = false;
  /// There is a Discovery Server: a participant more than the deployment has, which knows whom it
  /// has to tell what. Discovery is complete when everybody knows what it matches.
  bool has_server = false;
  /// Matched user endpoints, and liveliness, exchange HEARTBEATs and ACKNACKs of their own, with
  /// times that no knob changes.
  bool has_control_relations = false;
  /// Each receiver of a packet has a reception event of its own, and with a constant delay there is
  /// no other; otherwise a packet arrives once, whoever it reaches.
  bool receives_separately = false;
  /// An ACKNACK has a base, below which everything is received, and asks only for what HEARTBEATs
  /// announced; an initial one says nothing. Otherwise an ACKNACK is a bitmap of all descriptors of
  /// the stream.
  bool acknacks_have_bases = false;
  /// A reader answers all HEARTBEATs that come until its ACKNACK is due by that one; otherwise each
  /// by one of its own.
  bool answers_heartbeats_together = false;
  /// What follows a repair counts from the instant when its packet has left the source queue;
  /// otherwise from its generation.
  bool waits_for_source = false;
  /// Engines, monitors and laws that are about descriptors know its writer. Otherwise only what is
  /// about machines, the network or results says something of it (props/applicability.hpp).
  bool is_known_to_engines = true;
  /// Its rules know participants that forget each other and come back (`deployment.life`);
  bool knows_lives = false;
  /// these rules are a composition of their own.
  bool has_living_composition = false;
  /// They know endpoints that are deleted, and participants that say that they go.
  bool says_goodbye = false;
  /// `amendments` of the profile change its rules.
  bool can_be_amended = false;
  /// Its timers, and what it packs, have keys of its own ("sedp.heartbeat_interval", …) and not
  /// those of the others.
  bool has_own_timers = false;
  /// A participant answers whoever announces itself, and tells nobody else then: no "spdp.resend".
  bool answers_newcomers = false;
  /// What a participant sends goes through an event thread, which takes its time for it.
  bool has_event_thread = false;
  /// Messages of all built-in endpoints share packets.
  bool mixes_messages = false;
  /// How long its threads are busy with what, is known (`processor` of a host).
  bool has_processor_times = false;
  /// How long others remember a participant of which they hear nothing, as the library comes; 0:
  /// nothing is known of it.
  Nanoseconds lease{0};
  /// Participants of a host that find a port as the library comes; 0: all do.
  std::uint32_t participants_of_a_host = 0;
  /// What everything sent once would be is defined: each descriptor goes to each reader by itself.
  bool has_open_loop = true;
  Writer writer = Writer::of_the_paper;
};

/// Those that a profile names.
inline constexpr std::array implementations{ImplementationKind::paper, ImplementationKind::fastdds,
                                            ImplementationKind::cyclone};

/// The one whose profiles choose how to discover.
inline constexpr ImplementationKind implementation_with_discovery = ImplementationKind::fastdds;

/// Of a profile that does not say its implementation.
inline constexpr ImplementationKind default_implementation{};

[[nodiscard]] constexpr std::size_t index_of(ImplementationKind kind) {
  return static_cast<std::size_t>(kind);
}

/// What programs have in common, other than the model of the paper.
inline constexpr ImplementationTraits traits_of_programs{
    .fixed_rules = RelationRules{.relation_opening = RelationOpening::each_side,
                                 .unmatched = Unmatched::drop,
                                 .initial_acknack = InitialAckNackReply::heartbeat,
                                 .heartbeat_timer = HeartbeatTimerKind::single},
    .creates_endpoints_over_time = true,
    .discovers_same_host = true,
    .has_control_relations = true,
    .receives_separately = true,
    .acknacks_have_bases = true,
    .answers_heartbeats_together = true};

[[nodiscard]] constexpr ImplementationTraits traits_of_paper() {
  return {.name = "paper",
          .whose = "the paper",
          .rules = "the rules of the closed-loop model",
          .guide = "specs/guide/model.md",
          .has_size_knobs = true,
          .waits_for_source = true,
          .can_be_amended = true};
}

/// The paper's, with rules that other implementations have or had (model/amendments.hpp).
[[nodiscard]] constexpr ImplementationTraits traits_of_paper_amended() {
  ImplementationTraits traits = traits_of_paper();
  traits.rules = "the amended rules of the closed-loop model";
  traits.guide = "specs/guide/museum.md";
  traits.is_known_to_engines = false;
  traits.knows_lives = true;
  return traits;
}

[[nodiscard]] constexpr ImplementationTraits traits_of_fastdds() {
  ImplementationTraits traits = traits_of_programs;
  traits.name = "fastdds";
  traits.whose = "Fast DDS";
  traits.rules = "Fast DDS's own rules";
  traits.guide = "specs/guide/fastdds.md";
  traits.vendor = vendor::fastdds;
  traits.knows_lives = true;
  traits.has_living_composition = true;
  traits.has_processor_times = true;
  traits.lease = Nanoseconds{20'000'000'000};  // RTPSParticipantAttributes.h, leaseDuration
  traits.participants_of_a_host = 101;  // mutation_tries after the first, RTPSParticipantImpl.cpp
  traits.writer = Writer::stateful;
  return traits;
}

[[nodiscard]] constexpr ImplementationTraits traits_of_cyclone() {
  ImplementationTraits traits = traits_of_programs;
  traits.name = "cyclone";
  traits.whose = "Cyclone DDS";
  traits.rules = "Cyclone DDS's own rules";
  traits.guide = "specs/guide/cyclone.md";
  traits.vendor = vendor::cyclonedds;
  traits.is_known_to_engines = false;
  traits.knows_lives = true;
  traits.has_living_composition = true;
  traits.says_goodbye = true;
  traits.lease = Nanoseconds{10'000'000'000};  // ddsi_cfgelems.h, LeaseDuration
  traits.has_own_timers = true;
  traits.answers_newcomers = true;
  traits.has_event_thread = true;
  traits.mixes_messages = true;
  traits.has_open_loop = false;
  traits.writer = Writer::of_cyclone;
  return traits;
}

/// Fast DDS with static peers: other announcements.
[[nodiscard]] constexpr ImplementationTraits traits_of_fastdds_static() {
  ImplementationTraits traits = traits_of_fastdds();
  traits.rules = "Fast DDS's own rules with static peers";
  traits.guide = "specs/guide/discovery-server.md";
  return traits;
}

/// Fast DDS with a Discovery Server.
[[nodiscard]] constexpr ImplementationTraits traits_of_fastdds_server() {
  ImplementationTraits traits = traits_of_fastdds_static();
  traits.rules = "the rules of Fast DDS's Discovery Server";
  traits.has_server = true;
  traits.is_known_to_engines = false;
  traits.has_processor_times = false;
  traits.has_open_loop = false;
  traits.writer = Writer::of_server;
  return traits;
}

/// In the order of the enumerators.
inline constexpr std::array implementation_traits{
    traits_of_paper(),          traits_of_fastdds(),        traits_of_cyclone(),
    traits_of_fastdds_static(), traits_of_fastdds_server(), traits_of_paper_amended()};

/// What runs under the profile: its implementation, with the way to discover.
[[nodiscard]] constexpr ImplementationKind kind_of(ImplementationKind implementation,
                                                   Discovery discovery) {
  if (implementation != implementation_with_discovery) return implementation;
  switch (discovery) {
    case Discovery::simple:
      return ImplementationKind::fastdds;
    case Discovery::static_peers:
      return ImplementationKind::fastdds_static;
    case Discovery::server:
    case Discovery::super_client:
      return ImplementationKind::fastdds_server;
  }
  return implementation;
}
[[nodiscard]] inline ImplementationKind kind_of(const DdsProfile& dds) {
  if (dds.amendments && dds.implementation == ImplementationKind::paper) {
    return ImplementationKind::paper_amended;
  }
  return kind_of(dds.implementation, dds.discovery);
}
/// The implementation that a profile names for it.
[[nodiscard]] constexpr ImplementationKind implementation_of(ImplementationKind kind) {
  if (kind == ImplementationKind::paper_amended) return ImplementationKind::paper;
  const bool named = index_of(kind) < implementations.size();
  return named ? kind : implementation_with_discovery;
}
/// Which composition of those that there are (fsm/composition/compositions.hpp) it executes.
[[nodiscard]] constexpr std::size_t composition_index(ImplementationKind kind) {
  if (kind == ImplementationKind::fastdds_static) return index_of(ImplementationKind::fastdds);
  if (kind == ImplementationKind::paper_amended) return implementations.size() + 1;
  return kind == ImplementationKind::fastdds_server ? implementations.size() : index_of(kind);
}

[[nodiscard]] constexpr const ImplementationTraits& traits_of(ImplementationKind kind) {
  return implementation_traits[index_of(kind)];
}
[[nodiscard]] inline const ImplementationTraits& traits_of(const DdsProfile& dds) {
  return traits_of(kind_of(dds));
}

/// How long others remember a participant of which they hear nothing; 0: nothing is known of it.
[[nodiscard]] inline Nanoseconds lease_of(const DdsProfile& dds) {
  return dds.spdp.lease.value_or(traits_of(dds).lease);
}
/// Participants of a host that find a port or an index; 0: as many as there are.
[[nodiscard]] inline std::uint32_t participants_of_a_host(const DdsProfile& dds) {
  const std::uint32_t said = dds.max_participants_per_host;
  return said != 0 ? said : traits_of(dds).participants_of_a_host;
}

/// Those whose writer engines, monitors and laws know.
[[nodiscard]] inline std::vector<ImplementationKind> known_to_engines() {
  std::vector<ImplementationKind> known;
  for (const ImplementationKind kind : implementations) {
    if (traits_of(kind).is_known_to_engines) known.push_back(kind);
  }
  return known;
}

/// The relation rules that run: those that are built in, or those of the profile.
[[nodiscard]] inline RelationRules rules_of(const DdsProfile& dds) {
  const std::optional<RelationRules>& fixed = traits_of(dds).fixed_rules;
  if (fixed) return *fixed;
  const SedpProfile& sedp = dds.sedp;
  return {sedp.relation_opening, sedp.unmatched, sedp.initial_acknack, sedp.heartbeat_timer};
}

/// Stands for a composition where functions are chosen by it: `f(Of<comp::paper::Paper>)`.
template <class Composition>
struct Of {
  using Type = Composition;
};
/// What nobody says of the amended rules is what is said of the paper's, which they change: sizes
/// of packets, workloads.
template <>
struct Of<fsm::composition::amended::Amended> : Of<fsm::composition::paper::Paper> {
  using Type = fsm::composition::amended::Amended;
};

/// What `visit` returns for `Of` the composition that the implementation executes. It has the same
/// type for each.
template <class Visit>
decltype(auto) visit_composition(ImplementationKind kind, Visit&& visit) {
  switch (kind) {
    case ImplementationKind::paper:
      return visit(Of<fsm::composition::paper::Paper>{});
    case ImplementationKind::fastdds:
    case ImplementationKind::fastdds_static:
      return visit(Of<fsm::composition::fastdds::FastDds>{});
    case ImplementationKind::paper_amended:
      return visit(Of<fsm::composition::amended::Amended>{});
    case ImplementationKind::fastdds_server:
      return visit(Of<fsm::composition::server::FastDdsServer>{});
    case ImplementationKind::cyclone:
      break;
  }
  return visit(Of<fsm::composition::cyclone::Cyclone>{});
}
template <class Visit>
decltype(auto) visit_composition(const DdsProfile& dds, Visit&& visit) {
  return visit_composition(kind_of(dds), visit);
}

/// The same for engines, of compositions that they know; static peers have that of Fast DDS. Asking
/// for another one is a mistake of the program: std::logic_error.
template <class Visit>
decltype(auto) visit_engine_composition(const DdsProfile& dds, Visit&& visit) {
  const std::size_t index = composition_index(kind_of(dds));
  if (index == index_of(ImplementationKind::paper)) {
    return visit(Of<fsm::composition::paper::Paper>{});
  }
  if (index != index_of(ImplementationKind::fastdds)) {
    throw std::logic_error{"no engine knows this composition"};
  }
  return visit(Of<fsm::composition::fastdds::FastDds>{});
}

}  // namespace stormproof::model
