// The endpoints of a ROS 2 node, as rclcpp and rmw_fastrtps create them: 17 by default (9
// publications, 8 subscriptions, in this order), and N_E of the user's. Names and types are those
// of ROS 2, because their lengths decide the sizes of the descriptors.
#pragma once

#include <string>
#include <vector>

#include "options.hpp"

namespace stormproof::live {

enum class Direction { publication, subscription };

struct EndpointPlan {
  Direction direction = Direction::publication;
  std::string topic{};
  std::string type{};
  bool transient_local = false;  ///< otherwise volatile; all are reliable
  int depth = 0;                 ///< KEEP_LAST this many; 0: KEEP_ALL
  int lifespan_seconds = 0;      ///< 0: forever
};

/// In the order of their creation.
[[nodiscard]] std::vector<EndpointPlan> node_endpoints(const Options& options);

/// How many matches the endpoints of one participant reach altogether when discovery is complete:
/// on each topic that has both sides, each side matches every participant, its own included.
[[nodiscard]] std::size_t expected_matches(const Options& options);

/// How many endpoints of other hosts one participant discovers.
[[nodiscard]] std::size_t expected_discoveries(const Options& options);

}  // namespace stormproof::live
