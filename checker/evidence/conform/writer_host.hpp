// The host of the writer's rules (fsm/composition/fastdds.hpp) in a replay of the DATA of one
// captured relation: it keeps the writer's view of the descriptors and the timers of their repair.
// Which ACKNACKs arrive when is the replay's choice, and which descriptors are sent when, the
// capture says: what the rules put into the asynchronous queue waits until then. HEARTBEATs are
// explained by themselves (heartbeats.hpp); the timer behind them is stepped, and nothing follows.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>
#include <vector>

#include <boost/pfr.hpp>

#include "checker/evidence/conform/ledger.hpp"
#include "checker/evidence/conform/relation_host.hpp"
#include "checker/evidence/conform/replayed.hpp"

namespace stormproof::conform {

namespace comp = fsm::composition;

class WriterHost final : public RelationHost, public ReplayedWriter {
 public:
  using Composition = comp::fastdds::FastDds;
  using Packet = Answer;
  using C = comp::fastdds::C;

  /// `count`: how many descriptors there are in all.
  WriterHost(const model::DdsProfile& dds, std::uint32_t count,
             Tally<fsm::ChangeForReader>& changes, Tally<fsm::SingleShot>& timers)
      : RelationHost{dds, count},
        changes_{changes},
        timers_{timers},
        states_(count, Tally<fsm::ChangeForReader>::Fly::initial),
        exists_(model::words_for(count)) {}

  void open(std::uint32_t existing) override {
    for (std::uint32_t k = 0; k < exists_.size(); ++k) exists_[k] = model::bits_below(existing, k);
    model::run_rule<comp::Happens<comp::fastdds::WriterOpens>>(*this, 0);
  }
  void receive(const Answer& answer, std::int64_t now_ns) override {
    now_ns_ = now_ns;
    model::run_rule<comp::Received<comp::fastdds::AckNack>>(*this, 0, &answer);
  }
  bool create(std::uint32_t descriptor, std::int64_t now_ns) override {
    now_ns_ = now_ns;
    is_served_ = false;
    model::run_rule<comp::Happens<comp::fastdds::Created>>(*this, 0, nullptr, descriptor);
    return is_served_;
  }
  bool serve(std::uint32_t descriptor, std::int64_t now_ns) override {
    now_ns_ = now_ns;
    is_served_ = false;
    model::RunningWorld<WriterHost, comp::owner::entry> w{*this, 0, nullptr, descriptor};
    w.call(comp::fastdds::Deliver{}, comp::fastdds::ToRequesters{});
    return is_served_;
  }
  void respond(std::int64_t now_ns) override {
    now_ns_ = now_ns;
    model::run_rule<comp::Due<comp::fastdds::NackResponseDue>>(*this, 0);
  }
  void end_suppression(std::int64_t now_ns) override {
    if (now_ns < suppressed_until_ns_) return;
    now_ns_ = now_ns;
    suppressed_until_ns_ = INT64_MAX;
    model::run_rule<comp::Due<comp::fastdds::SuppressionEnd>>(*this, 0);
  }
  [[nodiscard]] fsm::StateId state_of(std::uint32_t descriptor) const override {
    return states_[descriptor];
  }

  // What a RunningWorld asks of its host.
  /// No capture is held against a profile with cycles, whose readers are counted.
  template <class Tag, class World>
  [[nodiscard]] auto answer(Tag, const World&) const {
    if constexpr (std::is_same_v<Tag, comp::Now>) {
      return now_ns_;
    } else if constexpr (std::derived_from<Tag, comp::Amount>) {
      return std::int64_t{0};
    } else {
      return std::is_same_v<Tag, comp::fastdds::CrossHost>;
    }
  }
  /// When the queue is sent, the capture says.
  template <class World>
  [[nodiscard]] static bool fact(comp::fastdds::QueueNotEmpty, World&) {
    return false;
  }
  [[nodiscard]] std::span<const std::uint32_t> readers(std::uint32_t) const {
    static constexpr std::uint32_t only = 0;
    return {&only, is_open_ ? 1U : 0U};
  }
  [[nodiscard]] std::span<const std::uint32_t> readers_by_number(std::uint32_t writer) const {
    return readers(writer);
  }

  // Machines.
  template <class P>
  auto driver(P) {
    return Machines<P>{*this};
  }
  template <class P>
  fsm::StateId& state(P, std::uint32_t) {
    if constexpr (std::is_same_v<P, comp::fastdds::NackResponse>) return response_;
    if constexpr (std::is_same_v<P, comp::fastdds::Suppression>) return suppression_;
    if constexpr (std::is_same_v<P, comp::fastdds::AsyncRun>) return queue_run_;
    if constexpr (std::is_same_v<P, comp::HeartbeatClock>) return clock_;
  }
  auto& bits(C) { return *this; }
  static constexpr auto lane_order(C) { return nullptr; }
  static void moved(C, std::uint32_t, fsm::StateId, fsm::StateId, std::uint64_t) {}
  [[nodiscard]] std::uint64_t in_state(std::uint32_t, std::uint32_t k, fsm::StateId wanted) const {
    std::uint64_t found = 0;
    const std::size_t end = std::min<std::size_t>(states_.size(), 64 * (std::size_t{k} + 1));
    for (std::size_t d = 64 * std::size_t{k}; d < end; ++d) {
      found |= std::uint64_t{states_[d] == wanted} << d % 64;
    }
    return found;
  }
  [[nodiscard]] fsm::StateId state_of(std::uint32_t, std::uint32_t d) const { return states_[d]; }
  template <class Event, class Effect>
  void step(std::uint32_t, std::uint32_t k, std::uint64_t members,
            const typename Tally<fsm::ChangeForReader>::Fly::Input& input, Effect&& effect) {
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

  // Flags, numbers and what ACKNACKs say.
  template <class V>
  [[nodiscard]] auto value(V, std::uint32_t) const {
    if constexpr (std::is_same_v<V, comp::fastdds::WriterOpen>) {
      return is_open_;
    } else if constexpr (requires { typename V::IsNumber; }) {
      return std::int64_t{0};
    } else {
      return false;
    }
  }
  template <class V, class Value>
  void assign(V, std::uint32_t, Value value) {
    if constexpr (std::is_same_v<V, comp::fastdds::WriterOpen>) is_open_ = value;
  }
  template <class V>
  void assign(V, std::uint32_t, std::uint32_t d, bool holds) {
    if constexpr (!std::is_same_v<V, comp::fastdds::Exists>) return;
    const std::uint64_t it = std::uint64_t{1} << d % 64;
    exists_[d / 64] = (exists_[d / 64] & ~it) | (holds ? it : 0);
  }
  template <class V>
  static void assign_word(V, std::uint32_t, std::uint32_t, std::uint64_t) {}
  template <class V>
  [[nodiscard]] std::uint64_t word(V, std::uint32_t, std::uint32_t k) const {
    return std::is_same_v<V, comp::fastdds::Exists> ? exists_[k] : 0;
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
  [[nodiscard]] static bool said(comp::IsInitial, const Answer& answer) {
    return answer.is_initial;
  }

  // Effects.
  template <class T>
  void schedule(T, std::uint32_t, std::int64_t time) {
    if constexpr (std::is_same_v<T, comp::fastdds::SuppressionEnd>) suppressed_until_ns_ = time;
  }
  template <class T>
  [[nodiscard]] static std::int64_t pending(T, std::uint32_t) {
    return 0;
  }
  template <class T>
  static void cancel(T, std::uint32_t) {}
  template <class P, class World, class... Sayings>
  static void emit(P, World&, const std::tuple<Sayings...>&) {}
  template <class Step, class World, class... Args>
  static void perform(Step, World&, const Args&...) {}
  template <class World, class To>
  void perform(comp::fastdds::Pack, World& w, To) {
    w.for_readers([&](auto& r) { is_served_ = is_served_ || To::serves(r); });
  }

 private:
  template <class P>
  struct Machines {
    WriterHost& host;

    template <class Event, class Input>
    auto step(fsm::StateId& state, const Input& input, std::uint32_t) {
      if constexpr (std::is_same_v<P, comp::HeartbeatClock>) {
        return host.clocks_.step<Event>(state, input);
      } else if constexpr (std::is_same_v<P, comp::fastdds::AsyncRun>) {
        return host.queue_runs_.step<Event>(state, input);
      } else {
        return host.timers_.step<Event>(state, input);
      }
    }
  };

  Tally<fsm::ChangeForReader>& changes_;
  Tally<fsm::SingleShot>& timers_;
  fsm::Stepper<fsm::SingleShot> queue_runs_;
  fsm::Stepper<fsm::HeartbeatTimer> clocks_;
  std::vector<fsm::StateId> states_;
  std::vector<std::uint64_t> exists_;  ///< words
  std::int64_t suppressed_until_ns_ = INT64_MAX;
  fsm::StateId response_ = Tally<fsm::SingleShot>::Fly::initial;
  fsm::StateId suppression_ = Tally<fsm::SingleShot>::Fly::initial;
  fsm::StateId queue_run_ = Tally<fsm::SingleShot>::Fly::initial;
  fsm::StateId clock_ = fsm::Stepper<fsm::HeartbeatTimer>::initial;
  bool is_open_ = false;
  bool is_served_ = false;
};

}  // namespace stormproof::conform
