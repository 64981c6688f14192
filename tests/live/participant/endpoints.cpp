// The list of a node's endpoints and what follows from it for matching.
#include "endpoints.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace stormproof::live {

namespace {

constexpr int default_depth = 10;
constexpr int logging_depth = 1000;

EndpointPlan discovery_info(Direction direction) {
  return {.direction = direction,
          .topic = "ros_discovery_info",
          .type = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_",
          .transient_local = true,
          .depth = direction == Direction::publication ? 1 : 0};
}

EndpointPlan rosout() {
  return {.direction = Direction::publication,
          .topic = "rt/rosout",
          .type = "rcl_interfaces::msg::dds_::Log_",
          .transient_local = true,
          .depth = logging_depth,
          .lifespan_seconds = 10};
}

EndpointPlan parameter_events(Direction direction) {
  return {.direction = direction,
          .topic = "rt/parameter_events",
          .type = "rcl_interfaces::msg::dds_::ParameterEvent_",
          .depth = logging_depth};
}

/// A service is a subscription for its requests and a publication for its replies.
void add_services(std::vector<EndpointPlan>& plans, const std::string& node) {
  static constexpr std::array<std::pair<const char*, const char*>, 6> services = {{
      {"get_parameters", "GetParameters"},
      {"get_parameter_types", "GetParameterTypes"},
      {"set_parameters", "SetParameters"},
      {"set_parameters_atomically", "SetParametersAtomically"},
      {"describe_parameters", "DescribeParameters"},
      {"list_parameters", "ListParameters"},
  }};
  for (const auto& [name, type] : services) {
    const std::string path = "/" + node + "/" + name;
    const std::string prefix = std::string("rcl_interfaces::srv::dds_::") + type;
    plans.push_back({.direction = Direction::subscription,
                     .topic = "rq" + path + "Request",
                     .type = prefix + "_Request_",
                     .depth = default_depth});
    plans.push_back({.direction = Direction::publication,
                     .topic = "rr" + path + "Reply",
                     .type = prefix + "_Response_",
                     .depth = default_depth});
  }
}

EndpointPlan user(Direction direction, std::uint32_t index) {
  const std::string digits = std::to_string(index);
  return {.direction = direction,
          .topic = "rt/bench/topic_" + (index < 10 ? "0" + digits : digits),
          .type = "std_msgs::msg::dds_::String_",
          .depth = default_depth};
}

}  // namespace

std::vector<EndpointPlan> node_endpoints(const Options& options) {
  const std::string node =
      "bench_h" + std::to_string(options.host) + "_p" + std::to_string(options.index);
  std::vector<EndpointPlan> plans = {discovery_info(Direction::publication),
                                     discovery_info(Direction::subscription), rosout()};
  add_services(plans, node);
  plans.push_back(parameter_events(Direction::publication));
  plans.push_back(parameter_events(Direction::subscription));
  for (std::uint32_t index = 0; index < options.user_publications(); ++index) {
    plans.push_back(user(Direction::publication, index));
  }
  for (std::uint32_t index = 0; index < options.user_subscriptions(); ++index) {
    plans.push_back(user(Direction::subscription, index));
  }
  return plans;
}

namespace {

/// Those of a node on topics that have both sides.
std::size_t matching_endpoints(const Options& options) {
  const std::vector<EndpointPlan> plans = node_endpoints(options);
  const auto has_other_side = [&plans](const EndpointPlan& plan) {
    return std::any_of(plans.begin(), plans.end(), [&plan](const EndpointPlan& other) {
      return other.topic == plan.topic && other.direction != plan.direction;
    });
  };
  return static_cast<std::size_t>(std::count_if(plans.begin(), plans.end(), has_other_side));
}

}  // namespace

std::size_t expected_matches(const Options& options) {
  return std::size_t{options.hosts} * options.participants_per_host * matching_endpoints(options);
}

std::size_t expected_discoveries(const Options& options) {
  const bool is_client = options.discovery == Discovery::server;  // it learns what it matches
  return std::size_t{options.hosts - 1} * options.participants_per_host *
         (is_client ? matching_endpoints(options) : node_endpoints(options).size());
}

}  // namespace stormproof::live
