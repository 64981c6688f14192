// One relation as a world for the explorer, or those of one writer to several readers, or of both
// writers of a participant: which rule each event is, and what must hold after it.
// The rules are those that the simulator executes, in the order in which it does, so a path of the
// explorer can be run by the simulator.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include <fmt/core.h>

#include "checker/engines/explorer/rule_host.hpp"

namespace stormproof::explorer {

template <class Packing, unsigned readers = 1, unsigned writers = 1>
class RelationWorld {
 public:
  using Host = RuleHost<Packing, readers, writers>;
  using Composition = typename Packing::Composition;
  using C = typename Host::C;
  using State = typename Host::State;
  static constexpr unsigned relations = readers * writers;
  static constexpr bool sorts_slots = relations > 1;

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
    return received(state) == (std::uint32_t{1} << deliveries()) - 1;
  }
  /// A bit for each relation and descriptor, relation by relation.
  [[nodiscard]] std::uint32_t received(const State& state) const {
    std::uint32_t bits = 0;
    unsigned end = 0;
    for (unsigned k = 0; k < relations; ++k) {
      bits |= std::uint32_t{state.template get<comp::X>(k)} << end;
      end += descriptors(k);
    }
    return bits;
  }
  [[nodiscard]] unsigned deliveries() const {
    unsigned count = 0;
    for (unsigned k = 0; k < relations; ++k) count += descriptors(k);
    return count;
  }
  [[nodiscard]] unsigned descriptors(unsigned relation = 0) const {
    return host_.descriptors(relation);
  }
  [[nodiscard]] const Scope& scope() const { return scope_; }
  [[nodiscard]] const EventRules& rules() const { return rules_; }
  /// The state in words.
  [[nodiscard]] std::string describe(const State& state) const;

 private:
  void happen(const Slot& slot);
  void schedule_openings(Frame& frame) const;
  /// The sides of all writers with the slot's reader.
  template <class Opens>
  void open(Slot slot) {
    for (unsigned s = 0; s < writers; ++s, ++slot.relation) {
      host_.template run_rule<comp::Happens<Opens>>(slot);
    }
  }
  [[nodiscard]] std::string describe(const State& state, unsigned relation) const;
  [[nodiscard]] bool opens_at_once() const {
    return Packing::one_event_opens_both && !scope_.side_by_side;
  }

  const std::int64_t suppression_ns_;
  const Scope scope_;
  const EventRules rules_;
  const bool live_bitmaps_;
  Host host_;
};

template <class Packing, unsigned readers, unsigned writers>
auto RelationWorld<Packing, readers, writers>::start(Frame& frame) -> State {
  static_assert(std::has_unique_object_representations_v<State>);
  State state;
  host_.go_on_with(state, frame);
  host_.packing().start(host_);
  schedule_openings(frame);
  return state;
}

/// One announcement of the participant opens the reader sides of all its writers, so they open
/// together; the writer sides open in ascending order of the readers, which is what tells these
/// apart. The participant hears first of a reader that joins later, and answers at once.
template <class Packing, unsigned readers, unsigned writers>
void RelationWorld<Packing, readers, writers>::schedule_openings(Frame& frame) const {
  const std::int64_t apart = scope_.side_by_side ? scope_.largest_delay.count() : 0;
  const std::int64_t late = scope_.joins_within.count();
  const unsigned early = readers > 1 && late > 0 ? readers - 1 : readers;
  const auto schedule = [&](What what, unsigned reader, std::int64_t within) {
    frame.schedule_between({what, 0, 0, 0, static_cast<std::uint8_t>(reader * writers)}, 0, within);
  };
  const auto in_order = [&](What what, unsigned r, What other, unsigned s) {
    const unsigned first = frame.find(what, 0, r * writers);
    const unsigned second = frame.find(other, 0, s * writers);
    if (std::max(first, second) < frame.count()) frame.precede(first, second);  // no mistake made
  };
  for (unsigned r = 0; r < early; ++r) {
    schedule(What::reader_opens, r, apart);
    if (r == 0) continue;
    in_order(What::reader_opens, r - 1, What::reader_opens, r);
    in_order(What::reader_opens, r, What::reader_opens, r - 1);
  }
  for (unsigned r = 0; r < early && !opens_at_once(); ++r) {
    schedule(What::writer_opens, r, apart);
    if (r > 0) in_order(What::writer_opens, r - 1, What::writer_opens, r);
  }
  if (early == readers) return;
  if (!opens_at_once()) schedule(What::writer_opens, early, late);
  schedule(What::reader_opens, early, late);
  in_order(What::writer_opens, early, What::reader_opens, early);
  in_order(What::reader_opens, early, What::writer_opens, early);
}

template <class Packing, unsigned readers, unsigned writers>
void RelationWorld<Packing, readers, writers>::fire(State& state, Frame& frame, const Slot& slot) {
  const State before = state;
  host_.go_on_with(state, frame);
  happen(slot);
  for (unsigned k = 0; k < relations; ++k) {
    check_descriptors<C>(before, state, frame, k, suppression_ns_);
  }
  for (unsigned s = 0; s < writers; ++s) {
    if (frame.pending(What::heartbeat_expiry, s) > 1) frame.object(Claim::single_heartbeat);
  }
  if constexpr (readers > 1) {
    // Completion counts from the last opening.
    const bool opens = slot.what == What::reader_opens || slot.what == What::writer_opens;
    if (!opens || frame.find(What::opened) == frame.count()) return;
    frame.erase_marks(What::opened, 0);
    frame.mark({What::opened});
  }
}

template <class Packing, unsigned readers, unsigned writers>
void RelationWorld<Packing, readers, writers>::happen(const Slot& slot) {
  host_.arrives_from(slot);
  switch (slot.what) {
    case What::reader_opens:
      open<comp::ReaderOpens>(slot);
      if (opens_at_once()) open<typename Packing::WriterOpens>(slot);
      break;
    case What::writer_opens:
      open<typename Packing::WriterOpens>(slot);
      break;
    case What::creation:
      host_.packing().create(host_, slot);
      break;
    case What::data:
      note_copies(host_.state(), host_.frame(), slot.relation, slot.set);
      host_.template run_rule<comp::Received<typename Composition::Data>>(slot);
      break;
    case What::heartbeat:
      host_.template run_rule<comp::Received<typename Composition::Heartbeat>>(slot);
      break;
    case What::acknack: {
      const Slot arrived = live_bitmaps_ ? host_.said_now(slot) : slot;
      host_.template run_rule<comp::Received<typename Composition::AckNack>>(arrived);
      break;
    }
    case What::source_completion:
      if constexpr (Packing::repairs_leave_later) {
        for (unsigned left = slot.set; left != 0; left &= left - 1) {
          note_left(host_.frame(), slot.relation, static_cast<Members>(left & -left));
        }
        host_.template run_rule<comp::LeftSource<typename Composition::Data>>(slot);
      }
      break;
    default:
      host_.run_due(slot);
  }
}

template <class Packing, unsigned readers, unsigned writers>
std::string RelationWorld<Packing, readers, writers>::describe(const State& state) const {
  if constexpr (relations == 1) return describe(state, 0);
  std::string text;
  for (unsigned k = 0; k < relations; ++k) {
    text +=
        fmt::format("{}{}: {}", k == 0 ? "" : "; ", relation_text(scope_, k), describe(state, k));
  }
  return text;
}

template <class Packing, unsigned readers, unsigned writers>
std::string RelationWorld<Packing, readers, writers>::describe(const State& state,
                                                               unsigned relation) const {
  std::string letters;
  std::string bits;
  std::string each;
  for (unsigned d = 0; d < descriptors(relation); ++d) {
    const std::string_view name =
        fsm::Reflect<typename C::Machine>::state_names[state.template state<C>(d, relation)];
    const char bit = (state.template get<comp::X>(relation) & member(d)) != 0 ? '1' : '0';
    each += fmt::format("{}d{}: C = {}, X = {}", d == 0 ? "" : "; ", d, name, bit);
    letters += name == "Absent" ? "-" : name;
    bits += bit;
  }
  constexpr unsigned few = 3;
  return descriptors(relation) <= few ? each : "C = " + letters + ", X = " + bits;
}

}  // namespace stormproof::explorer
