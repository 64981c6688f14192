// Parameter lists (RTPS 2.5, section 9.4.2.11): how SPDP and SEDP describe participants and
// endpoints. A pull parser; lengths that lead outside end the list.
#pragma once

#include <cstdint>
#include <optional>

#include "checker/evidence/capture/bytes.hpp"

namespace stormproof::capture {

enum class ParameterId : std::uint16_t {
  pad = 0x0000,
  sentinel = 0x0001,
  participant_lease = 0x0002,
  topic_name = 0x0005,
  type_name = 0x0007,
  domain = 0x000f,
  vendor = 0x0016,
  reliability = 0x001a,
  liveliness = 0x001b,
  durability = 0x001d,
  ownership = 0x001f,
  deadline = 0x0023,
  destination_order = 0x0025,
  partition = 0x0029,
  metatraffic_unicast_locator = 0x0032,
  participant_guid = 0x0050,
  property_list = 0x0059,
  endpoint_guid = 0x005a,
  entity_name = 0x0062,
  key_hash = 0x0070,
  status_info = 0x0071,
  type_information = 0x0075
};

struct Parameter {
  ParameterId id = ParameterId::pad;  ///< without the flags; may be a value that has no name
  Bytes value{};
  std::uint16_t of_vendor = 0;  ///< 0x8000 …: what it means depends on the vendor; then `id` is pad
};

class ParameterReader {
 public:
  /// `list` starts at the first parameter.
  ParameterReader(Bytes list, ByteOrder order) : list_{list}, order_{order} {}
  /// Nothing at the sentinel and where the list breaks off; `ended` tells which.
  [[nodiscard]] std::optional<Parameter> next();
  [[nodiscard]] bool ended() const { return ended_; }
  /// Bytes read so far, with the sentinel.
  [[nodiscard]] std::size_t size() const { return position_; }
  [[nodiscard]] ByteOrder order() const { return order_; }

 private:
  Bytes list_;
  ByteOrder order_;
  std::size_t position_ = 0;
  bool ended_ = false;
};

/// Size of the list that `bytes` starts with, with its sentinel; nothing without a sentinel.
[[nodiscard]] std::optional<std::size_t> parameter_list_size(Bytes bytes, ByteOrder order);

/// A reader for a payload with its encapsulation (PL_CDR in either byte order); nothing if the
/// encapsulation is another one.
[[nodiscard]] std::optional<ParameterReader> parameters_of_payload(Bytes payload);

}  // namespace stormproof::capture
