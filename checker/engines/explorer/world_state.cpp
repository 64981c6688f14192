// Places in a state.
#include "checker/engines/explorer/world_state.hpp"

namespace stormproof::explorer {

using fsm::program::Thing;
namespace owner = fsm::composition::owner;

bool Layout::strides(Owner of) const {
  if (has_two_ends_) return of == owner::participant;
  const bool of_reader = readers_ > 1 && (of.indices & owner::peer_index) != 0;
  const bool of_writer = writers_ > 1 && (of.indices & owner::stream_index) != 0;
  return of_reader || of_writer;
}

std::size_t Layout::size_of(const Thing& thing) const {
  const bool of_descriptors = (thing.owner.indices & owner::descriptor_index) != 0;
  if (thing.kind == Thing::Kind::number) return sizeof(std::int64_t);
  if (thing.kind == Thing::Kind::part) return of_descriptors ? descriptors_ : 1;
  if (thing.kind == Thing::Kind::flag) return of_descriptors ? sizeof(Members) : 1;
  return thing.counted ? 1 : 0;
}

void Layout::keep(Tag tag) {
  const Thing& thing = program_.things[tag];
  const std::size_t size = size_of(thing);
  if (size > 0 && !things_[tag].is_kept()) things_[tag] = keep(size, thing.owner);
}

Kept Layout::keep(std::size_t bytes, Owner of) {
  const bool each = strides(of);
  const Kept kept{static_cast<std::uint16_t>(end_), static_cast<std::uint16_t>(each ? bytes : 0)};
  end_ += bytes * (!each ? 1 : has_two_ends_ ? 2 : readers_ * writers_);
  if (end_ > WorldState::capacity) throw std::logic_error{"a state is larger than its room"};
  return kept;
}

}  // namespace stormproof::explorer
