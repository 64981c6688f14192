// Who is who in a simulated capture: addresses, ports and GUIDs of participants, and the entity ids
// and ROS 2 names of their endpoints. The model knows numbers only; a capture needs names, and the
// same ones in every capture of a deployment.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "checker/evidence/capture/address.hpp"
#include "checker/evidence/capture/identifiers.hpp"
#include "model/dds_profile.hpp"
#include "model/deployment.hpp"

namespace stormproof::capture::write {

/// The entities of a relation.
struct Ends {
  EntityId writer = 0;
  EntityId reader = 0;
};

namespace entity {
inline constexpr EntityId participant = 0x000001c1;
inline constexpr EntityId liveliness_reader = 0x000200c7;
}  // namespace entity

/// One participant, the p-th of its host (from 0 on); the h-th host of the deployment in ascending
/// order has the address 10.(h / 256).(h mod 256).1.
struct Identity {
  GuidPrefix prefix{};   ///< vendor, host, number of the participant in the deployment + 1, zeros
  UdpEnd metatraffic{};  ///< port 7410 + 2p (RTPS 2.5, section 9.6.1, domain 0)
  UdpEnd user{};         ///< port 7411 + 2p
  std::string name{};    ///< simulated_hH_pP, with the host's number in the deployment
  /// PARTICIPANT_TYPE where there is a Discovery Server; otherwise empty, and not announced.
  std::string type{};
  /// Major and minor number of the library's version, which it announces; 0.0: it does not.
  std::array<std::uint8_t, 2> version{};
};

/// Of a version whose announcements have these sizes: Fast DDS says it from 3.0 on.
[[nodiscard]] std::array<std::uint8_t, 2> announced_version(model::SizesSince sizes);

/// In the order of the deployment, of a version whose announcements have these sizes. With a
/// Discovery Server it is the last one, called
/// simulated_server, with port 11811 of the first host.
[[nodiscard]] std::vector<Identity> identities(
    const model::Deployment& deployment, VendorId vendor,
    model::Discovery discovery = model::Discovery::simple,
    model::SizesSince sizes = model::SizesSince::v2_6);

/// Of the p-th participant of a host, from 0 on.
[[nodiscard]] constexpr std::uint16_t metatraffic_port(std::size_t p) {
  return static_cast<std::uint16_t>(7410 + 2 * p);
}

/// 239.255.0.1:7400.
[[nodiscard]] UdpEnd discovery_group();

/// The endpoint that descriptor d of a stream describes: a writer or reader without a key.
[[nodiscard]] constexpr EntityId endpoint_entity(model::Stream stream, std::uint32_t d) {
  return (d + 1) << 8U | (stream == model::Stream::pub ? 0x03U : 0x04U);
}
[[nodiscard]] constexpr EntityId sedp_writer(model::Stream stream) {
  return stream == model::Stream::pub ? capture::entity::publications_writer
                                      : capture::entity::subscriptions_writer;
}
[[nodiscard]] constexpr EntityId sedp_reader(model::Stream stream) {
  return stream == model::Stream::pub ? capture::entity::publications_reader
                                      : capture::entity::subscriptions_reader;
}

struct TopicName {
  std::string topic{};
  std::string type{};
};

/// What descriptor d of a stream is about. The first `defaults` of a stream are those of a ROS 2
/// node of this name, in the order of `fastdds::creation_order` (further ones are rt/default/…);
/// user endpoint k follows as rt/bench/topic_k, for publications and subscriptions alike.
[[nodiscard]] TopicName topic_name(model::Stream stream, std::uint32_t d, std::uint32_t defaults,
                                   const std::string& node);

}  // namespace stormproof::capture::write
