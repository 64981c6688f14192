// What an RTPS message of Cyclone DDS carries: announcements, DATA, HEARTBEATs, ACKNACKs and GAPs,
// in any mixture, of any writers of its participant. Receivers read them one after the other.
#pragma once

#include <cstdint>

#include "model/engine/descriptor_set.hpp"

namespace stormproof::model {

struct Submessage {
  enum class Kind : std::uint8_t { spdp, data, heartbeat, acknack, gap };

  Kind kind{};
  bool directed = false;          ///< announcement, HEARTBEAT: meant for its receiver alone
  bool initial = false;           ///< ACKNACK: pre-emptive, before any HEARTBEAT was seen
  std::uint32_t participant = 0;  ///< who is announced, or whose writer this is about
  std::uint32_t writer = 0;       ///< which of its writers (model/cyclone/endpoints.hpp)
  std::uint32_t sample = 0;       ///< DATA: its number, from 0; HEARTBEAT: how many exist; ACKNACK:
                                  ///< how many lie below its base
  std::uint32_t first = 0;        ///< HEARTBEAT: how many of the first ones exist no more
  bool goodbye = false;           ///< announcement: the participant is gone
  std::int64_t count = 0;         ///< HEARTBEAT, ACKNACK
  DescriptorSet bitmap;           ///< ACKNACK: what is asked for; GAP: what exists no more
};

}  // namespace stormproof::model
