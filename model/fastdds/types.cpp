// The list of endpoints whose types may be unknown, and the types that are common.
#include "model/fastdds/types.hpp"

namespace stormproof::model::fastdds {

namespace {

// Common types, by number. Those of services follow, then those of single participants.
constexpr std::uint32_t of_discovery_info = 0;
constexpr std::uint32_t of_rosout = 1;
constexpr std::uint32_t of_parameter_events = 2;
constexpr std::uint32_t of_user_topics = 3;
constexpr std::uint32_t first_of_services = 4;
constexpr std::uint32_t first_own = first_of_services + service_endpoints;

constexpr std::uint32_t rosout = 1;                 // of the publications
constexpr std::uint32_t first_service_reply = 2;    // the same
constexpr std::uint32_t first_service_request = 1;  // of the subscriptions

constexpr std::uint32_t not_listed = UINT32_MAX;

/// Its place in the list: requests and replies of services take turns, then come user publications,
/// then user subscriptions.
std::uint32_t place_of(Stream s, std::uint32_t d, std::uint32_t user_publications) {
  const bool publishes = s == Stream::pub;
  const std::uint32_t defaults = publishes ? default_publications : default_subscriptions;
  if (d >= defaults) return service_endpoints + (publishes ? 0 : user_publications) + d - defaults;
  if (d + 1 == defaults || d < (publishes ? first_service_reply : first_service_request)) {
    return not_listed;
  }
  return publishes ? 2 * (d - first_service_reply) + 1 : 2 * (d - first_service_request);
}

}  // namespace

Types::Types(const Deployment& deployment)
    : unknown_{deployment.types.value_or(EndpointTypes{}).unknown_per_participant} {
  for (const Participant& p : deployment.participants) user_publications_.push_back(p.publications);
}

std::uint32_t Types::of(std::uint32_t participant, Stream s, std::uint32_t d) const {
  const std::uint32_t place = place_of(s, d, user_publications_[participant]);
  if (place < unknown_) return first_own + unknown_ * participant + place;
  if (place < service_endpoints) return first_of_services + place;
  if (place != not_listed) return of_user_topics;
  if (d == 0) return of_discovery_info;
  return s == Stream::pub && d == rosout ? of_rosout : of_parameter_events;
}

}  // namespace stormproof::model::fastdds
