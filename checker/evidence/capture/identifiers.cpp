// Identifiers as text.
#include "checker/evidence/capture/identifiers.hpp"

#include <fmt/core.h>

namespace stormproof::capture {

std::string to_string(const GuidPrefix& prefix) {
  std::string text;
  for (std::size_t k = 0; k < prefix.bytes.size(); ++k) {
    if (k > 0 && k % 4 == 0) text += '.';
    text += fmt::format("{:02x}", prefix.bytes[k]);
  }
  return text;
}

const char* name_of(Traffic traffic) {
  switch (traffic) {
    case Traffic::spdp:
      return "spdp";
    case Traffic::sedp:
      return "sedp";
    case Traffic::liveliness:
      return "liveliness";
    case Traffic::type_lookup:
      return "lookups";
    case Traffic::other_builtin:
      return "other_builtin";
    case Traffic::user:
      return "user";
  }
  return "";
}

const char* stream_of(EntityId sedp_writer) {
  return sedp_writer == entity::publications_writer ? "pub" : "sub";
}

std::string vendor_name(VendorId vendor) {
  switch (vendor) {
    case 0x0101:
      return "RTI Connext";
    case 0x0102:
      return "OpenSplice";
    case 0x0103:
      return "OpenDDS";
    case 0x010a:
      return "CoreDX";
    case fastdds_vendor:
      return "Fast DDS";
    case 0x0110:
      return "Cyclone DDS";
    case 0x0111:
      return "GurumDDS";
    case 0x0112:
      return "RustDDS";
    default:
      return fmt::format("vendor {:02x}.{:02x}", vendor >> 8U, vendor & 0xffU);
  }
}

}  // namespace stormproof::capture
