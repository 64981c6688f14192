// The six classes of discovery messages (paper, "Model Outputs"): one list of them, with the names
// that files have and the words that people read, for whoever counts, compares or shows messages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace stormproof::model {

/// In the order of reports.
enum class MessageClass : std::uint8_t {
  initial_data,
  repair_data,
  heartbeat,
  acknack,
  spdp_multicast,
  spdp_unicast
};
inline constexpr std::array<MessageClass, 6> message_classes{
    MessageClass::initial_data, MessageClass::repair_data,    MessageClass::heartbeat,
    MessageClass::acknack,      MessageClass::spdp_multicast, MessageClass::spdp_unicast};
inline constexpr std::size_t message_class_count = message_classes.size();

[[nodiscard]] constexpr std::size_t index_of(MessageClass one) {
  return static_cast<std::size_t>(one);
}

/// "initial_data", the key in JSON.
[[nodiscard]] constexpr const char* name_of(MessageClass one) {
  constexpr std::array<const char*, message_class_count> names{
      "initial_data", "repair_data", "heartbeat", "acknack", "spdp_multicast", "spdp_unicast"};
  return names[index_of(one)];
}

/// "initial DATA", for people.
[[nodiscard]] constexpr const char* words_of(MessageClass one) {
  constexpr std::array<const char*, message_class_count> words{
      "initial DATA", "repair DATA", "HEARTBEAT", "ACKNACK", "SPDP multicast", "SPDP unicast"};
  return words[index_of(one)];
}

}  // namespace stormproof::model
