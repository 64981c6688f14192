// Why a HEARTBEAT was sent. A capture does not say it, but the order of events does.
//
// To one reader: the first one opens the relation; another one after the reader's initial ACKNACK
// that is not final answers it. (That ACKNACK may have left before the relation opened: whether it
// came in time is nothing that a capture at its source shows.) To all readers (no INFO_DST): copies
// of one message share a count. The periodic timer of a Fast DDS writer starts with its first
// relation and fires a period after it last did, so the first message after most of that time is
// the periodic one (the tenth that is allowed to be missing covers timers that were armed before
// the HEARTBEAT got through the socket); all others ride on DATA that was sent, to whomever, also
// to readers on the same host, which a capture does not show.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <tuple>

#include "checker/evidence/capture/counting.hpp"

namespace stormproof::capture {

class HeartbeatClassifier {
 public:
  /// `is_behind_data`: SEDP DATA came before it in its datagram.
  HeartbeatKind classify(const Event& event, VendorId vendor, bool is_behind_data);
  void saw_acknack(const Event& event);

 private:
  using Writer = std::pair<GuidPrefix, EntityId>;
  using Relation = std::tuple<GuidPrefix, GuidPrefix, EntityId>;
  struct FanOut {
    HeartbeatKind kind = HeartbeatKind::fan_out;
    std::int64_t time_ns = 0;
  };

  [[nodiscard]] HeartbeatKind fan_out(const Event& event, VendorId vendor, bool is_behind_data);

  std::set<Relation> open_;
  std::map<Relation, std::uint64_t> unanswered_;  ///< initial ACKNACKs that ask for a HEARTBEAT
  std::map<Writer, std::int64_t> timer_ns_;       ///< when the periodic timer was armed last
  std::map<std::pair<Writer, std::uint32_t>, FanOut> messages_;  ///< by count
};

}  // namespace stormproof::capture
