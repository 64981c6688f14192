// One relation as a world for the explorer: which rule each event is, and what must hold after it.
// The rules are those that the simulator executes, in the order in which it does, so a path of the
// explorer can be run by the simulator.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include <fmt/core.h>

#include "checker/engines/explorer/rule_host.hpp"

namespace stormproof::explorer {

template <class Packing>
class RelationWorld {
 public:
  using Host = RuleHost<Packing>;
  using Composition = typename Packing::Composition;
  using C = typename Host::C;
  using State = typename Host::State;

  /// `scenario` is the one that runs, `specification` the one whose τ_S has to be honoured.
  RelationWorld(const model::Scenario& scenario, const model::Scenario& specification,
                const Scope& scope, const model::Mutation& mutation)
      : suppression_ns_{specification.dds.sedp.nack_suppression_duration.count()},
        scope_{scope},
        rules_{mutation.events, Packing::receives_separately},
        live_bitmaps_{mutation.live_bitmaps},
        host_{scenario, scope, mutation} {}

  /// The initial state; `frame` is empty.
  State start(Frame& frame);
  /// `slot` happens.
  void fire(State& state, Frame& frame, const Slot& slot);

  [[nodiscard]] bool complete(const State& state) const {
    return received(state) == member(descriptors()) - 1;
  }
  [[nodiscard]] Members received(const State& state) const { return state.template get<comp::X>(); }
  [[nodiscard]] unsigned descriptors() const { return host_.descriptors(); }
  [[nodiscard]] const Scope& scope() const { return scope_; }
  [[nodiscard]] const EventRules& rules() const { return rules_; }
  /// The state in words.
  [[nodiscard]] std::string describe(const State& state) const;

 private:
  void happen(const Slot& slot);
  void open_writer() { host_.template run_rule<comp::Happens<typename Packing::WriterOpens>>(); }
  [[nodiscard]] bool opens_at_once() const {
    return Packing::one_event_opens_both && !scope_.side_by_side;
  }

  const std::int64_t suppression_ns_;
  const Scope scope_;
  const EventRules rules_;
  const bool live_bitmaps_;
  Host host_;
};

template <class Packing>
auto RelationWorld<Packing>::start(Frame& frame) -> State {
  static_assert(std::has_unique_object_representations_v<State>);
  State state;
  host_.go_on_with(state, frame);
  host_.packing().start(host_);
  const std::int64_t apart = scope_.side_by_side ? scope_.largest_delay.count() : 0;
  frame.schedule_between({What::reader_opens}, 0, apart);
  if (!opens_at_once()) frame.schedule_between({What::writer_opens}, 0, apart);
  return state;
}

template <class Packing>
void RelationWorld<Packing>::fire(State& state, Frame& frame, const Slot& slot) {
  const State before = state;
  host_.go_on_with(state, frame);
  happen(slot);
  check_descriptors<C>(before, state, frame, suppression_ns_);
  if (frame.pending(What::heartbeat_expiry) > 1) frame.object(Claim::single_heartbeat);
}

template <class Packing>
void RelationWorld<Packing>::happen(const Slot& slot) {
  switch (slot.what) {
    case What::reader_opens:
      host_.template run_rule<comp::Happens<comp::ReaderOpens>>();
      if (opens_at_once()) open_writer();
      break;
    case What::writer_opens:
      open_writer();
      break;
    case What::creation:
      host_.packing().create(host_, slot);
      break;
    case What::data:
      note_copies(host_.state(), host_.frame(), slot.set);
      host_.template run_rule<comp::Received<typename Composition::Data>>(&slot);
      break;
    case What::heartbeat:
      host_.template run_rule<comp::Received<typename Composition::Heartbeat>>(&slot);
      break;
    case What::acknack: {
      const Slot arrived = live_bitmaps_ ? host_.said_now(slot) : slot;
      host_.acknack_is_as_emitted(arrived == slot);
      host_.template run_rule<comp::Received<typename Composition::AckNack>>(&arrived);
      break;
    }
    case What::source_completion:
      if constexpr (Packing::repairs_leave_later) {
        for (unsigned left = slot.set; left != 0; left &= left - 1) {
          note_left(host_.frame(), static_cast<Members>(left & -left));
        }
        host_.template run_rule<comp::LeftSource<typename Composition::Data>>(&slot);
      }
      break;
    default:
      host_.run_due(slot.what);
  }
}

template <class Packing>
std::string RelationWorld<Packing>::describe(const State& state) const {
  std::string letters;
  std::string bits;
  std::string each;
  for (unsigned d = 0; d < descriptors(); ++d) {
    const std::string_view name =
        fsm::Reflect<typename C::Machine>::state_names[state.template state<C>(d)];
    const char bit = (received(state) & member(d)) != 0 ? '1' : '0';
    each += fmt::format("{}d{}: C = {}, X = {}", d == 0 ? "" : "; ", d, name, bit);
    letters += name == "Absent" ? "-" : name;
    bits += bit;
  }
  constexpr unsigned few = 3;
  return descriptors() <= few ? each : "C = " + letters + ", X = " + bits;
}

}  // namespace stormproof::explorer
