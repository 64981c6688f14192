// What an endpoint offers or requests, as its DATA(w) or DATA(r) says, and whether a writer's offer
// is enough for a reader (DDS 1.4, section 2.2.3, "requested/offered"). Endpoints of one topic that
// do not agree never match, however well discovery works.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "checker/evidence/capture/bytes.hpp"
#include "checker/evidence/capture/parameter_list.hpp"

namespace stormproof::capture {

/// What is not sent is the default of DDS.
struct EndpointQos {
  static constexpr std::int64_t infinite = INT64_MAX;

  std::optional<bool> is_reliable{};    ///< default: writers are, readers are not
  std::uint32_t durability = 0;         ///< volatile, transient local, transient, persistent
  std::int64_t deadline_ns = infinite;  ///< period
  std::uint32_t liveliness = 0;         ///< automatic, manual by participant, manual by topic
  std::int64_t liveliness_ns = infinite;
  bool is_exclusive = false;              ///< ownership
  std::uint32_t order = 0;                ///< by reception, by source
  std::vector<std::string> partitions{};  ///< empty: the one without a name

  bool operator==(const EndpointQos&) const = default;
};

/// Seconds and 2^-32 s; as many as there can be, or less than none, mean for ever.
[[nodiscard]] std::int64_t duration_ns(Cursor cursor);

/// Takes the parameter if it is one of these.
void read_qos(const Parameter& parameter, ByteOrder order, EndpointQos& qos);

/// One policy by which a reader refuses a writer: "reliability: offered best effort, requested
/// reliable".
[[nodiscard]] std::vector<std::string> disagreements(const EndpointQos& offered,
                                                     const EndpointQos& requested);

}  // namespace stormproof::capture
