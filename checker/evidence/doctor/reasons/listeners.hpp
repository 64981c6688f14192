// What IGMP in the capture says about multicast that does not arrive: that somebody listens whose
// announcements are missing, and whether anybody asks who listens.
#pragma once

#include <string>

#include "checker/evidence/doctor/reasons/contacts.hpp"

namespace stormproof::doctor {

struct Listeners {
  bool others_listen = false;  ///< a host whose announcements do not arrive has joined their group
  std::string text{};  ///< "; 10.0.0.2 has joined …": to go on a sentence with; may be empty
};

[[nodiscard]] Listeners listeners(const Contacts& contacts);

}  // namespace stormproof::doctor
