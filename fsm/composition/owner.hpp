// Who has one of a thing that a composition is about: rules say it as a type, and a recorded
// program (fsm/program/program.hpp) as a value.
#pragma once

#include <cstdint>

namespace stormproof::fsm::composition {

/// Who has one of a thing: the set of indices that name it. Indices are no chain: Fast DDS's queue
/// has an entry per writer and descriptor, whoever reads it.
struct Owner {
  std::uint8_t indices = 0;

  bool operator==(const Owner&) const = default;
};
namespace owner {
inline constexpr std::uint8_t participant_index = 1;
inline constexpr std::uint8_t stream_index = 2;
inline constexpr std::uint8_t peer_index = 4;
inline constexpr std::uint8_t descriptor_index = 8;
inline constexpr std::uint8_t topic_index = 16;

inline constexpr Owner participant{participant_index};
/// A participant and a peer: what one advertises the other must learn.
inline constexpr Owner pair{participant_index | peer_index};
inline constexpr Owner writer{participant_index | stream_index};
/// A writer and one reader of it.
inline constexpr Owner relation{participant_index | stream_index | peer_index};
/// A descriptor of a writer, whoever reads it.
inline constexpr Owner entry{participant_index | stream_index | descriptor_index};
/// A descriptor of a writer towards one reader.
inline constexpr Owner descriptor{participant_index | stream_index | peer_index | descriptor_index};
/// A pair on one topic of which only the control traffic is modelled.
inline constexpr Owner control_relation{participant_index | peer_index | topic_index};
/// A participant's writer on such a topic, whoever reads it.
inline constexpr Owner control_writer{participant_index | topic_index};
}  // namespace owner

}  // namespace stormproof::fsm::composition
