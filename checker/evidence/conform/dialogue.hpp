// A conversation sorted by who talks to whom: what each writer sent to each reader, what the reader
// answered, and what each participant announced. Descriptors are numbered from 0 on: sequence
// number 1 is descriptor 0. Only what goes from host to host is here.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/conform/conform.hpp"

namespace stormproof::conform {

struct Heartbeat {
  std::int64_t first = 0;       ///< sequence number
  std::uint32_t announced = 0;  ///< descriptors that the writer has
  std::uint32_t count = 0;
  bool is_directed = false;  ///< names its reader (INFO_DST)
  bool is_final = false;
};

/// One DATA, HEARTBEAT or GAP from the writer of a relation to its reader.
struct Submessage {
  std::int64_t time_ns = 0;
  std::size_t event = 0;
  std::uint32_t datagram = 0;
  std::optional<std::uint32_t> descriptor{};  ///< DATA
  std::optional<Heartbeat> heartbeat{};
  bool is_multicast = false;  ///< the same event is in the relations to all other hosts
  /// GAP: descriptors that the reader need not have, ascending.
  std::vector<std::uint32_t> gap{};
};

/// An ACKNACK from the reader of a relation to its writer.
struct Answer {
  std::int64_t time_ns = 0;
  std::size_t event = 0;
  std::uint32_t base = 0;                ///< every descriptor below it has arrived
  std::vector<std::uint32_t> missing{};  ///< ascending
  bool is_initial = false;
  std::uint32_t count = 0;

  [[nodiscard]] bool asks_for(std::uint32_t descriptor) const;
};

/// One writer's side and one reader's side.
struct Relation {
  Place place{};
  std::vector<Submessage> sent{};  ///< by the writer, in order
  std::vector<Answer> answers{};
};

struct Announcement {
  std::int64_t time_ns = 0;
  std::size_t event = 0;
  std::optional<std::size_t> destination{};  ///< nothing: multicast
};

/// An event that names a sequence number which its writer cannot have reached: a damaged capture,
/// or a forged message. It belongs to no relation: what it claims would have to be followed.
struct Beyond {
  std::size_t event = 0;
  Place place{};
  std::int64_t number = 0;
  std::int64_t most = 0;  ///< that is believed of this writer
};

/// The highest sequence number that is believed of a writer of which the capture shows DATA with so
/// many different numbers. Participants have tens of endpoints; the capture need not show all of
/// them (a late reader, an early end), but not so few of so many.
[[nodiscard]] constexpr std::int64_t believable(std::size_t shown) {
  return 10'000 + 10 * static_cast<std::int64_t>(shown);
}

struct Dialogue {
  const capture::Conversation& conversation;
  std::vector<Relation>
      relations{};  ///< those in which something was sent; those of one writer in a row
  std::vector<std::vector<Announcement>> announcements{};  ///< by participant, in time order
  std::vector<bool> has_neighbour{};                       ///< another participant on the same host
  std::vector<std::size_t> strange{};  ///< events that no rule can send, by time
  std::vector<std::size_t> crowded{};  ///< DATA beyond the most of a message, by time
  std::vector<Beyond> beyond{};        ///< by time
  /// most that was announced, by participant and stream
  std::vector<std::array<std::uint32_t, 3>> descriptors{};
  std::uint64_t checked = 0;
  std::uint64_t not_checked = 0;
  std::int64_t end_ns = 0;  ///< of what is looked at
  /// Why what follows `end_ns` is not looked at, as a sentence without a full stop; null: all is.
  const char* ends_early = nullptr;
  std::optional<std::size_t> server{};  ///< with `has_server`, if the capture shows it

  /// When `from` can have been announced to `to` first: the time of that announcement's capture.
  [[nodiscard]] std::optional<std::int64_t> first_announced(std::size_t from, std::size_t to) const;
  /// The last thing that the participant sends: as long as it does, its timers go on.
  [[nodiscard]] std::optional<Announcement> last_sign_of(std::size_t participant) const;
  [[nodiscard]] std::size_t participants() const { return announcements.size(); }
};

/// 0: publications, 1: subscriptions, 2: announcements, which are reliable with a server.
[[nodiscard]] inline std::size_t stream_index(capture::EntityId writer) {
  if (writer == capture::entity::spdp_writer) return 2;
  return writer == capture::entity::publications_writer ? 0 : 1;
}
/// How many descriptors the writer has announced, at most.
[[nodiscard]] inline std::uint32_t descriptors_of(const Dialogue& dialogue, const Place& writer) {
  return dialogue.descriptors[writer.source][stream_index(writer.writer)];
}

/// By which rules the two sides of a relation go.
enum class RelationKind : std::uint8_t {
  descriptors,   ///< of a participant, to another one or to its Discovery Server
  registration,  ///< of a client with its server: announcements
  relay          ///< what the server passes on to a client
};
[[nodiscard]] inline RelationKind kind_of(const Dialogue& dialogue, const Place& place) {
  if (dialogue.server == place.source) return RelationKind::relay;
  return place.writer == capture::entity::spdp_writer ? RelationKind::registration
                                                      : RelationKind::descriptors;
}

/// When participant `i` can know participant `j`: the capture of j's first announcement to it. A
/// multicast reaches participants on the same host, too.
[[nodiscard]] std::optional<std::int64_t> known_since(const Dialogue& dialogue, std::size_t i,
                                                      std::size_t j, const Bounds& bounds);

/// What else than DATA to a reader is not strange.
struct Sorting {
  bool sedp_multicast = false;  ///< DATA and HEARTBEATs of SEDP to the group
  /// Announcements are reliable, there are GAPs, and everything goes to the server or comes from
  /// it.
  bool has_server = false;
  /// Questions about types and answers; they are not looked at.
  bool lookups = true;
  std::uint32_t max_data_per_message = 0;  ///< 0: as many as fit
};
[[nodiscard]] Dialogue sort_out(const capture::Conversation& conversation, std::int64_t until_ns,
                                Sorting sorting = {});

}  // namespace stormproof::conform
