// The table of the DDS profile: every key, its range and its meaning, in the order of the file. See
// knobs.hpp for what visits it. The paper's model and Fast DDS share the timers, Cyclone DDS has
// those of its own configuration; the relation rules and all sizes are keys where they are no
// constants of the implementation (model/implementations.hpp).
#pragma once

#include <fmt/core.h>

#include "model/config/knobs/knobs.hpp"
#include "model/config/knobs/value_types.hpp"
#include "model/dds_profile.hpp"
#include "model/implementations.hpp"

namespace stormproof::model::config {

template <>
inline constexpr auto enum_names<ImplementationKind> = [] {
  std::array<std::string_view, implementations.size()> names;
  for (const ImplementationKind kind : implementations) {
    names[index_of(kind)] = traits_of(kind).name;
  }
  return names;
}();
template <>
inline constexpr std::array<std::string_view, 4> enum_names<SpdpResend>{
    "all_known", "new_and_multicast", "new_only", "none"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<RelationOpening>{"receiver",
                                                                             "each_side"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<InitialData>{"push", "pull"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<Unmatched>{"drop", "accept"};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<InitialAckNackReply>{
    "bitmap", "heartbeat", "none"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<InitialAckNackInterval>{"doubling",
                                                                                    "constant"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<Acknowledge>{"bitmap", "prefix"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<HeartbeatTimerKind>{"single",
                                                                                "additive"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<HeartbeatRecipients>{"unacknowledged",
                                                                                 "matched"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<HeartbeatPolicy>{"periodic",
                                                                             "adaptive"};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<Grouping>{"message", "mtu", "single"};
template <>
inline constexpr std::array<std::string_view, 4> enum_names<Piggyback>{"cumulative", "linear",
                                                                       "off", "group"};

template <>
inline constexpr std::array<std::string_view, 4> enum_names<AllowMulticast>{"true", "spdp",
                                                                            "default", "false"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<MergeQueued>{"false", "true"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<Notification>{"in_order",
                                                                          "fresh_at_once"};

template <>
inline constexpr std::array<std::string_view, 4> enum_names<Discovery>{"simple", "server",
                                                                       "super_client", "static"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<Relay>{"repeat", "once"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<ServerKnown>{"guid", "locator"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<Rejoin>{"dropped", "known"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<Whether>{"false", "true"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<MatchOrder>{"endpoints_first",
                                                                        "builtin_first"};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<LookupFilter>{"none", "answers", "all"};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<LookupUnit>{"type_and_stream", "type",
                                                                        "participant"};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<SizesSince>{"v2.6", "v3.2", "v3.6"};

/// Sizes of packets and of their parts.
inline constexpr NumberType packet_bytes = byte_range(1, 1'000'000'000);
/// 20·T and T·H of the adaptive policy stay within 64 bits for every T up to 10^6 s and this
/// denominator.
inline constexpr std::int64_t max_epsilon_denominator = 1'000;

/// Of a relation rule.
[[nodiscard]] constexpr Presence of_rules(ImplementationKind implementation) {
  return traits_of(implementation).fixed_rules ? Presence::of_others : Presence::required;
}
/// Of the size of a packet or of its parts.
[[nodiscard]] constexpr Presence of_sizes(ImplementationKind implementation) {
  return traits_of(implementation).has_size_knobs ? Presence::required : Presence::of_others;
}
/// Of what only Cyclone DDS has, and of what only the others have.
[[nodiscard]] constexpr Presence of_cyclone(ImplementationKind implementation) {
  return traits_of(implementation).has_own_timers ? Presence::required : Presence::of_others;
}
[[nodiscard]] constexpr Presence not_of_cyclone(ImplementationKind implementation,
                                                Presence elsewhere = Presence::required) {
  return traits_of(implementation).has_own_timers ? Presence::of_others : elsewhere;
}

/// Of what only Fast DDS has with some way to discover.
[[nodiscard]] constexpr Presence with_server(ImplementationKind kind) {
  return traits_of(kind).has_server ? Presence::defaulted : Presence::of_others;
}
[[nodiscard]] constexpr Presence with_static_peers(ImplementationKind kind) {
  const bool is_named = kind == implementation_of(kind);
  return is_named || traits_of(kind).has_server ? Presence::of_others : Presence::defaulted;
}
/// Of what programs have.
[[nodiscard]] constexpr Presence of_programs(ImplementationKind implementation) {
  return traits_of(implementation).fixed_rules ? Presence::optional : Presence::of_others;
}
[[nodiscard]] constexpr Presence with_discovery(ImplementationKind implementation) {
  return kind_of(implementation, Discovery::server) != implementation ? Presence::optional
                                                                      : Presence::of_others;
}

constexpr void visit_knobs(auto& visit, Is<SpdpProfile> auto& spdp,
                           ImplementationKind implementation) {
  visit.knob("period", spdp.period, period_range, "announcement period after startup (tau_P)");
  visit.knob("startup_announcements", spdp.startup_announcements, count_range(0, 1'000'000),
             "announcements at the startup period, after the immediate one",
             not_of_cyclone(implementation));
  visit.knob("startup_period", spdp.startup_period, period_range,
             "announcement period during startup");
  visit.knob("resend", spdp.resend, ChoiceType<SpdpResend>{},
             "what is sent when a participant is recognised for the first time",
             not_of_cyclone(implementation));
  visit.knob("payload_bytes", spdp.payload_bytes, packet_bytes, "UDP payload of an announcement",
             of_sizes(implementation));
  visit.knob("directed_replies", spdp.directed_replies, count_range(0, 1'000'000),
             "announcements to a participant that is recognised for the first time",
             of_cyclone(implementation));
  visit.knob("directed_reply_interval", spdp.directed_reply_interval, period_range,
             "between two of these announcements", of_cyclone(implementation));
  const Presence pruning =
      of_cyclone(implementation) == Presence::required ? Presence::optional : Presence::of_others;
  visit.knob("initial_prune_delay", spdp.initial_prune_delay, period_range,
             "how long peers at which nobody is known are announced to after the start; for ever "
             "if absent, as by versions before 11",
             pruning);
  visit.knob(
      "discovered_prune_delay", spdp.discovered_prune_delay, period_range,
      "how long participants that were forgotten are announced to; for ever if absent, as by "
      "versions before 11",
      pruning);
  visit.knob("lease", spdp.lease, period_range,
             "how long others remember a participant of which they hear nothing; it acts where "
             "somebody leaves or the network fails (deployment.life)",
             of_programs(implementation));
}

constexpr void visit_knobs(auto& visit, Is<AdaptiveProfile> auto& adaptive) {
  visit.knob("min_period", adaptive.min_period, period_range, "least HEARTBEAT period (T_min)");
  visit.knob("max_period", adaptive.max_period, period_range, "greatest HEARTBEAT period (T_max)");
  visit.knob("epsilon", FractionParts{adaptive.epsilon_numerator, adaptive.epsilon_denominator},
             FractionType{max_epsilon_denominator}, "floor of the share of responsive readers");
  visit.rule(adaptive.min_period <= adaptive.max_period, "min_period",
             "a period that does not exceed max_period");
}

/// Delays and periods of the SEDP endpoints; the first part of `sedp`.
constexpr void visit_sedp_timers(auto& visit, Is<SedpProfile> auto& sedp,
                                 ImplementationKind implementation) {
  const Presence required = not_of_cyclone(implementation);
  visit.knob("heartbeat_period", sedp.heartbeat_period, period_range,
             "periodic HEARTBEAT of a writer (tau_H)", required);
  visit.knob("heartbeat_response_delay", sedp.heartbeat_response_delay, delay_range,
             "from a HEARTBEAT to the ACKNACK that answers it (tau_A)", required);
  visit.knob("nack_response_delay", sedp.nack_response_delay, delay_range,
             "from an ACKNACK to the repair that it asks for (tau_N)", required);
  visit.knob("nack_suppression_duration", sedp.nack_suppression_duration, delay_range,
             "how long a repaired descriptor cannot be asked for again (tau_S)", required);
  visit.knob("initial_acknack_delay", sedp.initial_acknack_delay, delay_range,
             "until the first initial ACKNACK (tau_I); 0 disables them", required);
  visit.knob("initial_acknack_interval", sedp.initial_acknack_interval,
             ChoiceType<InitialAckNackInterval>{},
             "whether the delay between initial ACKNACKs doubles each time or stays",
             not_of_cyclone(implementation, Presence::defaulted));
}

/// What Cyclone DDS has instead.
constexpr void visit_cyclone_sedp(auto& visit, Is<SedpProfile> auto& sedp,
                                  ImplementationKind implementation) {
  const Presence required = of_cyclone(implementation);
  visit.knob("heartbeat_interval", sedp.heartbeat_interval, period_range,
             "between two HEARTBEATs of a writer, the first ones (HeartbeatInterval)", required);
  visit.knob("heartbeat_interval_max", sedp.heartbeat_interval_max, period_range,
             "which the interval stays below as it doubles (HeartbeatInterval[@max])", required);
  visit.knob("match_heartbeat_delay", sedp.match_heartbeat_delay, delay_range,
             "from a match to the HEARTBEAT that it asks for", required);
  visit.knob("ack_delay", sedp.ack_delay, delay_range,
             "between two ACKNACKs that say the same (AckDelay)", required);
  visit.knob("nack_delay", sedp.nack_delay, delay_range,
             "between two requests for the same (NackDelay)", required);
  visit.knob("auto_resched_nack_delay", sedp.auto_resched_nack_delay, period_range,
             "until a reader asks again by itself (AutoReschedNackDelay)", required);
  visit.knob("preemptive_ack_delay", sedp.preemptive_ack_delay, delay_range,
             "from a match to the pre-emptive ACKNACK (PreEmptiveAckDelay)", required);
  visit.knob("max_message_size", sedp.max_message_size, packet_bytes,
             "UDP payload that a packet is filled to (MaxMessageSize)", required);
  visit.knob("max_rexmit_message_size", sedp.max_rexmit_message_size, packet_bytes,
             "the same if there is a retransmission in it (MaxRexmitMessageSize)", required);
  visit.knob("max_queued_rexmit_messages", sedp.max_queued_rexmit_messages,
             count_range(0, 1'000'000),
             "retransmissions that a participant queues (MaxQueuedRexmitMessages)", required);
  const Presence defaulted = required == Presence::required ? Presence::defaulted : required;
  visit.knob("merge_queued_rexmit", sedp.merge_queued_rexmit, ChoiceType<MergeQueued>{},
             "whether a retransmission that is queued for another reader goes to all instead; true "
             "if absent",
             defaulted);
  visit.knob("notification", sedp.notification, ChoiceType<Notification>{},
             "whether samples that are newer than the first HEARTBEAT are told before older ones "
             "that are missing; in_order if absent",
             defaulted);
}

/// How relations open, repair and acknowledge; the second part of `sedp`.
constexpr void visit_sedp_rules(auto& visit, Is<SedpProfile> auto& sedp,
                                ImplementationKind implementation) {
  const Presence of_rule = of_rules(implementation);
  visit.knob("relation_opening", sedp.relation_opening, ChoiceType<RelationOpening>{},
             "when the writer side opens: with the receiver's recognition, or with its own",
             of_rule);
  visit.knob("initial_data", sedp.initial_data, ChoiceType<InitialData>{},
             "whether descriptors are sent when a relation opens, or only when asked for", of_rule);
  visit.knob("unmatched", sedp.unmatched, ChoiceType<Unmatched>{},
             "what a reader side that is not open does with DATA and HEARTBEATs (with each_side)",
             of_rule);
  visit.knob("initial_acknack", sedp.initial_acknack, ChoiceType<InitialAckNackReply>{},
             "what a writer does with an initial ACKNACK", of_rule);
  visit.knob("acknowledge", sedp.acknowledge, ChoiceType<Acknowledge>{},
             "what an ACKNACK confirms: all outside its bitmap, or only the contiguous prefix",
             of_rule);
  visit.knob("heartbeat_timer", sedp.heartbeat_timer, ChoiceType<HeartbeatTimerKind>{},
             "one pending periodic HEARTBEAT per writer, or one more for each suppression end",
             of_rule);
  visit.knob("heartbeat_recipients", sedp.heartbeat_recipients, ChoiceType<HeartbeatRecipients>{},
             "who receives a periodic HEARTBEAT", of_rule);
  visit.knob("heartbeat_policy", sedp.heartbeat_policy, ChoiceType<HeartbeatPolicy>{},
             "fixed period, or the response-aware policy", not_of_cyclone(implementation));
  visit.section("adaptive", sedp.adaptive, "the response-aware HEARTBEAT policy",
                not_of_cyclone(implementation));
}

/// How DATA shares packets, and what packets weigh; the last part of `sedp`.
constexpr void visit_sedp_packets(auto& visit, Is<SedpProfile> auto& sedp,
                                  ImplementationKind implementation) {
  const Presence of_size = of_sizes(implementation);
  visit.knob("grouping", sedp.grouping, ChoiceType<Grouping>{},
             "how descriptors share packets: up to a limit, one MTU, or one a packet", of_size);
  visit.knob("grouping_limit_bytes", sedp.grouping_limit_bytes, packet_bytes,
             "largest UDP payload of a packet with grouping: message, or that fastdds fills",
             of_size == Presence::required ? Presence::required
                                           : not_of_cyclone(implementation, Presence::defaulted));
  visit.knob("piggyback", sedp.piggyback, ChoiceType<Piggyback>{},
             "what DATA is charged against the threshold of the piggyback HEARTBEAT",
             not_of_cyclone(implementation));
  visit.knob("piggyback_threshold_bytes", sedp.piggyback_threshold_bytes,
             byte_range(0, 1'000'000'000'000), "bytes that a writer may send without a HEARTBEAT",
             not_of_cyclone(implementation));
  visit.knob("heartbeat_bytes", sedp.heartbeat_bytes, packet_bytes,
             "UDP payload of a HEARTBEAT of its own", of_size);
  visit.knob("acknack_bytes", sedp.acknack_bytes, packet_bytes,
             "UDP payload of an ACKNACK with no bitmap", of_size);
  visit.knob("piggyback_heartbeat_bytes", sedp.piggyback_heartbeat_bytes, packet_bytes,
             "what a HEARTBEAT adds to a packet with DATA", of_size);
  visit.knob("shared_header_bytes", sedp.shared_header_bytes, packet_bytes,
             "RTPS header and INFO_DST, once per packet", of_size);
}

constexpr void visit_knobs(auto& visit, Is<SedpProfile> auto& sedp,
                           ImplementationKind implementation) {
  visit_sedp_timers(visit, sedp, implementation);
  visit_sedp_rules(visit, sedp, implementation);
  visit_sedp_packets(visit, sedp, implementation);
  visit_cyclone_sedp(visit, sedp, implementation);
}

constexpr void visit_knobs(auto& visit, Is<DescriptorProfile> auto& descriptors) {
  visit.knob("default_publications", descriptors.default_publications, count_range(0, 100'000),
             "publications of a participant without user endpoints");
  visit.knob("default_subscriptions", descriptors.default_subscriptions, count_range(0, 100'000),
             "subscriptions of a participant without user endpoints");
  visit.knob(
      "default_bytes", descriptors.default_bytes, BytesPairType{packet_bytes},
      "UDP payload of the first and the last default descriptor, each in a packet of its own");
  visit.knob("user_bytes", descriptors.user_bytes, packet_bytes,
             "UDP payload of a user endpoint's descriptor in a packet of its own");
}

template <>
inline constexpr std::array<std::string_view, 4> enum_names<InitialAckNackRepeat>{
    "again", "once", "age_based", "age_based_zero"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<InitialAckNackStop>{"any_heartbeat",
                                                                                "complete"};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<AckedRequest>{"ignore", "reopen",
                                                                          "resend"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<HeartbeatCondition>{"not_acknowledged",
                                                                                "in_u"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<AmendedPolicy>{"of_the_profile",
                                                                           "measured_ack"};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<RepairHeartbeat>{"none", "before",
                                                                             "after"};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<AckNackReply>{"none", "nonfinal",
                                                                          "all"};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<OnReannounce>{"none", "ack_highest",
                                                                          "ack_missing"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<LateInitial>{"reset",
                                                                         "ignore_after_ack"};
template <>
inline constexpr std::array<std::string_view, 5> enum_names<StaleAckNack>{
    "process", "latest_only", "required_drop", "required_gate", "required_at_repair"};
template <>
inline constexpr std::array<std::string_view, 3> enum_names<ReaderRetry>{"off", "after_nack",
                                                                         "whenever_missing"};
template <>
inline constexpr std::array<std::string_view, 2> enum_names<PiggybackAccount>{"of_the_profile",
                                                                              "linear_group"};

constexpr void visit_knobs(auto& visit, Is<Amendments> auto& rules) {
  const Presence defaulted = Presence::defaulted;
  visit.knob("initial_acknack_resets", rules.initial_acknack_resets, ChoiceType<Whether>{},
             "whether an initial ACKNACK un-acknowledges everything; false if absent", defaulted);
  visit.knob("initial_acknack_arms", rules.initial_acknack_arms, ChoiceType<Whether>{},
             "whether its HEARTBEAT is followed by periodic ones; false if absent", defaulted);
  visit.knob("initial_acknack_repeat", rules.initial_acknack_repeat,
             ChoiceType<InitialAckNackRepeat>{},
             "what follows an initial ACKNACK; another one (again) if absent", defaulted);
  visit.knob("initial_acknack_stop", rules.initial_acknack_stop, ChoiceType<InitialAckNackStop>{},
             "what ends initial ACKNACKs; any_heartbeat if absent", defaulted);
  visit.knob("match_clock_skew", rules.match_clock_skew, delay_range,
             "by how much the creation of a match lies in the future; 0 if absent", defaulted);
  visit.knob("late_initial", rules.late_initial, ChoiceType<LateInitial>{},
             "what an initial ACKNACK is after an ordinary one; reset if absent", defaulted);
  visit.knob("acked_request", rules.acked_request, ChoiceType<AckedRequest>{},
             "what a writer does with a request for what is acknowledged; ignore if absent",
             defaulted);
  visit.knob("heartbeat_condition", rules.heartbeat_condition, ChoiceType<HeartbeatCondition>{},
             "which descriptors keep the periodic HEARTBEAT going; not_acknowledged if absent",
             defaulted);
  visit.knob("heartbeat_policy", rules.heartbeat_policy, ChoiceType<AmendedPolicy>{},
             "how long until the next HEARTBEAT; as sedp.heartbeat_policy says if absent, or by "
             "how long readers take to answer",
             defaulted);
  visit.knob("suppression_end_arms", rules.suppression_end_arms, ChoiceType<Whether>{},
             "whether the end of a suppression arms the HEARTBEAT; true if absent", defaulted);
  visit.knob("repair_heartbeat", rules.repair_heartbeat, ChoiceType<RepairHeartbeat>{},
             "whether a repair sends a HEARTBEAT, before or after its DATA; none if absent",
             defaulted);
  visit.knob("acknack_reply", rules.acknack_reply, ChoiceType<AckNackReply>{},
             "which ACKNACKs are answered by a HEARTBEAT at once; none if absent", defaulted);
  visit.knob("stale_acknack", rules.stale_acknack, ChoiceType<StaleAckNack>{},
             "what a writer does with an ACKNACK that answers an old HEARTBEAT; process if absent",
             defaulted);
  visit.knob("count_filter", rules.count_filter, count_range(0, 1'000'000),
             "ACKNACKs of a reader that forgot that count as old; 0 if absent", defaulted);
  visit.knob("on_reannounce", rules.on_reannounce, ChoiceType<OnReannounce>{},
             "what a reader says when somebody known announces itself; none if absent", defaulted);
  visit.knob("reader_retry", rules.reader_retry, ChoiceType<ReaderRetry>{},
             "when a reader asks again by itself; off if absent", defaulted);
  visit.knob("reader_retry_period", rules.reader_retry_period, period_range,
             "after which it does; 3s if absent", defaulted);
  visit.knob("reader_nack_delay", rules.reader_nack_delay, delay_range,
             "between two requests of a reader; 0, no such limit, if absent", defaulted);
  visit.knob("resend_copies", rules.resend_copies, count_range(1, 1'000),
             "copies of the announcement to a participant that is recognised, with resend: "
             "new_only; 1 if absent",
             defaulted);
  visit.knob("resend_copy_period", rules.resend_copy_period, period_range,
             "between two of them; 1s if absent", defaulted);
  visit.knob("piggyback_account", rules.piggyback_account, ChoiceType<PiggybackAccount>{},
             "what DATA is charged to: as piggyback says if absent, or one counter of the "
             "participant that loses the threshold at each overflow",
             defaulted);
}

/// Of the amended rules.
[[nodiscard]] constexpr Presence with_amendments(ImplementationKind implementation) {
  return traits_of(implementation).can_be_amended ? Presence::optional : Presence::of_others;
}

/// Where a profile says whose writer it describes; the reader looks at it before anything else.
inline constexpr std::string_view implementation_key = "implementation";
/// And then at the way to discover.
inline constexpr std::string_view discovery_key = "discovery";

/// What a Discovery Server adds; keys of the profile itself, `kind` with its way to discover.
constexpr void visit_knobs(auto& visit, Is<ServerProfile> auto& server, ImplementationKind kind) {
  visit.knob("client_sync_period", server.client_sync_period, period_range,
             "until a client matches its endpoints with the server's (tau_T); 450ms if absent",
             with_server(kind));
  visit.knob("server_routine_period", server.server_routine_period, period_range,
             "until the server looks again who has acknowledged what (tau_R); 450ms if absent",
             with_server(kind));
  visit.knob("pdp_heartbeat_period", server.pdp_heartbeat_period, period_range,
             "periodic HEARTBEAT of participant announcements; 350ms if absent", with_server(kind));
  visit.knob("pdp_nack_response_delay", server.pdp_nack_response_delay, delay_range,
             "from an ACKNACK to the announcement that it asks for; 100ms if absent",
             with_server(kind));
  visit.knob("pdp_nack_suppression_duration", server.pdp_nack_suppression_duration, delay_range,
             "how long a repeated announcement cannot be asked for again; 11ms if absent",
             with_server(kind));
  visit.knob("pdp_heartbeat_response_delay", server.pdp_heartbeat_response_delay, delay_range,
             "from such a HEARTBEAT to the ACKNACK that answers it; 11ms if absent",
             with_server(kind));
  visit.knob("relay", server.relay, ChoiceType<Relay>{},
             "whether the server sends what is not acknowledged again whenever something arrives; "
             "repeat if absent",
             with_server(kind));
  visit.knob("server_known", server.known, UsualChoiceType<ServerKnown>{{}, ServerKnown::guid},
             "what a client knows of the server before it hears of it: also who it is, or only "
             "where; guid if absent",
             with_server(kind));
  visit.knob(
      "rejoin", server.rejoin, UsualChoiceType<Rejoin>{{}, Rejoin::dropped},
      "whether the server relays a client that it hears of again while it still tells others "
      "that the client is gone (deployment.life): it is dropped, or known as anybody new; "
      "dropped if absent",
      with_server(kind));
}

/// What later versions of Fast DDS have; keys of the profile itself.
constexpr void visit_knobs(auto& visit, Is<VersionProfile> auto& version,
                           ImplementationKind implementation) {
  const Presence optional = with_discovery(implementation);
  visit.knob("match_order", version.match_order,
             UsualChoiceType<MatchOrder>{{}, MatchOrder::endpoints_first},
             "what opens first when a participant is recognised: its endpoints, or liveliness and "
             "what looks up types; endpoints_first if absent",
             optional);
  visit.knob("builtin_response_delay", version.builtin_response_delay,
             usually(delay_range, 5'000'000),
             "from a HEARTBEAT of liveliness or of what looks up types to the ACKNACK that answers "
             "it (tau_B); 5ms if absent",
             optional);
  visit.knob(
      "type_lookup", version.type_lookup, UsualChoiceType<Whether>{{}, Whether::no},
      "whether participants have endpoints that ask for types (TypeLookup service); false if "
      "absent",
      optional);
  visit.knob("typelookup_heartbeat_period", version.typelookup_heartbeat_period,
             usually(period_range, 350'000'000),
             "periodic HEARTBEAT of what asks for types and answers (tau_L); 350ms if absent",
             optional);
  visit.knob("typelookup_filter", version.typelookup_filter,
             UsualChoiceType<LookupFilter>{{}, LookupFilter::none},
             "which questions and answers about types go only to whom they are for, instead of to "
             "every participant: none, answers, or all; none if absent (no version has another)",
             optional);
  visit.knob("typelookup_unit", version.typelookup_unit,
             UsualChoiceType<LookupUnit>{{}, LookupUnit::type_and_stream},
             "what there is one question for: a type of a stream, a type, or all types of a "
             "participant that wait; type_and_stream if absent (no version has another)",
             optional);
  visit.knob("type_object_bytes", version.type_object_bytes, usually(byte_range(1, 65'000), 300),
             "DATA submessage that answers with a type; 300 if absent", optional);
  visit.knob("sizes", version.sizes, UsualChoiceType<SizesSince>{{}, SizesSince::v2_6},
             "announcements and descriptors have the sizes of this version and those after it; "
             "v2.6 if absent",
             optional);
  visit.knob("descriptor_extra_bytes", version.descriptor_extra_bytes,
             usually(byte_range(0, 65'000), 0),
             "more in each descriptor: type information and the hash of the type; if 0 or absent, "
             "nothing, "
             "or 188 with deployment.types",
             optional);
  visit.knob("statistics_bytes", version.statistics_bytes, usually(byte_range(0, 65'000), 0),
             "more in each packet: the submessage of the statistics module; 0 if absent", optional);
  visit.knob("max_data_per_message", version.max_data_per_message,
             usually(count_range(0, 1'000'000), 0),
             "DATA that a message takes, or 0: as many as fit; 0 if absent", optional);
}

/// How participants find each other.
constexpr void visit_discovery(auto& visit, Is<DdsProfile> auto& dds) {
  const ImplementationKind kind = kind_of(dds.implementation, dds.discovery);
  visit.knob(discovery_key, dds.discovery, UsualChoiceType<Discovery>{{}, Discovery::simple},
             "how participants find each other; simple if absent",
             with_discovery(dds.implementation));
  visit_knobs(visit, dds.server, kind);
  visit.knob("peer_ports", dds.peer_ports, count_range(1, 1'000),
             "ports of each host that announcements go to; 4 if absent", with_static_peers(kind));
  visit.knob("max_participants_per_host", dds.max_participants_per_host,
             usually(count_range(0, 1'000'000), 0),
             "participants of a host that find a port, or an index; if 0 or absent, as many as the "
             "library's own settings let start",
             of_programs(dds.implementation));
}

constexpr void visit_knobs(auto& visit, Is<DdsProfile> auto& dds) {
  visit.knob(implementation_key, dds.implementation, ChoiceType<ImplementationKind>{},
             "whose writer: the paper's, or that of Fast DDS or Cyclone DDS", Presence::optional);
  visit_discovery(visit, dds);
  visit_knobs(visit, dds.version, dds.implementation);
  visit.knob("allow_multicast", dds.allow_multicast, ChoiceType<AllowMulticast>{},
             "what goes to the multicast group: all that has several receivers, announcements, or, "
             "by default, the first on a wired network and the second on Wi-Fi; or nothing",
             of_cyclone(dds.implementation));
  visit.knob("peers", dds.peers, usually(count_range(0, 1'000), 0),
             "ports of each host that announcements go to (MaxAutoParticipantIndex); none, but for "
             "those of participants that are known, if 0 or absent",
             of_cyclone(dds.implementation) == Presence::required ? Presence::optional
                                                                  : Presence::of_others);
  visit.section("spdp", dds.spdp, "participant announcements", Presence::required,
                dds.implementation);
  visit.section("sedp", dds.sedp, "reliable exchange of endpoint descriptors", Presence::required,
                dds.implementation);
  visit.section("descriptors", dds.descriptors, "number and size of descriptors",
                of_sizes(dds.implementation));
  visit.section("amendments", dds.amendments,
                "rules that other implementations have or had, as changes of the paper's",
                with_amendments(dds.implementation));
  visit.knob("unmodelled", dds.unmodelled, TextMapType{},
             "settings of the real system that the model has not, and what they do there",
             Presence::optional);

  visit.rule(!dds.amendments || dds.amendments->stale_acknack == StaleAckNack::process ||
                 dds.sedp.piggyback == Piggyback::off,
             "amendments.stale_acknack",
             "process, or piggyback: off; HEARTBEATs in DATA have no number");
  visit.rule(
      !dds.amendments || dds.amendments->heartbeat_policy == AmendedPolicy::of_the_profile ||
          (dds.sedp.heartbeat_policy == HeartbeatPolicy::periodic &&
           dds.sedp.heartbeat_timer == HeartbeatTimerKind::single),
      "amendments.heartbeat_policy",
      "of_the_profile, or sedp.heartbeat_policy: periodic and heartbeat_timer: single, whose "
      "place it takes");

  visit.rule(dds.sedp.piggyback != Piggyback::group ||
                 with_discovery(dds.implementation) != Presence::of_others,
             "sedp.piggyback", "cumulative, linear or off; group is of implementation: fastdds");

  const Bytes header = dds.sedp.shared_header_bytes;
  const auto more = [header] {
    return fmt::format("more than the {} bytes of shared_header_bytes", header.count());
  };
  const auto& [first, last] = dds.descriptors.default_bytes;
  visit.rule(first > header && last > header, "descriptors.default_bytes", more());
  visit.rule(dds.descriptors.user_bytes > header, "descriptors.user_bytes", more());
}

}  // namespace stormproof::model::config
