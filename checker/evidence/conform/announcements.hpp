// Explains the announcements of one participant. Multicasts follow the announcement timer, or a
// participant was recognised for the first time; which of them do is chosen. Unicast copies go
// to participants that are known, with a multicast or (resend: new_only) to a new one. With static
// peers rounds of copies take the place of multicasts (static_peers.hpp).
#pragma once

#include "checker/evidence/conform/context.hpp"
#include "checker/evidence/conform/ledger.hpp"

namespace stormproof::conform {

/// Explains all announcements of `participant`, or returns the first that it cannot.
[[nodiscard]] std::optional<Unexplained> explain_announcements(const Context& context,
                                                               std::size_t participant,
                                                               Ledger& ledger);

}  // namespace stormproof::conform
