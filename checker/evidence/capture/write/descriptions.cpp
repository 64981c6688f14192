// Parameter lists (RTPS 2.5, section 9.6.3) in the order in which Fast DDS writes them.
#include "checker/evidence/capture/write/descriptions.hpp"

#include <array>

#include "checker/evidence/capture/library_version.hpp"
#include "checker/evidence/capture/parameter_list.hpp"

namespace stormproof::capture::write {

namespace {

namespace pid {
constexpr std::uint16_t lease_duration = 0x0002;
constexpr std::uint16_t protocol_version = 0x0015;
constexpr std::uint16_t durability = 0x001d;
constexpr std::uint16_t unicast_locator = 0x002f;
constexpr std::uint16_t default_unicast_locator = 0x0031;
constexpr std::uint16_t builtin_endpoint_set = 0x0058;
}  // namespace pid

void add_version(ParameterWriter& out, VendorId vendor) {
  constexpr std::array<std::uint8_t, 4> version{2, 2, 0, 0};
  const std::array<std::uint8_t, 4> octets{static_cast<std::uint8_t>(vendor >> 8U),
                                           static_cast<std::uint8_t>(vendor), 0, 0};
  out.octets(pid::protocol_version, version).octets(id_of(ParameterId::vendor), octets);
}

void add_qos(ParameterWriter& out) {
  constexpr std::uint32_t is_volatile = 0;
  constexpr std::uint32_t is_reliable = 2;
  constexpr std::uint32_t blocking_fraction = 0x19999999;  // 0.1 s
  out.number(pid::durability, is_volatile);
  ByteWriter reliability;
  out.octets(id_of(ParameterId::reliability),
             reliability.u32(is_reliable).u32(0).u32(blocking_fraction).buffer());
}

}  // namespace

ParameterWriter participant_parameters(const Identity& participant, VendorId vendor) {
  constexpr std::uint32_t lease_seconds = 20;
  // Participant, publications, subscriptions and participant messages, each announced and detected.
  constexpr std::uint32_t builtin_endpoints = 0x00000c3f;
  ParameterWriter out;
  add_version(out, vendor);
  out.guid(id_of(ParameterId::participant_guid), {participant.prefix, entity::participant});
  out.locator(id_of(ParameterId::metatraffic_unicast_locator), participant.metatraffic);
  out.locator(pid::default_unicast_locator, participant.user);
  ByteWriter lease;
  out.octets(pid::lease_duration, lease.u32(lease_seconds).u32(0).buffer());
  out.number(pid::builtin_endpoint_set, builtin_endpoints);
  out.text(id_of(ParameterId::entity_name), participant.name);
  if (participant.version[0] > 0) {
    out.octets(product_version,
               std::array<std::uint8_t, 4>{participant.version[0], participant.version[1], 0, 0});
  }
  if (participant.type.empty()) return out;
  ByteWriter properties;
  properties.u32(1).text("PARTICIPANT_TYPE").text(participant.type);
  out.octets(id_of(ParameterId::property_list), properties.buffer());
  return out;
}

ParameterWriter endpoint_parameters(const Identity& participant, VendorId vendor,
                                    model::Stream stream, std::uint32_t d, const TopicName& name) {
  const Guid guid{participant.prefix, endpoint_entity(stream, d)};
  ParameterWriter out;
  out.locator(pid::unicast_locator, participant.user);
  out.text(id_of(ParameterId::topic_name), name.topic);
  out.text(id_of(ParameterId::type_name), name.type);
  out.guid(id_of(ParameterId::key_hash), guid);
  out.guid(id_of(ParameterId::endpoint_guid), guid);
  add_version(out, vendor);
  add_qos(out);
  return out;
}

ParameterWriter short_endpoint_parameters(const Identity& participant, model::Stream stream,
                                          std::uint32_t d, const TopicName& name) {
  ParameterWriter out;
  out.text(id_of(ParameterId::topic_name), name.topic);
  out.text(id_of(ParameterId::type_name), name.type);
  out.guid(id_of(ParameterId::endpoint_guid), {participant.prefix, endpoint_entity(stream, d)});
  add_qos(out);
  return out;
}

}  // namespace stormproof::capture::write
