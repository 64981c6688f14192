// The RTPS messages of Cyclone DDS, whose packets mix submessages of all writers of a participant:
// each as its packet says, with the sizes of specs/guide/cyclone.md, "Sizes and counts".
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "checker/evidence/capture/write/identities.hpp"
#include "checker/evidence/capture/write/message_writer.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/submessage.hpp"
#include "model/scenario.hpp"

namespace stormproof::capture::write {

class CycloneMessages {
 public:
  struct Datagram {
    UdpEnd to{};
    Buffer payload{};
  };

  /// All of it must outlive the object.
  CycloneMessages(const model::Scenario& scenario, VendorId vendor,
                  const std::vector<Identity>& identities)
      : scenario_{scenario}, vendor_{vendor}, identities_{identities} {}

  /// A copy of the packet to a participant, or to the group if there is none.
  [[nodiscard]] Datagram datagram(const model::Packet& packet, std::uint32_t source,
                                  std::optional<std::uint32_t> destination,
                                  std::int64_t time_ns) const;

 private:
  /// The submessage on its way from `source`; an ACKNACK has so many words more than it needs.
  void add(MessageWriter& out, const model::Submessage& m, std::uint32_t source, bool is_directed,
           std::int64_t time_ns, std::uint32_t more_words) const;
  void add_sample(MessageWriter& out, const model::Submessage& m, std::uint32_t source,
                  bool is_directed) const;
  [[nodiscard]] std::int64_t bytes_of(const model::Submessage& m) const;

  const model::Scenario& scenario_;
  const VendorId vendor_;
  const std::vector<Identity>& identities_;
};

}  // namespace stormproof::capture::write
