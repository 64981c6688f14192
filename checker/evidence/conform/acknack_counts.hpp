// The counts of ACKNACKs. A reader of Fast DDS counts all that it sends, whichever writer they are
// for, one of Cyclone DDS those to each writer but for its pre-emptive ones, whose count is 0; and
// both send what they have counted before they count on.
#pragma once

#include <map>
#include <optional>

#include "checker/evidence/conform/context.hpp"

namespace stormproof::conform {

class AckNackCounts {
 public:
  /// `of_each_writer`: whether a reader counts those to each writer by themselves.
  AckNackCounts(const Dialogue& dialogue, bool of_each_writer);

  /// The first ACKNACK of a reader whose count is impossible, if it is in this relation.
  [[nodiscard]] std::optional<Unexplained> fault_in(const Relation& relation) const;

 private:
  std::map<Place, Unexplained> faults_;
};

}  // namespace stormproof::conform
