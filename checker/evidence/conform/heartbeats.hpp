// Explains the HEARTBEATs of one writer, to all of its readers. To one reader: the relation opens,
// or its initial ACKNACK is answered. To all readers: the timer, or DATA has used up the piggyback
// budget. DATA to readers on the writer's own host is in no capture between hosts; where there are
// such readers it is assumed, and counted apart.
#pragma once

#include "checker/evidence/conform/ledger.hpp"
#include "checker/evidence/conform/sent_heartbeats.hpp"
#include "checker/evidence/conform/writer_side.hpp"

namespace stormproof::conform {

/// When HEARTBEATs of a writer first announced that many descriptors, or more.
[[nodiscard]] AnnouncedSince announced_since(const WriterRelations& writer);

/// Explains all HEARTBEATs of the writer, or returns the first that it cannot.
[[nodiscard]] std::optional<Unexplained> explain_heartbeats(const Context& context,
                                                            const WriterRelations& writer,
                                                            Ledger& ledger);

}  // namespace stormproof::conform
