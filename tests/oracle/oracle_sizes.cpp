// Sizes and airtimes: pure functions of the scenario, without any state. They are apart because the
// open-loop baseline needs the very same numbers as the closed-loop run.
#include <algorithm>

#include "tests/oracle/oracle_world.hpp"

namespace stormproof::oracle {

namespace {

constexpr std::int64_t udp_header = 8;
constexpr std::int64_t ip_header = 20;
constexpr std::int64_t mtu_grouping_limit = 1472;

std::uint32_t default_count(const model::Scenario& scenario, int s) {
  const model::DescriptorProfile& descriptors = scenario.dds.descriptors;
  return s == 0 ? descriptors.default_publications : descriptors.default_subscriptions;
}

}  // namespace

std::int64_t ceil_div(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

Id count_at_start(const model::Scenario& scenario, Id i, int s) {
  const model::Participant& p = scenario.deployment.participants.at(i);
  return default_count(scenario, s) + (s == 0 ? p.publications : p.subscriptions);
}

// A deletion takes a number of its own.
Id descriptor_count(const model::Scenario& scenario, Id i, int s) {
  Id count = count_at_start(scenario, i, s);
  if (!scenario.deployment.life) return count;
  for (const model::LateEndpoints& late : scenario.deployment.life->endpoints) {
    if (late.participant != i) continue;
    const Id endpoints = s == 0 ? late.publications : late.subscriptions;
    count += endpoints;
    if (late.until) count += endpoints;
  }
  return count;
}

std::int64_t descriptor_bytes(const model::Scenario& scenario, int s, Id d) {
  const model::DescriptorProfile& descriptors = scenario.dds.descriptors;
  const std::int64_t m = default_count(scenario, s);
  if (d >= m) return descriptors.user_bytes.count();
  const std::int64_t lo = descriptors.default_bytes[0].count();
  const std::int64_t hi = descriptors.default_bytes[1].count();
  if (m == 1) return lo;
  return lo + ((hi - lo) * d) / (m - 1);
}

std::int64_t grouping_limit(const model::SedpProfile& sedp) {
  switch (sedp.grouping) {
    case model::Grouping::message:
      return sedp.grouping_limit_bytes.count();
    case model::Grouping::mtu:
      return mtu_grouping_limit;
    case model::Grouping::single:
      return 0;
  }
  return 0;
}

std::vector<std::int64_t> cut_into_fragments(const model::WirelessProfile& wireless,
                                             std::int64_t payload) {
  const std::int64_t mtu = wireless.mtu_payload_bytes.count();
  const std::int64_t bytes = payload + udp_header;
  std::vector<std::int64_t> fragments;
  for (std::int64_t k = 0; k < ceil_div(bytes, mtu); ++k) {
    const std::int64_t carried = std::min(mtu, bytes - mtu * k);
    fragments.push_back(carried + ip_header + wireless.link_overhead_bytes.count());
  }
  return fragments;
}

Time airtime(const model::WirelessProfile& wireless, std::size_t stage, bool multicast,
             std::int64_t bytes, Rounding rounding) {
  const model::Stage& st = wireless.stages.at(stage);
  Time overhead = 0;
  std::int64_t rate = 0;
  if (multicast && st.multicast_as == model::MulticastAs::multicast) {
    overhead = st.overhead_multicast.value_or(wireless.overhead_multicast).count();
    rate = st.rate_multicast.value_or(wireless.rate_multicast).count();
  } else {
    overhead = st.overhead_unicast.value_or(wireless.overhead_unicast).count();
    rate = st.rate_unicast.value_or(wireless.rate_unicast).count();
  }
  const std::int64_t half = rounding == Rounding::to_nearest ? rate / 2 : 0;
  return overhead + (8 * bytes * 1'000'000'000 + half) / rate;
}

}  // namespace stormproof::oracle
