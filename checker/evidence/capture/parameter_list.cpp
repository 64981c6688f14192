// The wire format of parameter lists.
#include "checker/evidence/capture/parameter_list.hpp"

namespace stormproof::capture {

std::optional<Parameter> ParameterReader::next() {
  constexpr std::uint16_t flags = 0xc000;  // vendor-specific, must be understood
  if (ended_) return std::nullopt;
  Cursor cursor{part(list_, position_), order_};
  const std::uint16_t id = cursor.u16();
  const std::uint16_t length = cursor.u16();
  if (cursor.failed()) return std::nullopt;
  if (id == static_cast<std::uint16_t>(ParameterId::sentinel)) {
    position_ += cursor.position();
    ended_ = true;
    return std::nullopt;
  }
  const Bytes value = cursor.take(length);
  if (cursor.failed()) return std::nullopt;
  position_ += cursor.position();
  // A parameter of a vendor is none of those with names here.
  const bool is_of_vendor = (id & 0x8000U) != 0;
  if (is_of_vendor) return Parameter{ParameterId::pad, value, id};
  return Parameter{static_cast<ParameterId>(id & ~flags), value};
}

std::optional<std::size_t> parameter_list_size(Bytes bytes, ByteOrder order) {
  ParameterReader reader{bytes, order};
  while (reader.next()) {
  }
  if (!reader.ended()) return std::nullopt;
  return reader.size();
}

std::optional<ParameterReader> parameters_of_payload(Bytes payload) {
  constexpr std::uint16_t big_endian_list = 0x0002;
  constexpr std::uint16_t little_endian_list = 0x0003;
  Cursor cursor{payload};
  const std::uint16_t encapsulation = cursor.u16();
  cursor.skip(2);
  if (cursor.failed()) return std::nullopt;
  if (encapsulation == big_endian_list) return ParameterReader{cursor.rest(), ByteOrder::big};
  if (encapsulation == little_endian_list) {
    return ParameterReader{cursor.rest(), ByteOrder::little};
  }
  return std::nullopt;
}

}  // namespace stormproof::capture
