// Explains the ACKNACKs of one relation. What the reader has received is not in a capture; it is
// chosen here, submessage by submessage and in order, so that the reader's machines send what was
// captured. As little as possible is received for each ACKNACK: what has not arrived yet can still
// arrive later or be lost, so no choice is ever regretted.
//
// Rules: a HEARTBEAT schedules an ACKNACK after τ_A unless one is pending; its base is the first
// descriptor that has not arrived, its bitmap lists what is missing of what was announced; without
// a HEARTBEAT the initial ACKNACK is sent at τ_I after the relation opened, and again.
#pragma once

#include "checker/evidence/conform/context.hpp"
#include "checker/evidence/conform/ledger.hpp"

namespace stormproof::conform {

/// Explains all ACKNACKs of `relation`, or returns the first that it cannot.
[[nodiscard]] std::optional<Unexplained> explain_reader(const Context& context,
                                                        const Relation& relation, Ledger& ledger);

}  // namespace stormproof::conform
