// One RTPS message → events: interprets INFO_DST and INFO_SRC as a receiver does (RTPS 2.5, section
// 8.3.4), decodes what counts, and skips what does not, such as submessages of vendors.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/capture/ip_reassembly.hpp"
#include "checker/evidence/capture/remarks.hpp"

namespace stormproof::capture {

/// What a DATA of SPDP or SEDP said.
struct Description {
  std::uint32_t datagram = 0;
  GuidPrefix source{};
  EntityId writer = 0;
  std::int64_t sequence_number = 0;
  std::variant<ParticipantData, EndpointData> content{};
};

/// More than real captures have, so that hostile ones take bounded memory and time: submessages of
/// all captures together (each takes less than 1 KB until everything is counted), and participants
/// that they come from. What is beyond is left out with a remark.
struct ExtractionLimits {
  std::size_t events = 1U << 23U;
  std::size_t participants = 4096;
};

/// What was found in datagrams so far. Destinations are only those of INFO_DST.
struct Extraction {
  ExtractionLimits limits{};
  std::set<GuidPrefix> sources{};  ///< and whom they tell of
  std::vector<Event> events{};
  std::vector<Description> descriptions{};
  TypeLookups lookups{};
};

/// Of a message, beside its events.
struct Extracted {
  VendorId vendor = 0;
  std::uint32_t statistics_bytes = 0;  ///< of Fast DDS's statistics submessage
};

/// Adds the events of the message in `datagram`, which will be number `index`. Nothing if it holds
/// no RTPS message. `place` says where it is, for remarks.
std::optional<Extracted> extract(const Datagram& datagram, std::uint32_t index,
                                 const std::string& place, Extraction& extraction,
                                 Remarks& remarks);

}  // namespace stormproof::capture
