// Holds what only a Discovery Server and its clients send against their rules
// (specs/guide/discovery-server.md): registrations of clients, and what the server's relays pass
// on. Descriptors on their way to the server, all ACKNACKs, and when a change may be sent again are
// explained as with Fast DDS; these parts look for a cause of everything else, message by message.
//
// A capture between hosts does not show the clients on the server's own host. What they can have
// caused (that a timer is armed, that the routine runs, that a change gets a new number) is
// assumed.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "checker/evidence/conform/context.hpp"
#include "checker/evidence/conform/ledger.hpp"
#include "checker/evidence/conform/sent_heartbeats.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::conform::server {

/// The profile with the delays of announcements, which are reliable, in the places of those of
/// SEDP.
[[nodiscard]] model::DdsProfile of_announcements(model::DdsProfile dds);

/// DATA(p) and HEARTBEAT(p) of a client, and that it matches its writers with the server at a tick.
[[nodiscard]] std::optional<Unexplained> explain_registration(const Context& context,
                                                              std::size_t client, Ledger& ledger);
/// The second of these: HEARTBEAT(p) among a client's announcements to the server.
[[nodiscard]] std::optional<Unexplained> explain_registration_heartbeats(const Context& context,
                                                                         const Relation& own,
                                                                         Ledger& ledger);
/// HEARTBEATs and GAPs of one of the server's relays, and what its DATA say. The delays of SEDP in
/// `context.dds` are those of the relay.
[[nodiscard]] std::optional<Unexplained> explain_relay(const Context& context,
                                                       const WriterRelations& relay,
                                                       Ledger& ledger);

/// Whether it is the server's own announcement.
[[nodiscard]] bool tells_of_server(const Context& context, const Submessage& sent);

/// What a verdict by these rules does not say.
[[nodiscard]] std::vector<std::string> assumptions(const Dialogue& dialogue);

}  // namespace stormproof::conform::server
