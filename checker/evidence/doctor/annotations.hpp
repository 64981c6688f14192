// What the causes of symptoms.hpp mean for single packets: a comment for each that was sent for one
// of them, which Wireshark shows beside the packet (specs/guide/wireshark.md). It begins with the
// program's name and the cause's id, so that filters find it: "stormproof: needless_repairs, …".
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "checker/evidence/capture/counting.hpp"

namespace stormproof::doctor {

/// By the number of the packet, from 1 on, that completed the datagram; of one capture.
using Annotations = std::map<std::uint64_t, std::string>;

[[nodiscard]] Annotations annotations(const capture::Conversation& conversation,
                                      const capture::Counting& counting);

}  // namespace stormproof::doctor
