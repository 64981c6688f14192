// The RTPS message that a participant is filling: which readers it goes to, which descriptors of
// which writer it carries, and whether a HEARTBEAT rides in it. One message becomes one packet for
// each of its readers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "model/engine/descriptor_set.hpp"
#include "model/fastdds/endpoints.hpp"

namespace stormproof::model::fastdds {

struct Message {
  bool open = false;
  std::uint32_t writer = 0;            ///< as `Protocol` numbers them
  std::vector<std::uint32_t> readers;  ///< relations, in match order
  std::int64_t bytes = 0;              ///< UDP payload so far
  std::vector<std::uint64_t> descriptors;
  std::uint32_t data = 0;  ///< how many DATA
  std::uint16_t heartbeats = 0;
  std::uint32_t announced = 0;  ///< by its last HEARTBEAT; of samples, the last one in it as well
  // By reader: how many descriptors go to it for the first time, and how many again; of those of
  // other hosts.
  std::vector<std::uint32_t> initial_data;
  std::vector<std::uint32_t> repair_data;

  void start(std::uint32_t writer_, const std::vector<std::uint32_t>& readers_,
             std::uint32_t descriptor_count) {
    open = true;
    writer = writer_;
    readers = readers_;
    bytes = message_header_bytes + (readers.size() == 1 ? destination_bytes : 0);
    descriptors.assign(words_for(descriptor_count), 0);
    data = 0;
    heartbeats = 0;
    announced = 0;
    initial_data.assign(readers.size(), 0);
    repair_data.assign(readers.size(), 0);
  }

  [[nodiscard]] bool carries(std::uint32_t d) const {
    return (descriptors[d / 64] >> d % 64 & 1) != 0;
  }
  void add(std::uint32_t d, std::int64_t added_bytes) {
    descriptors[d / 64] |= std::uint64_t{1} << d % 64;
    bytes += added_bytes;
    ++data;
  }
};

}  // namespace stormproof::model::fastdds
