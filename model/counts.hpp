// Messages by class, counted at generation (paper, "Model Outputs").
#pragma once

#include <array>
#include <cstdint>

#include "model/message_class.hpp"

namespace stormproof::model {

struct Counts {
  std::uint64_t initial_data = 0;
  std::uint64_t repair_data = 0;
  std::uint64_t heartbeat = 0;
  std::uint64_t acknack = 0;
  std::uint64_t spdp_multicast = 0;
  std::uint64_t spdp_unicast = 0;
  // Only with a Discovery Server, whose announcements are reliable; 0 otherwise.
  std::uint64_t pdp_data = 0;  ///< DATA(p)
  std::uint64_t pdp_heartbeat = 0;
  std::uint64_t pdp_acknack = 0;
  std::uint64_t gap = 0;  ///< GAPs of the server; in no total
  /// Samples that ask for types, and answers, one for each receiver; in no total.
  std::uint64_t lookup = 0;

  [[nodiscard]] constexpr std::uint64_t& operator[](MessageClass one) {
    return this->*members[index_of(one)];
  }
  [[nodiscard]] constexpr std::uint64_t operator[](MessageClass one) const {
    return this->*members[index_of(one)];
  }

  [[nodiscard]] std::uint64_t total() const {
    return initial_data + repair_data + heartbeat + acknack + spdp_multicast + spdp_unicast +
           of_server();
  }
  /// What only a Discovery Server and its clients send.
  [[nodiscard]] std::uint64_t of_server() const { return pdp_data + pdp_heartbeat + pdp_acknack; }
  /// Both kinds of SPDP, which the paper's tables have in one class.
  [[nodiscard]] std::uint64_t spdp() const { return spdp_multicast + spdp_unicast; }
  bool operator==(const Counts&) const = default;

  /// Name and value of each class, in the order of reports.
  struct Entry {
    const char* name;
    std::uint64_t value;
  };
  [[nodiscard]] std::array<Entry, message_class_count> entries() const {
    std::array<Entry, message_class_count> all{};
    for (const MessageClass one : message_classes) {
      all[index_of(one)] = {name_of(one), (*this)[one]};
    }
    return all;
  }

 private:
  static const std::array<std::uint64_t Counts::*, message_class_count> members;
};

inline constexpr std::array<std::uint64_t Counts::*, message_class_count> Counts::members{
    &Counts::initial_data, &Counts::repair_data,    &Counts::heartbeat,
    &Counts::acknack,      &Counts::spdp_multicast, &Counts::spdp_unicast};

}  // namespace stormproof::model
