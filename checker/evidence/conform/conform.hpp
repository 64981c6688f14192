// Whether a capture is a behaviour of a DDS profile, relation by relation. Captured submessages are
// the outputs of the protocol machines; what a capture cannot show (receptions, losses, timers,
// waiting) is existentially quantified within bounds: an event is explained if some assignment,
// replayed through the Boost.MSM machines of fsm/, makes them send exactly this at this time.
//
// What is checked: every captured SPDP and SEDP submessage between hosts needs a cause (safety),
// and what timers owe must come (the next announcement, a HEARTBEAT to a reader that has
// acknowledged nothing; initial ACKNACKs that go on come in time). What is not: that a received
// message was answered, if losses are allowed; causes on the sender's own host, which a capture
// between hosts does not show, are assumed where they suffice, and counted apart.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/conform/bounds.hpp"
#include "model/config/tree/result.hpp"
#include "model/dds_profile.hpp"
#include "model/units.hpp"

namespace stormproof::conform {

/// Why a captured event happens. specs/guide/conforming.md has each rule's text.
enum class Rule : std::uint8_t {
  announcement_scheduled,  ///< SPDP multicast by the announcement timer
  announcement_resent,     ///< SPDP because a participant was recognised
  announcement_copy,       ///< SPDP unicast to a known participant
  heartbeat_open,          ///< the writer side of the relation opens
  heartbeat_reply,         ///< answer to an initial ACKNACK
  heartbeat_periodic,      ///< the writer's timer expires while something is unacknowledged
  heartbeat_piggyback,     ///< the piggyback budget is used up by captured DATA
  heartbeat_same_host,     ///< by DATA to the sender's own host, which no capture shows
  data_push,               ///< the endpoint was created after the relation opened
  data_pull,               ///< first transmission, asked for by an ACKNACK
  data_repair,             ///< a later one, asked for while the descriptor is unacknowledged
  data_to_everybody,       ///< nobody asked here, but a reader was matched meanwhile
  acknack_reply,           ///< a HEARTBEAT arrived τ_A ago
  acknack_initial,         ///< no HEARTBEAT arrived for τ_I, doubled or constant
  // Of Cyclone DDS only.
  announcement_reply,  ///< directed SPDP to a participant that was recognised
  heartbeat_answer,    ///< to one reader, because of its ACKNACK
  heartbeat_on_write,  ///< rides on DATA
  data_merged,         ///< another reader's request made it one to all
  data_same_host,      ///< a reader on the sender's own host asked, which no capture shows
  acknack_again,       ///< AutoReschedNackDelay is over
  // Of a Discovery Server and its clients only.
  registration_scheduled,  ///< DATA(p) of a client by the announcement timer
  registration_tick,       ///< DATA(p) of a client that does not know the server yet
  registration_open,       ///< HEARTBEAT(p) when the server's announcements can be read
  registration_reply,      ///< HEARTBEAT(p), asked for by an initial ACKNACK(p)
  registration_periodic,   ///< HEARTBEAT(p), while nothing is acknowledged
  registration_acknack,    ///< the server answers a HEARTBEAT(p)
  registration_initial,    ///< or there was none for τ_I
  relay_open,              ///< HEARTBEAT when the server's writer opens to a client
  relay_reply,             ///< HEARTBEAT, asked for by an initial ACKNACK
  relay_periodic,          ///< HEARTBEAT while a client lacks something
  relay_heartbeat,         ///< rides on DATA, or on the GAP before it
  relay_data,              ///< a change is sent to a client for the first time
  relay_repair,            ///< or again, as it asked for it
  relay_gap,               ///< what a client need not have, before a DATA
  relay_gap_reply,         ///< or because it asked for it
  relay_gap_to_everybody,  ///< what no reader need have, before a DATA
  relay_acknack,           ///< a client answers a HEARTBEAT of the server
  relay_initial,           ///< or there was none for τ_I
  relay_answer             ///< the server's own DATA(p), to a client that has announced itself
};
inline constexpr std::size_t rule_count = 39;
/// "heartbeat.open", as reports write it.
[[nodiscard]] std::string_view name_of(Rule rule);
/// One sentence: when this rule sends.
[[nodiscard]] std::string_view statement_of(Rule rule);

/// What sends a packet in the composition that the profile's implementation executes.
struct Sender {
  std::string_view scope;   ///< a rule or procedure: "ReaderIsMatched"
  std::string_view packet;  ///< "Heartbeat"
  /// If several effects there send the packet: the condition right around the one that is meant, as
  /// the composition states it. Numbers of effects move when one comes before them.
  std::string_view condition{};

  auto operator<=>(const Sender&) const = default;
};
/// Whether the profile's implementation has the rule.
[[nodiscard]] bool is_rule_of(Rule rule, const model::DdsProfile& dds);
/// What can have sent an event that the rule explains; none: what the capture does not show.
[[nodiscard]] std::span<const Sender> senders_of(Rule rule);

/// What is wrong with an event that no rule explains.
enum class Fault : std::uint8_t {
  not_announced,            ///< before the peer's first announcement could have arrived
  not_opened,               ///< the writer sends to a reader to which it has not opened
  announcement_extra,       ///< neither scheduled nor caused by a recognition
  announcement_due,         ///< the announcement timer is overdue
  heartbeat_cause,          ///< no rule sends this HEARTBEAT
  heartbeat_range,          ///< announces less than there is, or does not start at 1
  heartbeat_copies,         ///< does not go to every reader that the writer has opened to
  heartbeat_due,            ///< the writer's timer is overdue
  heartbeat_count,          ///< the counts of a writer's HEARTBEATs do not grow, or leave some out
  data_cause,               ///< neither pushed nor asked for
  data_order,               ///< pushed before a smaller number, or one is left out
  data_early,               ///< asked for, but less than τ_N (or τ_S after the last copy) ago
  data_acknowledged,        ///< sent after its acknowledgment has arrived
  gap_cause,                ///< a GAP of what nobody asked for, or need not have before a DATA
  acknack_cause,            ///< no HEARTBEAT can have arrived that it answers
  acknack_early,            ///< less than τ_A after the HEARTBEAT, or after the previous ACKNACK
  acknack_count,            ///< the counts of a reader's ACKNACKs do not grow, or leave some out
  acknack_content,          ///< base or bitmap differ from what can have arrived
  initial_early,            ///< initial ACKNACK before its time
  initial_late,             ///< initial ACKNACK after its time
  initial_after_heartbeat,  ///< initial ACKNACK although a HEARTBEAT was answered before
  unanswered,               ///< received, and not answered in time (only without losses)
  other_version,            ///< another version's announcements than the profile's
  lookup_cause,             ///< a question or an answer about types that has no cause
  number_beyond,            ///< a sequence number beyond all belief; such an event is set aside
  no_such_rule  ///< the profile has nothing that sends this (DATA_FRAG, another vendor's, …)
};
inline constexpr std::size_t fault_count = 26;
[[nodiscard]] std::string_view name_of(Fault fault);

/// A relation, or a participant's own affairs if there is no destination.
struct Place {
  std::size_t source = 0;                    ///< index in Topology::participants, the writer
  std::optional<std::size_t> destination{};  ///< the reader
  capture::EntityId writer = 0;              ///< SPDP writer, or an SEDP writer

  auto operator<=>(const Place&) const = default;
};

/// A bound that would have to be different for the nearest assignment to explain the event.
struct Need {
  std::string what{};  ///< "send lag", "lateness", "clock error", or in words what would have to be
  std::optional<std::int64_t> needed_ns{};
  std::optional<std::int64_t> bound_ns{};
};

/// An event that no assignment explains.
struct Unexplained {
  std::size_t event = 0;  ///< index in Conversation::events
  Fault fault{};
  Place place{};
  std::string what{};         ///< "ACKNACK 7 of the subscriptions asks for …"
  std::string nearest{};      ///< the nearest assignment, in words
  std::vector<Need> needs{};  ///< what it would need
  /// Captured events of the same place that matter for it, in time order, `event` among them.
  std::vector<std::size_t> context{};
};

/// A hidden event of the assignment that explains the capture.
struct Hidden {
  /// `dropped`: arrived before the reader side opened.
  enum class Kind : std::uint8_t { received, lost, dropped, still_under_way, recognised, timer };
  Kind kind{};
  std::int64_t time_ns = 0;
  std::optional<std::size_t> event{};  ///< the captured event that was received or lost
  Place place{};
  std::string_view machine{};  ///< whose timer
};
[[nodiscard]] std::string_view name_of(Hidden::Kind kind);

struct RowUse {
  std::string_view machine{};
  std::size_t row = 0;  ///< in MachineInfo::rows
  std::string text{};   ///< "U + AckNackReceived [Requests] / Request → R"
  std::uint64_t times = 0;
};

struct PlaceResult {
  Place place{};
  std::uint64_t explained = 0;    ///< events
  std::uint64_t lost = 0;         ///< datagrams that the assignment loses
  std::uint64_t unexplained = 0;  ///< 0 or 1: a place is not followed beyond its first
};

enum class Verdict : std::uint8_t { conforms, does_not_conform, inconclusive };
[[nodiscard]] std::string_view name_of(Verdict verdict);

struct Conformance {
  Verdict verdict{};
  std::string why_inconclusive{};  ///< interrupted, or a search that was given up
  Bounds bounds{};
  std::uint64_t checked = 0;  ///< events that needed a cause
  std::uint64_t explained = 0;
  /// Explanations that the machines did not confirm when they were replayed; the verdict is
  /// inconclusive then, never "conforms".
  std::uint64_t not_replayed = 0;
  /// Relations for which the search for an assignment was given up; inconclusive, too.
  std::uint64_t undecided = 0;
  /// Events outside what is checked: same host, user endpoints, liveliness, unknown destinations.
  std::uint64_t not_checked = 0;
  std::array<std::uint64_t, rule_count> by_rule{};
  /// The same by what sent them in the composition; without those that are put down to what the
  /// capture does not show.
  std::map<Sender, std::uint64_t> by_sender{};
  std::vector<Unexplained> unexplained{};  ///< in time order, the first of each place
  std::vector<PlaceResult> places{};       ///< by source, destination, writer
  std::vector<RowUse> rows{};              ///< of the machines that take part, in table order
  std::uint64_t lost = 0;                  ///< datagrams that the assignment loses
  /// What explaining took of the bounds: the longest that were needed.
  std::int64_t used_send_lag_ns = 0;
  std::int64_t used_lateness_ns = 0;
  std::int64_t used_clock_age_ns = 0;
  std::vector<Hidden> hidden{};  ///< the assignment, in time order
  std::vector<std::string> assumptions{};
};

struct Request {
  const capture::Conversation& conversation;
  std::int64_t until_ns = INT64_MAX;  ///< later events are not looked at
  model::DdsProfile dds{};
  Bounds bounds{};
  /// Called before each relation; false stops.
  std::function<bool(std::size_t done, std::size_t all)> progress{};
  std::function<bool()> interrupted{};  ///< the same, asked by any thread during long searches
};

/// Why no capture can be held against the profile; nothing if one can.
[[nodiscard]] std::optional<std::string> refuse_profile(const model::DdsProfile& dds);

/// An error if the capture holds no discovery between hosts, or the profile describes an
/// implementation that cannot be held against a capture.
[[nodiscard]] model::config::Result<Conformance> conform(const Request& request);

}  // namespace stormproof::conform
