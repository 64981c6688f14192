// One RTPS message → events: interprets INFO_DST and INFO_SRC as a receiver does (RTPS 2.5, section
// 8.3.4), decodes what counts, and skips what does not, such as submessages of vendors.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/capture/ip_reassembly.hpp"
#include "checker/evidence/capture/remarks.hpp"

namespace stormproof::capture {

/// What a DATA of SPDP or SEDP said.
using Content = std::variant<ParticipantData, EndpointData>;

/// Each different one once: a storm repeats the same few thousand times.
class Contents {
 public:
  /// The number of this content, whose payload is given; it is new or was there before.
  std::uint32_t number_of(Bytes payload, Content content);
  [[nodiscard]] const Content& operator[](std::uint32_t number) const { return all_[number]; }

 private:
  std::deque<Content> all_;
  std::multimap<std::uint64_t, std::uint32_t> by_digest_;
};

/// That a DATA of SPDP or SEDP said something.
struct Description {
  std::uint32_t datagram = 0;
  std::uint32_t content = 0;  ///< number in Extraction::contents
  GuidPrefix source{};
  EntityId writer = 0;
  std::int64_t sequence_number = 0;
};

/// More participants than real captures have, so that hostile ones take bounded memory and time.
/// What comes from others is left out with a remark.
struct ExtractionLimits {
  std::size_t participants = 4096;
};

/// What was found in datagrams so far. Destinations are only those of INFO_DST.
struct Extraction {
  ExtractionLimits limits{};
  std::set<GuidPrefix> sources{};  ///< and whom they tell of
  std::deque<Event> events{};
  std::deque<Description> descriptions{};
  Contents contents{};
  TypeLookups lookups{};
  /// Who sends DATA of users' topics from where, and in which datagrams first and last.
  std::map<std::pair<GuidPrefix, Address>, std::pair<std::uint32_t, std::uint32_t>> user_sources{};
};

/// Of a message, beside its events.
struct Extracted {
  VendorId vendor = 0;
  std::uint32_t statistics_bytes = 0;  ///< of Fast DDS's statistics submessage
  UserData user{};
};

/// Adds the events of the message in `datagram`, which will be number `index`. Nothing if it holds
/// no RTPS message. `place` says where it is, for remarks.
std::optional<Extracted> extract(const Datagram& datagram, std::uint32_t index,
                                 const std::string& place, Extraction& extraction,
                                 Remarks& remarks);

}  // namespace stormproof::capture
