// The parameters of SPDP and SEDP that matter here.
#include "checker/evidence/capture/discovery_data.hpp"

#include <algorithm>

#include "checker/evidence/capture/library_version.hpp"
#include "checker/evidence/capture/parameter_list.hpp"

namespace stormproof::capture {

namespace {

std::optional<Guid> guid(Bytes value) {
  Cursor cursor{value};
  Guid result;
  const Bytes prefix = cursor.take(result.prefix.bytes.size());
  result.entity = cursor.u32();
  if (cursor.failed()) return std::nullopt;
  std::ranges::copy(prefix, result.prefix.bytes.begin());
  return result;
}

/// A CDR string, without its terminator; empty if its length is wrong.
std::string text(Bytes value, ByteOrder order) {
  Cursor cursor{value, order};
  const Bytes characters = cursor.take(cursor.u32());
  std::string result{characters.begin(), characters.end()};
  if (!result.empty() && result.back() == '\0') result.pop_back();
  return result;
}

/// The value of a property in a list of names and values; empty if it is not there.
std::string property(Bytes value, ByteOrder order, std::string_view name) {
  Cursor cursor{value, order};
  const auto next = [&] {
    const Bytes characters = cursor.take(cursor.u32());
    cursor.skip((4 - cursor.position() % 4) % 4);
    const std::size_t length = characters.empty() ? 0 : characters.size() - 1;
    return std::string{characters.begin(),
                       characters.begin() + static_cast<std::ptrdiff_t>(length)};
  };
  for (std::uint32_t left = cursor.u32(); left > 0 && !cursor.failed(); --left) {
    const std::string key = next();
    const std::string text = next();
    if (key == name) return text;
  }
  return "";
}

std::optional<UdpEnd> udp_locator(Bytes value, ByteOrder order) {
  constexpr std::uint32_t udp_v4 = 1;
  constexpr std::uint32_t udp_v6 = 2;
  constexpr std::size_t before_v4 = 12;
  Cursor cursor{value, order};
  const std::uint32_t kind = cursor.u32();
  const std::uint32_t port = cursor.u32();
  const Bytes address = cursor.take(16);
  if (cursor.failed() || port == 0 || port > 65535 || (kind != udp_v4 && kind != udp_v6)) {
    return std::nullopt;
  }
  return UdpEnd{Address::from(kind == udp_v4 ? address.subspan(before_v4) : address),
                static_cast<std::uint16_t>(port)};
}

/// The inline QoS of a DATA: which endpoint, and whether it is gone.
void read_inline_qos(const DataSubmessage& data, ByteOrder order, EndpointData& endpoint) {
  constexpr std::uint32_t disposed_or_unregistered = 0x3;
  ParameterReader parameters{data.inline_qos, order};
  while (const auto parameter = parameters.next()) {
    if (parameter->id == ParameterId::key_hash) endpoint.endpoint = guid(parameter->value);
    if (parameter->id == ParameterId::status_info) {
      endpoint.is_gone = (Cursor{parameter->value}.u32() & disposed_or_unregistered) != 0;
    }
  }
}

}  // namespace

std::optional<ParticipantData> participant_data(const DataSubmessage& data) {
  auto parameters = parameters_of_payload(data.payload);
  if (!parameters) return std::nullopt;
  ParticipantData participant;
  VendorParameters own;
  while (const auto parameter = parameters->next()) {
    if (parameter->of_vendor != 0) own[parameter->of_vendor] = parameter->value;
    switch (parameter->id) {
      case ParameterId::participant_guid:
        if (const auto found = guid(parameter->value)) participant.prefix = found->prefix;
        break;
      case ParameterId::participant_lease:
        participant.lease_ns = duration_ns(Cursor{parameter->value, parameters->order()});
        break;
      case ParameterId::domain:
        participant.domain = Cursor{parameter->value, parameters->order()}.u32();
        break;
      case ParameterId::vendor:
        participant.vendor = Cursor{parameter->value}.u16();
        break;
      case ParameterId::property_list:
        participant.discovery = property(parameter->value, parameters->order(), "PARTICIPANT_TYPE");
        break;
      case ParameterId::entity_name:
        participant.name = text(parameter->value, parameters->order());
        break;
      case ParameterId::metatraffic_unicast_locator:
        if (const auto locator = udp_locator(parameter->value, parameters->order())) {
          participant.metatraffic_unicast.push_back(*locator);
        }
        break;
      default:
        break;
    }
  }
  if (!parameters->ended()) return std::nullopt;
  if (participant.vendor) {
    participant.version = library_version(*participant.vendor, own, parameters->order());
  }
  constexpr std::uint16_t machine_id = 0x8003;
  if (const auto machine = own.find(machine_id);
      participant.vendor == fastdds_vendor && machine != own.end()) {
    participant.machine = text(machine->second, parameters->order());
  }
  return participant;
}

std::optional<EndpointData> endpoint_data(const DataSubmessage& data, ByteOrder order) {
  EndpointData endpoint;
  read_inline_qos(data, order, endpoint);
  if (data.payload.empty()) return endpoint;
  auto parameters = parameters_of_payload(data.payload);
  if (!parameters) return std::nullopt;
  while (const auto parameter = parameters->next()) {
    switch (parameter->id) {
      case ParameterId::endpoint_guid:
        if (const auto found = guid(parameter->value)) endpoint.endpoint = found;
        break;
      case ParameterId::key_hash:
        if (!endpoint.endpoint) endpoint.endpoint = guid(parameter->value);
        break;
      case ParameterId::topic_name:
        endpoint.topic = text(parameter->value, parameters->order());
        break;
      case ParameterId::type_name:
        endpoint.type = text(parameter->value, parameters->order());
        break;
      case ParameterId::type_information:
        endpoint.has_type_information = true;
        endpoint.type_hash = type_hash(parameter->value, parameters->order());
        break;
      default:
        read_qos(*parameter, parameters->order(), endpoint.qos);
        break;
    }
  }
  if (!parameters->ended()) return std::nullopt;
  return endpoint;
}

}  // namespace stormproof::capture
