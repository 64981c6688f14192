// The tables of the default node.
#include "model/cyclone/endpoints.hpp"

#include <algorithm>
#include <array>

namespace stormproof::model::cyclone {

namespace {

constexpr std::array<std::int64_t, default_publications> publication_bytes{248, 240, 264, 268, 264,
                                                                           276, 268, 264, 248};
constexpr std::array<std::int64_t, default_subscriptions> subscription_bytes{264, 284, 288, 284,
                                                                             292, 288, 284, 264};
constexpr std::int64_t user_publication_bytes = 248;
constexpr std::int64_t user_subscription_bytes = 264;
constexpr std::int64_t liveliness_bytes = 52;

constexpr std::uint32_t topics_of_node = 2;
constexpr std::array names{"publications",         "subscriptions",       "liveliness",
                           "type lookup requests", "type lookup replies", "ros_discovery_info",
                           "parameter_events"};

}  // namespace

std::uint32_t writers_per_participant(const Topology& topology) {
  std::uint32_t most = default_publications;
  for (std::uint32_t i = 0; i < topology.participant_count(); ++i) {
    most =
        std::max(most, topology.descriptor_count(i, Stream::pub) + topology.late_publications(i));
  }
  return writer::first_topic + topics_of_node + most - default_publications;
}

std::string name_of_writer(std::uint32_t w) {
  if (w < names.size()) return names[w];
  return "user topic " + std::to_string(w - names.size());
}

std::int64_t data_bytes(std::uint32_t w, std::uint32_t sample) {
  if (w == writer::publications) {
    return timestamp_bytes +
           (sample < default_publications ? publication_bytes[sample] : user_publication_bytes);
  }
  if (w == writer::subscriptions) {
    return timestamp_bytes +
           (sample < default_subscriptions ? subscription_bytes[sample] : user_subscription_bytes);
  }
  return timestamp_bytes + liveliness_bytes;
}

}  // namespace stormproof::model::cyclone
