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

/// The relations of stream 0 of participant 0: the reader of pair r is participant r + 1.
struct OneWriter {
  unsigned descriptors;
  /// There is nothing in the reverse direction.
  [[nodiscard]] static model::Pair pair(std::uint32_t number) {
    return {0, number + 1, number, true};
  }
  [[nodiscard]] std::uint32_t descriptor_count(std::uint32_t, model::Stream) const {
    return descriptors;
  }
};

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

/// All that a world with this packing and so many readers has to remember.
template <class Packing, unsigned readers>
using StateOf = WorldState<
    comp::Joined<typename Packing::Composition::Parts, typename Packing::Composition::Timers,
                 typename Packing::Composition::State, typename Packing::State,
                 std::conditional_t<(readers > 1), typename Packing::SharedState, fsm::TypeList<>>,
                 fsm::TypeList<Asked, Generated>>,
    Packing::max_descriptors, readers>;

/// All subsets of the numbers 0, step, 2·step, …, each in ascending order.
template <unsigned count>
class Subsets {
 public:
  explicit constexpr Subsets(std::uint32_t step) {
    for (unsigned set = 0; set < sizes_.size(); ++set) {
      for (unsigned k = 0; k < count; ++k) {
        if ((set >> k & 1) != 0) members_[set][sizes_[set]++] = k * step;
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

/// The part of which each descriptor has one: the writer's view of it.
template <class... Ps>
auto descriptor_part(fsm::TypeList<Ps...>) {
  return std::get<0>(std::tuple_cat(
      std::conditional_t<Ps::owner == comp::owner::descriptor, std::tuple<Ps>, std::tuple<>>{}...));
}
}  // namespace detail

}  // namespace stormproof::explorer
