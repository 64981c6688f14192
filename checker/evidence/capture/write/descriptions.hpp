// What SPDP and SEDP DATA of a simulated participant say: the parameters that a dissector and a
// remote participant need, with ROS 2 names and reliable QoS.
#pragma once

#include <cstdint>

#include "checker/evidence/capture/write/identities.hpp"
#include "checker/evidence/capture/write/message_writer.hpp"

namespace stormproof::capture::write {

/// DATA(p).
[[nodiscard]] ParameterWriter participant_parameters(const Identity& participant, VendorId vendor);
/// DATA(w) or DATA(r) of descriptor d.
[[nodiscard]] ParameterWriter endpoint_parameters(const Identity& participant, VendorId vendor,
                                                  model::Stream stream, std::uint32_t d,
                                                  const TopicName& name);
/// The same, as short as Cyclone DDS writes it.
[[nodiscard]] ParameterWriter short_endpoint_parameters(const Identity& participant,
                                                        model::Stream stream, std::uint32_t d,
                                                        const TopicName& name);

}  // namespace stormproof::capture::write
