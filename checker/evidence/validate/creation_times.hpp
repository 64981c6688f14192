// When a participant had created its last endpoint, as far as its messages prove it. A capture does
// not show creations; it shows HEARTBEATs, which announce what their writer has at that moment, and
// DATA, which cannot be older than the endpoint that it describes:
//
// * a HEARTBEAT that announces less than the last descriptor was sent before its creation,
// * one that announces it, or its first DATA, was sent after it,
// * DATA that no HEARTBEAT has announced and nobody has asked for is pushed when its endpoint is
//   created: its first copy is sent at that moment, and all later descriptors of the writer are
//   created after it.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "checker/evidence/capture/events.hpp"
#include "model/units.hpp"

namespace stormproof::validate {

/// A descriptor whose creation the capture shows.
struct Creation {
  model::Stream stream{};
  std::int64_t number = 0;   ///< sequence number, from 1 on
  std::int64_t time_ns = 0;  ///< since 1970
};

/// What is known of one participant's creations. Times are ns since 1970.
struct CreationTimes {
  std::int64_t last_earliest = 0;  ///< the last creation is not earlier
  std::int64_t last_latest = 0;    ///< nor later
  std::vector<Creation> seen{};    ///< in the order of time
};

/// For each participant that described an endpoint until `until_ns`.
[[nodiscard]] std::map<capture::GuidPrefix, CreationTimes> creation_times(
    const capture::Conversation& conversation, std::int64_t until_ns);

}  // namespace stormproof::validate
