// What is audited: a composition, the columns that keep what it declares, and the packets that its
// rules receive. And what a choice of its contracts is: whatever the run did.
#pragma once

#include <cstdint>
#include <type_traits>

#include "fsm/composition/control.hpp"
#include "model/engine/packet.hpp"
#include "model/engine/packet_tags.hpp"
#include "model/engine/stored.hpp"
#include "model/fastdds/control.hpp"

namespace stormproof::props {

namespace comp = fsm::composition;
namespace control = comp::control;
using model::packet_kind_of;
namespace lookup = comp::lookup;

/// A choice of a contract: it is whatever the run did.
class Choice {
 public:
  explicit Choice(bool& holds) : holds_{&holds} {}

  [[nodiscard]] bool is_possible() const { return possible_; }
  void take(bool holds) const { *holds_ = holds; }

  friend bool operator!(const Choice& choice) { return !*choice.holds_; }
  friend Choice operator&&(Choice choice, bool other) {
    choice.possible_ = choice.possible_ && other;
    return choice;
  }
  friend Choice operator&&(bool other, Choice choice) { return choice && other; }

 private:
  bool* holds_;  // false, unless the run shows otherwise
  bool possible_ = true;
};

template <class Composition, class Part>
inline constexpr bool has_part = model::detail::is_listed<Part>(typename Composition::Parts{});

/// Plain, and events are kept apart.
template <class Composition>
struct AuditColumns : model::PlainColumns {
  template <class T>
  static constexpr auto column(T thing) {
    if constexpr (requires { T::counted; }) {
      return model::way::Nothing{};
    } else {
      return PlainColumns::column(thing);
    }
  }
  template <comp::Owner owner>
  static std::uint32_t rows(const model::RunState& run) {
    if constexpr (owner == comp::owner::control_relation) {
      return model::fastdds::ControlRelations{run.topology, run.scenario}.count();
    } else if constexpr (owner == comp::owner::control_writer) {
      return model::fastdds::control_writers * run.topology.participant_count();
    } else {
      return PlainColumns::rows<owner>(run);
    }
  }
};

struct NobodyQueues : comp::Flag<comp::owner::entry> {};
template <class Composition>
struct QueuedIn {
  using type = NobodyQueues;
};
template <class Composition>
requires requires { typename Composition::IsQueued; }
struct QueuedIn<Composition> {
  using type = typename Composition::IsQueued;
};

/// What is audited.
template <class Composition_>
struct Audited {
  using Composition = Composition_;
  using Things = model::ThingsOf<Composition>;  ///< that it keeps itself
  using Columns = AuditColumns<Composition>;
  using Heard =
      comp::Joined<fsm::TypeList<typename Composition::IsOpen, comp::X>,
                   std::conditional_t<model::detail::is_listed<lookup::GetsSamples>(Things{}),
                                      fsm::TypeList<lookup::GetsSamples>, fsm::TypeList<>>>;
  using Packet = model::Packet;  ///< that rules receive
};

}  // namespace stormproof::props
