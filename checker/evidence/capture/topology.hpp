// Who takes part, recovered from the traffic itself: participants from SPDP, their endpoints from
// SEDP, and hosts from the addresses that participants share.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "checker/evidence/capture/address.hpp"
#include "checker/evidence/capture/discovery_data.hpp"
#include "checker/evidence/capture/identifiers.hpp"
#include "checker/evidence/capture/type_lookup.hpp"

namespace stormproof::capture {

/// An endpoint as its participant described it.
struct Endpoint {
  EntityId entity = 0;
  EntityId announced_by = 0;         ///< the SEDP writer: of publications or subscriptions
  std::int64_t sequence_number = 0;  ///< of the latest description
  std::int64_t first_ns = 0;         ///< when the first description was sent
  std::string topic{};
  std::string type{};
  EndpointQos qos{};
  bool has_type_information = false;  ///< who does not know its type can look it up
  std::optional<TypeHash> type_hash{};
  bool is_gone = false;
};

struct Participant {
  GuidPrefix prefix{};
  VendorId vendor = 0;
  std::string discovery{};  ///< "SIMPLE", "CLIENT", …, of Fast DDS; may be empty
  std::string version{};    ///< of its library, as far as DATA(p) shows it; may be empty
  std::string name{};
  std::string machine{};  ///< the identity of its machine, of Fast DDS from 3.2 on; may be empty
  std::optional<std::uint32_t> domain{};   ///< as it says in DATA(p)
  std::optional<std::int64_t> lease_ns{};  ///< the same
  std::size_t host = 0;
  /// When its first message was sent; if there is none, when a Discovery Server told of it first.
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;              ///< of its last message, with whatever content
  std::set<Address> addresses{};         ///< that its messages came from; without one, announced
  std::set<UdpEnd> locators{};           ///< metatraffic unicast, as announced
  std::map<Guid, Endpoint> endpoints{};  ///< by GUID, from its SEDP DATA
  /// Whether it tells clients of each other.
  [[nodiscard]] bool is_server() const { return discovery == "SERVER" || discovery == "BACKUP"; }
  /// Number of endpoints that one of its SEDP writers announced and that are not gone.
  [[nodiscard]] std::size_t announced(EntityId sedp_writer) const;
};

struct Topology {
  std::vector<Participant> participants{};  ///< by host, then in the order of their first messages
  std::size_t hosts = 0;

  [[nodiscard]] const Participant* find(const GuidPrefix& prefix) const;
  /// Whether participants discover through a Discovery Server, as PARTICIPANT_TYPE of somebody's
  /// DATA(p) says: announcements are reliable then.
  [[nodiscard]] bool has_server() const;
  /// The server, if the capture shows its DATA(p).
  [[nodiscard]] const Participant* server() const;
  [[nodiscard]] std::size_t index_of(const Participant& participant) const {
    return static_cast<std::size_t>(&participant - participants.data());
  }
};

/// Collects what messages say about their senders, in any order of time.
class TopologyBuilder {
 public:
  /// A message of this participant was sent from this address.
  void saw_message(const GuidPrefix& source, VendorId vendor, const Address& from,
                   std::int64_t time_ns);
  /// What it says of itself, or of another participant, as a Discovery Server does.
  void saw_participant(const GuidPrefix& source, const ParticipantData& data, std::int64_t time_ns);
  void saw_endpoint(const GuidPrefix& source, EntityId sedp_writer, std::int64_t sequence_number,
                    const EndpointData& data, std::int64_t time_ns);

  /// The participant that a datagram to `locator` at `time_ns` is for: the one that announced it
  /// last until then, otherwise the one that did so first.
  [[nodiscard]] std::optional<GuidPrefix> receiver(const UdpEnd& locator,
                                                   std::int64_t time_ns) const;
  [[nodiscard]] Topology build() const;

 private:
  std::map<GuidPrefix, Participant> participants_;
  /// Who announced a locator since when.
  std::map<UdpEnd, std::map<std::int64_t, GuidPrefix>> announcements_;
};

}  // namespace stormproof::capture
