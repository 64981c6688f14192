// What is compared: the same figures of a captured discovery and of each run of the model, by the
// same rules (specs/guide/validating.md). One list, so that no report can compare a figure with
// another one.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "checker/evidence/capture/counting.hpp"

namespace stormproof::validate {

enum class Figure : std::uint8_t {
  completion,  ///< ns from the first announcement to the cut
  total,       ///< of the six classes, and of `pdp_data` to `pdp_acknack`
  initial_data,
  repair_data,
  heartbeat,
  acknack,
  spdp_multicast,
  spdp_unicast,
  initial_pulled,       ///< initial DATA that an ACKNACK had asked for; the others are pushed
  heartbeat_open,       ///< to a reader whose relation opens
  heartbeat_reply,      ///< to an initial ACKNACK
  heartbeat_piggyback,  ///< because of DATA that was sent
  heartbeat_periodic,   ///< by the timer of the writer
  acknack_initial,      ///< asks for nothing, acknowledges nothing
  acknack_negative,     ///< asks for something
  acknack_positive,     ///< only acknowledges
  datagrams,            ///< with a message of the six classes
  payload_bytes,        ///< their UDP payloads
  last_open,            ///< ns from the first announcement to the last `heartbeat_open`
  last_initial,         ///< ns from the first announcement to the last initial DATA
  user_control,         ///< HEARTBEATs and ACKNACKs of liveliness, topics, lookups
  // Only with a Discovery Server, whose announcements are reliable.
  pdp_data,  ///< DATA(p)
  pdp_heartbeat,
  pdp_acknack,
  gap  ///< in no total
};
inline constexpr std::size_t figure_count = 25;
inline constexpr std::size_t first_class_figure = 2;
static_assert(static_cast<std::size_t>(Figure::initial_data) == first_class_figure);

[[nodiscard]] constexpr std::size_t index_of(Figure figure) {
  return static_cast<std::size_t>(figure);
}
/// The figure of a message class.
[[nodiscard]] constexpr Figure figure_of(model::MessageClass one) {
  return static_cast<Figure>(first_class_figure + static_cast<std::size_t>(one));
}
/// Whether it is a time, in ns.
[[nodiscard]] constexpr bool is_time(Figure figure) {
  return figure == Figure::completion || figure == Figure::last_open ||
         figure == Figure::last_initial;
}
/// Whether only runs with a Discovery Server have it.
[[nodiscard]] constexpr bool is_of_server(Figure figure) { return figure >= Figure::pdp_data; }
/// "repair_data", the key in JSON.
[[nodiscard]] const char* name_of(Figure figure);
/// "repair DATA", for people.
[[nodiscard]] const char* label_of(Figure figure);

/// All figures of one discovery at one instant.
using Tally = std::array<std::uint64_t, figure_count>;

/// One message of a class more.
void add(Tally& tally, model::MessageClass one, std::uint64_t messages = 1);

/// One message more between a Discovery Server and a client, other than GAP.
void add_of_server(Tally& tally, Figure one);

/// The messages of each class, and all of them, that were sent until (k + 1) · step, for each k.
inline constexpr std::size_t growth_curves = model::message_class_count + 1;
using GrowthPoint = std::array<std::uint64_t, growth_curves>;
struct Growth {
  std::int64_t step_ns = 1;
  std::vector<GrowthPoint> points{};
};
/// The six classes and the total of a tally.
[[nodiscard]] GrowthPoint growth_point(const Tally& tally);
/// The figure of a curve.
[[nodiscard]] constexpr Figure figure_of_curve(std::size_t curve) {
  return curve < model::message_class_count ? figure_of(static_cast<model::MessageClass>(curve))
                                            : Figure::total;
}

/// UDP payloads of the datagrams with exactly one message of a class, by size.
using Sizes = std::array<std::map<std::uint32_t, std::uint64_t>, model::message_class_count>;

}  // namespace stormproof::validate
