// What SPDP and SEDP DATA say: the participant or endpoint that a payload announces. Unknown
// parameters are skipped, as RTPS demands.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "checker/evidence/capture/address.hpp"
#include "checker/evidence/capture/endpoint_qos.hpp"
#include "checker/evidence/capture/identifiers.hpp"
#include "checker/evidence/capture/rtps_message.hpp"
#include "checker/evidence/capture/type_lookup.hpp"

namespace stormproof::capture {

/// DATA(p).
struct ParticipantData {
  std::optional<GuidPrefix> prefix{};
  std::optional<VendorId> vendor{};
  std::string name{};
  std::vector<UdpEnd> metatraffic_unicast{};  ///< UDP locators only
  /// How a Fast DDS participant discovers, as its property PARTICIPANT_TYPE says: "SIMPLE",
  /// "CLIENT", "SUPER_CLIENT", "SERVER", "BACKUP"; empty if it does not say.
  std::string discovery{};
  std::string version{};  ///< of its library, as far as DATA(p) shows it
  /// By which Fast DDS from 3.2 on decides who is on one host (PID_MACHINE_ID); empty if not sent.
  std::string machine{};
  std::optional<std::uint32_t> domain{};  ///< if it says one
  std::optional<std::int64_t> lease_ns{};

  bool operator==(const ParticipantData&) const = default;
};

/// DATA(w) or DATA(r).
struct EndpointData {
  std::optional<Guid> endpoint{};
  std::string topic{};
  std::string type{};
  EndpointQos qos{};
  bool has_type_information = false;  ///< hashes by which its type can be looked up
  std::optional<TypeHash> type_hash{};
  bool is_gone = false;  ///< disposed or unregistered

  bool operator==(const EndpointData&) const = default;
};

/// Nothing if the payload is no parameter list, or breaks off.
[[nodiscard]] std::optional<ParticipantData> participant_data(const DataSubmessage& data);
/// `order` is that of the submessage, which its inline QoS have, too. A key without a sample gives
/// the endpoint alone.
[[nodiscard]] std::optional<EndpointData> endpoint_data(const DataSubmessage& data,
                                                        ByteOrder order);

}  // namespace stormproof::capture
