// Explains the announcements of one participant. Multicasts follow the announcement timer, or a
// participant was recognised for the first time; which of them do is chosen. Unicast copies go
// to participants that are known, with a multicast or (resend: new_only) to a new one. With static
// peers rounds of copies take the place of multicasts (static_peers.hpp).
#pragma once

#include "checker/evidence/conform/ledger.hpp"
#include "fsm/announcer.hpp"
#include "model/dds_profile.hpp"

namespace stormproof::conform {

/// Explains all announcements of `participant`, or returns the first that it cannot.
[[nodiscard]] std::optional<Unexplained> explain_announcements(
    const Dialogue& dialogue, std::size_t participant, const model::DdsProfile& dds,
    const Bounds& bounds, Tally<fsm::Announcer>& announcer, Ledger& ledger);

}  // namespace stormproof::conform
