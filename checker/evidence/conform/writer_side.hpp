// Explains the DATA of one relation. A descriptor that is created after the relation opened is
// pushed once; every other DATA needs an ACKNACK that asks for it and arrives while the descriptor
// is unacknowledged, τ_N before. When each ACKNACK arrives is chosen; the descriptors' machines
// replay the choice.
#pragma once

#include <map>
#include <set>
#include <span>

#include "checker/evidence/conform/context.hpp"
#include "checker/evidence/conform/ledger.hpp"

namespace stormproof::conform {

/// What the HEARTBEATs of a writer say about the creation of its endpoints, whoever they are for:
/// for each number of descriptors, when a HEARTBEAT first announced that many or more.
using AnnouncedSince = std::map<std::uint32_t, std::int64_t>;

struct WriterContext : Context {
  const AnnouncedSince& announced;
  /// The writer has no reader but this one and `others`, not even on its own host, so that no other
  /// request can have armed its nack response before.
  bool knows_readers = false;
  const std::set<std::size_t>& to_everybody;  ///< events that need no request (to_everybody.hpp)
  std::function<bool()> interrupted{};        ///< `Request::interrupted`
  std::span<const Relation* const> others{};  ///< if `knows_readers`, this one may be among them

  /// From the arrival of a request to the transmission, at least, ns.
  [[nodiscard]] std::int64_t response_ns() const {
    return knows_readers ? dds.sedp.nack_response_delay.count() : 0;
  }
};

/// Explains all DATA of `relation`, or returns the first that it cannot.
[[nodiscard]] std::optional<Unexplained> explain_data(const WriterContext& context,
                                                      const Relation& relation, Ledger& ledger);

}  // namespace stormproof::conform
