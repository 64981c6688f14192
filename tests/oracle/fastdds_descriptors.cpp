// The descriptors of a ROS 2 participant: how many, in which order they are created, how large they
// are, and to which topic they belong. Constants of the rules, whatever the profile says.
#include <algorithm>

#include "tests/oracle/fastdds_world.hpp"

namespace stormproof::oracle::fastdds {

namespace {

constexpr Id default_publications = 9;
constexpr Id default_subscriptions = 8;

// Those of the default node, then of user endpoints.
std::vector<std::int64_t> descriptor_bytes(bool of_3, int s) {
  if (of_3 && s == pub) return {248, 244, 276, 284, 276, 300, 284, 276, 252, 240};
  if (of_3) return {276, 296, 304, 296, 312, 304, 296, 268, 256};
  if (s == pub) return {412, 384, 428, 436, 428, 452, 436, 428, 404, 392};
  return {412, 432, 440, 432, 448, 440, 432, 404, 392};
}

}  // namespace

Id descriptor_count(const model::Scenario& scenario, Id i, int s) {
  if (i >= scenario.deployment.size()) return 0;  // a Discovery Server
  const model::Participant& p = scenario.deployment.participants.at(i);
  return s == pub ? default_publications + p.publications : default_subscriptions + p.subscriptions;
}

std::vector<std::pair<int, Id>> creation_order(const model::Scenario& scenario, Id i) {
  std::vector<std::pair<int, Id>> order{{pub, 0}, {sub, 0}, {pub, 1}};
  for (Id k = 0; k <= 5; ++k) {
    order.emplace_back(sub, 1 + k);
    order.emplace_back(pub, 2 + k);
  }
  order.emplace_back(pub, 8);
  order.emplace_back(sub, 7);
  const Id publications = descriptor_count(scenario, i, pub);
  const Id subscriptions = descriptor_count(scenario, i, sub);
  for (Id d = default_publications; d < publications; ++d) order.emplace_back(pub, d);
  for (Id d = default_subscriptions; d < subscriptions; ++d) order.emplace_back(sub, d);
  return order;
}

std::int64_t submessage_bytes(const World& w, Id i, int s, Id d) {
  const std::vector<std::int64_t> bytes = descriptor_bytes(has_sizes_of_3(w, i), s);
  std::int64_t inline_qos = 0;
  if (w.server) inline_qos = has_sizes_of_3(w, i) ? 60 : 32;
  std::int64_t about_type = profile(w, i).version.descriptor_extra_bytes.count();
  if (about_type == 0 && with_types(w) && !w.makes(Mistake::types_without_bytes)) about_type = 188;
  return inline_qos + about_type + bytes.at(std::min<std::size_t>(d, bytes.size() - 1));
}

// 0: ros_discovery_info, 1: parameter_events, 2 + k: user topic k.
int topic_of(int s, Id d) {
  const Id defaults = s == pub ? default_publications : default_subscriptions;
  if (d == 0) return 0;
  if (d + 1 == defaults) return 1;
  if (d < defaults) return no_topic;
  return static_cast<int>(2 + d - defaults);
}

Id descriptor_of(int s, int topic) {
  const Id defaults = s == pub ? default_publications : default_subscriptions;
  if (topic == 0) return 0;
  if (topic == 1) return defaults - 1;
  return defaults + static_cast<Id>(topic) - 2;
}

}  // namespace stormproof::oracle::fastdds
