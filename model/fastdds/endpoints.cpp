// The tables of the default node, by version.
#include "model/fastdds/endpoints.hpp"

#include <algorithm>

#include "model/scenario.hpp"

namespace stormproof::model::fastdds {

namespace {

constexpr VersionSizes since_2_6{
    .announcement = 252,
    .publications = {412, 384, 428, 436, 428, 452, 436, 428, 404},
    .subscriptions = {412, 432, 440, 432, 448, 440, 432, 404},
    .user_publication = 392,
    .user_subscription = 392,
    .registration = 324,
    .passed_on = 324,
    .of_server = 396,
    .inline_qos = 32,
};
/// QoS that equal the default are left out.
constexpr VersionSizes since_3_2{
    .announcement = 484,
    .publications = {248, 244, 276, 284, 276, 300, 284, 276, 252},
    .subscriptions = {276, 296, 304, 296, 312, 304, 296, 268},
    .user_publication = 240,
    .user_subscription = 256,
    .registration = 568,
    .passed_on = 584,
    .of_server = 656,
    .inline_qos = 60,
};
constexpr VersionSizes since_3_6 = [] {
  VersionSizes sizes = since_3_2;
  sizes.registration = 572;
  sizes.passed_on = 588;
  sizes.of_server = 652;
  return sizes;
}();

/// In the order of SizesSince.
constexpr std::array by_version{since_2_6, since_3_2, since_3_6};

}  // namespace

const VersionSizes& sizes_of(const DdsProfile& dds) {
  return by_version[static_cast<std::size_t>(dds.version.sizes)];
}

DdsProfile deployed_profile(const Scenario& scenario) {
  return deployed_profile(scenario, scenario.dds);
}

DdsProfile deployed_profile(const Scenario& scenario, DdsProfile dds) {
  Bytes& extra = dds.version.descriptor_extra_bytes;
  if (scenario.deployment.types && extra == Bytes{0}) extra = Bytes{type_information_bytes};
  return dds;
}

std::int64_t submessage_bytes(const DdsProfile& dds, Stream s, std::uint32_t d) {
  const VersionSizes& sizes = sizes_of(dds);
  const std::int64_t extra = dds.version.descriptor_extra_bytes.count();
  if (s == Stream::pub) {
    return extra + (d < default_publications ? sizes.publications[d] : sizes.user_publication);
  }
  return extra + (d < default_subscriptions ? sizes.subscriptions[d] : sizes.user_subscription);
}

std::int64_t largest_submessage_bytes(const DdsProfile& dds) {
  const VersionSizes& sizes = sizes_of(dds);
  return dds.version.descriptor_extra_bytes.count() +
         std::max({std::ranges::max(sizes.publications), std::ranges::max(sizes.subscriptions),
                   sizes.user_publication, sizes.user_subscription});
}

std::int64_t sample_bytes(const DdsProfile& dds, std::uint32_t stage, std::size_t types) {
  constexpr std::int64_t identifier = 16;
  constexpr std::int64_t no_dependencies = 96;
  const std::int64_t object = dds.version.type_object_bytes.count();
  const std::array bytes{std::int64_t{156}, no_dependencies, std::int64_t{148}, object};
  const std::array more{identifier, std::int64_t{0}, identifier,
                        std::max<std::int64_t>(object - no_dependencies, 0)};
  // With a mistake in the rules a chain goes on after its last sample.
  const std::size_t k = std::min<std::size_t>(stage, bytes.size() - 1);
  return bytes[k] + static_cast<std::int64_t>(types - 1) * more[k];
}

std::int64_t largest_sample_bytes(const DdsProfile& dds, std::size_t types) {
  return std::max(sample_bytes(dds, 0, types), sample_bytes(dds, 3, types));
}

std::uint32_t topic_of(Stream s, std::uint32_t d) {
  const std::uint32_t shared = shared_topic_of(s, d);
  return shared == no_topic ? topic::none : topic::ros_discovery_info + shared;
}

std::uint32_t descriptor_on(std::uint32_t t, Stream s) {
  return descriptor_on_topic(t - topic::ros_discovery_info, s);
}

}  // namespace stormproof::model::fastdds
