// What the hosts of a replay have in common (reader_host.hpp, writer_host.hpp): one captured
// relation across hosts, a clock that the replay sets, and the state of the rules, which follows
// from the composition (model/engine/kept.hpp). Whose rules they are, and what those leave to a
// host, a side says. It has
//   Composition, Packet     the rules, and what arrives: a Submessage or an Answer
//   Unobserved              parts of which nothing is captured: their rows are not counted
//   answer(tag, host, w)    what only it knows; otherwise the present, or that nothing is so
//   perform(step, w, …)     steps without one run their contract, of which nothing happens that it
//                           leaves open: what was sent, and when a queue is, the capture says
#pragma once

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "checker/evidence/conform/dialogue.hpp"
#include "checker/evidence/conform/machines.hpp"
#include "fsm/composition/packets.hpp"
#include "fsm/event_thread.hpp"
#include "model/engine/kept.hpp"
#include "model/engine/running_world.hpp"

namespace stormproof::conform {

namespace comp = fsm::composition;

/// There is one of each owner.
struct OneRelation {
  std::uint32_t count = 0;  ///< descriptors that the writer has

  [[nodiscard]] static model::Pair pair(std::uint32_t) { return {0, 1, 0, true}; }
  [[nodiscard]] std::uint32_t descriptor_count(std::uint32_t, model::Stream) const { return count; }
};
struct OneOfEach {
  template <class T>
  static constexpr auto column(T) {
    if constexpr (model::IsTimer<T> || (model::IsMachine<T> && model::is_of_descriptors<T>)) {
      return model::way::Elsewhere{};
    } else {
      return std::conditional_t<model::is_of_descriptors<T>, model::way::Bits, model::way::Cell>{};
    }
  }
  template <comp::Owner>
  static std::uint32_t rows(const OneRelation&) {
    return 1;
  }
  static std::uint32_t row(comp::Owner, std::uint32_t, const OneRelation&) { return 0; }
};

/// The writer's view of its descriptors, each with a state of its own; rows that fire are counted.
class ChangeStates {
  using Changes = Tally<fsm::ChangeForReader>;

 public:
  ChangeStates(std::uint32_t count, Changes& changes)
      : changes_{changes}, states_(count, Changes::Fly::initial) {}

  [[nodiscard]] fsm::StateId state_of(std::uint32_t, std::uint32_t d) const { return states_[d]; }
  [[nodiscard]] std::uint64_t in_state(std::uint32_t, std::uint32_t k, fsm::StateId wanted) const {
    std::uint64_t found = 0;
    const std::size_t end = std::min<std::size_t>(states_.size(), 64 * (std::size_t{k} + 1));
    for (std::size_t d = 64 * std::size_t{k}; d < end; ++d) {
      found |= std::uint64_t{states_[d] == wanted} << d % 64;
    }
    return found;
  }
  template <class Event, class Effect>
  void step(std::uint32_t, std::uint32_t k, std::uint64_t members, const Changes::Fly::Input& input,
            Effect&& effect) {
    for (std::uint64_t left = members; left != 0; left &= left - 1) {
      fsm::StateId& state = states_[64 * k + static_cast<std::uint32_t>(std::countr_zero(left))];
      const fsm::StateId before = state;
      const auto output = changes_.step<Event>(state, input);
      effect(left & -left, output, before, state);
    }
  }
  template <class Event, class LaneInput, class Order, class Effect>
  void step_each(std::uint32_t relation, std::uint32_t k, std::uint64_t members,
                 const LaneInput& lanes, const Order&, Effect&& effect) {
    for (std::uint64_t left = members; left != 0; left &= left - 1) {
      const std::uint64_t it = left & -left;
      step<Event>(relation, k, it,
                  {.listed = (lanes.listed.bits & it) != 0,
                   .below_base = (lanes.below_base.bits & it) != 0},
                  effect);
    }
  }

 private:
  Changes& changes_;
  std::vector<fsm::StateId> states_;
};

/// What the relation is, and what its messages say.
class CapturedRelation {
 public:
  using OwnThings = fsm::TypeList<>;

  explicit CapturedRelation(std::uint32_t count) : relation_{count} {}

  [[nodiscard]] const OneRelation& topology() const { return relation_; }
  [[nodiscard]] static std::uint64_t word(comp::Carries, const Submessage& message,
                                          std::uint32_t k) {
    const std::uint32_t d = message.descriptor.value_or(UINT32_MAX);
    return d / 64 == k ? std::uint64_t{1} << d % 64 : 0;
  }
  [[nodiscard]] static std::uint64_t word(comp::Announces, const Submessage& message,
                                          std::uint32_t k) {
    return message.heartbeat ? model::bits_below(message.heartbeat->announced, k) : 0;
  }
  [[nodiscard]] static std::uint64_t word(comp::Listed, const Answer& answer, std::uint32_t k) {
    std::uint64_t bits = 0;
    for (auto d = std::ranges::lower_bound(answer.missing, 64 * k);
         d != answer.missing.end() && *d / 64 == k; ++d) {
      bits |= std::uint64_t{1} << *d % 64;
    }
    return bits;
  }
  [[nodiscard]] static std::uint64_t word(comp::BelowBase, const Answer& answer, std::uint32_t k) {
    return model::bits_below(answer.base, k);
  }
  [[nodiscard]] static bool said(comp::CarriesHeartbeat, const Submessage& message) {
    return message.heartbeat.has_value();
  }
  [[nodiscard]] static bool said(comp::IsInitial, const Answer& answer) {
    return answer.is_initial;
  }

 protected:
  [[nodiscard]] const OneRelation& numbering() const { return relation_; }

 private:
  const OneRelation relation_;
};

namespace detail {
template <class... Parts>
Tallies<typename Parts::Machine...> machines_of(fsm::TypeList<Parts...>);

/// When it is due, as it was scheduled last.
template <class Timer>
struct DueOf {
  std::optional<std::int64_t> ns{};
};
template <class... Timers>
struct AllDue : DueOf<Timers>... {};
template <class... Timers>
AllDue<Timers...> due_of(fsm::TypeList<Timers...>);
}  // namespace detail

template <class Self, class Side>
class RelationHost : public model::Kept<Self, CapturedRelation,
                                        model::ThingsOf<typename Side::Composition>, OneOfEach> {
  using Below =
      model::Kept<Self, CapturedRelation, model::ThingsOf<typename Side::Composition>, OneOfEach>;

 public:
  using Composition = typename Side::Composition;
  using Packet = typename Side::Packet;

  /// `count`: how many descriptors the writer has. The delays of SEDP in `dds` are those of the
  /// relation.
  RelationHost(const model::DdsProfile& dds, std::uint32_t count, Machines& machines)
      : Below{count},
        dds_{dds},
        machines_{machines},
        changes_{count, machines.fastdds.of<fsm::ChangeForReader>()} {}

  /// Runs the rule of what happens now.
  template <class Trigger>
  void run(const Packet* packet = nullptr, std::uint32_t descriptor = 0) {
    using Rule = comp::RuleFor<Composition, Trigger>;
    model::RunningWorld<Self, Rule::owner> w{this->self(), 0, packet, descriptor};
    Rule::run(w);
  }
  template <class Timer>
  [[nodiscard]] std::optional<std::int64_t>& due() {
    return static_cast<detail::DueOf<Timer>&>(due_).ns;
  }
  [[nodiscard]] Side& side() { return side_; }

  // What a RunningWorld asks of its host.
  [[nodiscard]] std::int64_t now() const { return now_ns_; }
  template <class Knob>
  [[nodiscard]] auto knob(Knob knob) const {
    return model::knob_value(knob, dds_);
  }
  template <class Tag, class W>
  [[nodiscard]] auto answer(Tag tag, const W& w) const {
    if constexpr (requires { side_.answer(tag, *this, w); }) {
      return side_.answer(tag, *this, w);
    } else if constexpr (std::is_same_v<Tag, comp::Now>) {
      return now_ns_;
    } else if constexpr (std::derived_from<Tag, comp::Amount>) {
      return std::int64_t{0};
    } else {
      return std::is_same_v<Tag, comp::CrossHost>;
    }
  }
  [[nodiscard]] static bool choice() { return false; }
  /// Of the writer there is this one.
  [[nodiscard]] std::span<const std::uint32_t> readers(std::uint32_t) const {
    static constexpr std::uint32_t only = 0;
    return {&only, this->value(typename Composition::IsOpen{}, 0) ? 1U : 0U};
  }
  [[nodiscard]] std::span<const std::uint32_t> readers_by_number(std::uint32_t writer) const {
    return readers(writer);
  }
  template <class P>
  auto& driver(P) {
    if constexpr (model::detail::is_listed<P>(typename Side::Unobserved{})) {
      return unobserved_.template of<typename P::Machine>();
    } else {
      return machines_.fastdds.of<typename P::Machine>();
    }
  }
  template <class P>
  ChangeStates& bits(P) {
    return changes_;
  }
  template <class P>
  static constexpr auto lane_order(P) {
    return nullptr;
  }
  template <class P>
  static void moved(P, std::uint32_t, fsm::StateId, fsm::StateId, std::uint64_t) {}
  template <class T>
  void schedule(T, std::uint32_t, std::int64_t time) {
    due<T>() = time;
  }
  template <class T>
  [[nodiscard]] std::int64_t pending(T, std::uint32_t) {
    return due<T>() ? 1 : 0;
  }
  template <class T>
  void cancel(T, std::uint32_t) {
    due<T>().reset();
  }
  template <class Step, class W, class... Args>
  void perform(Step step, W& w, const Args&... args) {
    if constexpr (requires { side_.perform(step, w, args...); }) {
      side_.perform(step, w, args...);
    } else {
      Step::contract(w, args...);
    }
  }

 protected:
  std::int64_t now_ns_ = 0;

 private:
  const model::DdsProfile& dds_;
  Machines& machines_;
  decltype(detail::machines_of(typename Side::Unobserved{})) unobserved_;
  ChangeStates changes_;
  decltype(detail::due_of(typename Composition::Timers{})) due_;
  Side side_;
};

}  // namespace stormproof::conform
