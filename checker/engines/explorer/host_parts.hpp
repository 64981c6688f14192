// What the explorer's host of rules is made of, whatever the composition: a stepper for the
// machines of each part, the state of all of them, which of the parts is the writer's view of a
// descriptor, and the open relations as lists.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

#include <boost/pfr.hpp>

#include "checker/engines/explorer/world_state.hpp"
#include "fsm/composition/vocabulary.hpp"
#include "fsm/stepper.hpp"
#include "model/engine/topology.hpp"

namespace stormproof::explorer {

namespace detail {
/// The machines of a part.
template <class P>
class PartMachines {
 public:
  explicit PartMachines(std::span<const fsm::TableMutation> tables) : machines_{tables} {}
  template <class Event>
  auto step(fsm::StateId& state, const typename fsm::Stepper<typename P::Machine>::Input& input,
            std::uint32_t = 0) {
    return machines_.template step<Event>(state, input);
  }

 private:
  fsm::Stepper<typename P::Machine> machines_;
};
template <class Parts>
class Machines;
template <class... Ps>
class Machines<fsm::TypeList<Ps...>> : public PartMachines<Ps>... {
 public:
  explicit Machines(std::span<const fsm::TableMutation> tables) : PartMachines<Ps>{tables}... {}
};

/// The relations of the first `writers` streams of participant 0: the reader of pair r is
/// participant r + 1.
template <unsigned writers>
struct OneParticipant {
  std::array<unsigned, writers> descriptors;
  /// There is nothing in the reverse direction.
  [[nodiscard]] static model::Pair pair(std::uint32_t number) {
    return {0, number + 1, number, true};
  }
  [[nodiscard]] std::uint32_t descriptor_count(std::uint32_t, model::Stream stream) const {
    return descriptors[writers == 1 ? 0 : model::index_of(stream)];
  }
};

template <unsigned writers, class Packing>
OneParticipant<writers> participant_of(const Packing& packing) {
  OneParticipant<writers> participant{};
  for (unsigned s = 0; s < writers; ++s) {
    participant.descriptors[s] = packing.descriptors(model::streams[s]);
  }
  return participant;
}

/// Numbers of explored relations (checker/engines/explorer/slot.hpp), times this, are those of the
/// composition.
template <unsigned writers>
inline constexpr std::uint32_t number_step = 2 / writers;
/// The explored relation of what has a number in `owner`.
template <comp::Owner owner, unsigned readers, unsigned writers>
constexpr unsigned explored_relation(std::uint32_t number) {
  constexpr bool of_reader = (owner.indices & comp::owner::peer_index) != 0;
  constexpr bool of_writer = (owner.indices & comp::owner::stream_index) != 0;
  if constexpr (readers * writers == 1 || (!of_reader && (!of_writer || writers == 1))) return 0;
  return of_writer ? number / number_step<writers> : number * writers;
}

/// What the lanes say of one descriptor.
template <class Input, class Lanes>
Input input_of(std::uint64_t descriptor, const Lanes& lanes) {
  Input input;
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    ((boost::pfr::get<I>(input) = (boost::pfr::get<I>(lanes).bits & descriptor) != 0), ...);
  }
  (std::make_index_sequence<boost::pfr::tuple_size_v<Lanes>>{});
  return input;
}

/// All that a world with this packing and so many readers and writers has to remember.
template <class Packing, unsigned readers, unsigned writers>
using StateOf = WorldState<
    comp::Joined<typename Packing::Composition::Parts, typename Packing::Composition::Timers,
                 typename Packing::Composition::State, typename Packing::State,
                 typename Packing::template SharedState<readers, writers>,
                 fsm::TypeList<Asked, Generated>>,
    Packing::max_descriptors, readers, writers>;

/// All subsets of the numbers first, first + step, first + 2·step, …, each in ascending order.
template <unsigned count>
class Subsets {
 public:
  constexpr Subsets(std::uint32_t first, std::uint32_t step) {
    for (unsigned set = 0; set < sizes_.size(); ++set) {
      for (unsigned k = 0; k < count; ++k) {
        if ((set >> k & 1) != 0) members_[set][sizes_[set]++] = first + k * step;
      }
    }
  }
  [[nodiscard]] std::span<const std::uint32_t> of(unsigned set) const {
    return {members_[set].data(), sizes_[set]};
  }

 private:
  std::array<std::array<std::uint32_t, count>, std::size_t{1} << count> members_{};
  std::array<unsigned, std::size_t{1} << count> sizes_{};
};

/// The numbers of a writer's relations, of which `first` is the one with reader 0, that are open.
template <unsigned readers, class IsOpen>
std::span<const std::uint32_t> relations_of(std::uint32_t first, IsOpen&& is_open) {
  static constexpr std::array<Subsets<readers>, 2> subsets{Subsets<readers>{0, 2},
                                                           Subsets<readers>{1, 2}};
  unsigned open = 0;
  for (unsigned r = 0; r < readers; ++r) open |= static_cast<unsigned>(is_open(r)) << r;
  return subsets[first].of(open);
}

/// The part of which each descriptor has one: the writer's view of it.
template <class... Ps>
auto descriptor_part(fsm::TypeList<Ps...>) {
  return std::get<0>(std::tuple_cat(
      std::conditional_t<Ps::owner == comp::owner::descriptor, std::tuple<Ps>, std::tuple<>>{}...));
}
}  // namespace detail

}  // namespace stormproof::explorer
