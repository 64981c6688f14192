// The six message classes, counted at generation (paper, "Model Outputs").
#pragma once

#include <array>
#include <cstdint>

namespace stormproof::model {

struct Counts {
  std::uint64_t initial_data = 0;
  std::uint64_t repair_data = 0;
  std::uint64_t heartbeat = 0;
  std::uint64_t acknack = 0;
  std::uint64_t spdp_multicast = 0;
  std::uint64_t spdp_unicast = 0;

  [[nodiscard]] std::uint64_t total() const {
    return initial_data + repair_data + heartbeat + acknack + spdp_multicast + spdp_unicast;
  }
  bool operator==(const Counts&) const = default;

  /// Name and value of each class, in the order of reports.
  struct Entry {
    const char* name;
    std::uint64_t value;
  };
  [[nodiscard]] std::array<Entry, 6> entries() const {
    return {{{"initial_data", initial_data},
             {"repair_data", repair_data},
             {"heartbeat", heartbeat},
             {"acknack", acknack},
             {"spdp_multicast", spdp_multicast},
             {"spdp_unicast", spdp_unicast}}};
  }
};

}  // namespace stormproof::model
