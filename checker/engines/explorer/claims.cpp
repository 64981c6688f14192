// What each claim is.
#include "checker/engines/explorer/claims.hpp"

#include <algorithm>
#include <bit>

namespace stormproof::explorer {

void object_to_generated(Frame& frame, Members members, bool is_repair, Members asked,
                         Members generated) {
  frame.count_generated(static_cast<unsigned>(std::popcount(members)));
  if (is_repair && (members & ~asked) != 0) frame.object(Claim::repair_only_if_asked);
  if (frame.no_losses_yet() && (members & generated) != 0) frame.object(Claim::free_threshold);
}

void object_to_listed(Frame& frame, const Slot& acknack, Members received, unsigned descriptors,
                      std::optional<Members> announced) {
  const bool claims = !announced || !acknack.has(Slot::initial);
  const std::uint32_t lacking =
      ~std::uint32_t{received} & announced.value_or(member(descriptors) - 1);
  const auto first = std::min(static_cast<unsigned>(std::countr_one(received)), descriptors);
  if (acknack.set != (claims ? lacking : 0)) frame.object(Claim::snapshot);
  if (announced && acknack.number != (claims ? first : 0)) frame.object(Claim::snapshot);
}

void object_to_taken(Frame& frame, Members listed, const Slot& emitted) {
  if (listed != emitted.set) frame.object(Claim::snapshot);
}

void object_to_copies(Frame& frame, Members carried, Members received) {
  const bool again = (carried & received) != 0;
  if (again && frame.no_losses_yet()) frame.object(Claim::single_copy);
}

void mark_left(Frame& frame, unsigned relation, Members members) {
  frame.erase_marks(What::repair_left, members, relation);
  frame.mark({What::repair_left, 0, members, 0, static_cast<std::uint8_t>(relation)});
}

void check_descriptors(const View& before, const View& now, Members received, Frame& frame,
                       unsigned relation, std::int64_t suppression) {
  if ((now.acknowledged & ~received) != 0) frame.object(Claim::ack_implies_received);
  const unsigned returned = before.suppressed & now.unacknowledged;
  const auto is_mark_of = [relation](const Slot& slot) {
    return slot.what == What::repair_left && slot.relation == relation;
  };
  for (unsigned left = returned; left != 0; left &= left - 1) {
    bool has_left = false;
    for (unsigned k = 0; k < frame.count(); ++k) {
      const Slot& mark = frame.slot(k);
      if (!is_mark_of(mark) || (mark.set & left & -left) == 0) continue;
      has_left = true;
      frame.object_if(Claim::suppression_honoured, 0, k + 1, suppression - 1);
    }
    if (!has_left) frame.object(Claim::suppression_honoured);
  }
  // A mark stays as long as one of its descriptors is suppressed.
  for (unsigned k = frame.count(); k-- > 0;) {
    const Slot slot = frame.slot(k);
    if (!is_mark_of(slot) || (slot.set & now.suppressed) != 0) continue;
    frame.erase_marks(What::repair_left, slot.set, relation);
    k = std::min(k, frame.count());
  }
}

}  // namespace stormproof::explorer
