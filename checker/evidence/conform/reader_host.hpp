// The host of the reader's rules (fsm/composition/reader.hpp, as Fast DDS completes them) in a
// replay of one captured relation: it keeps the reader's state and its clock, and says what the
// rules would have sent. Which submessages arrive, and when timers are served, is the replay's
// choice. Of the rules' world (model/engine/running_world.hpp) it has what the reader side needs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "checker/evidence/conform/reader_side.hpp"
#include "checker/evidence/conform/relation_host.hpp"
#include "checker/evidence/conform/replayed.hpp"

namespace stormproof::conform {

namespace comp = fsm::composition;

class ReaderHost final : public RelationHost, public ReplayedReader {
 public:
  using Composition = comp::fastdds::FastDds;
  using Packet = Submessage;
  /// `count`: how many descriptors the writer has.
  ReaderHost(const model::DdsProfile& dds, std::uint32_t count, ReaderMachines& machines,
             Tally<fsm::SingleShot>& timers)
      : RelationHost{dds, count},
        machines_{machines},
        timers_{timers},
        x_(model::words_for(count)),
        known_(model::words_for(count)) {}

  void open(std::int64_t now_ns) override { run<comp::Happens<comp::ReaderOpens>>(now_ns); }
  void receive(const Submessage& message, std::int64_t now_ns) override {
    if (message.descriptor) run<comp::Received<comp::fastdds::Data>>(now_ns, &message);
    if (message.heartbeat) run<comp::Received<comp::fastdds::Heartbeat>>(now_ns, &message);
  }
  std::optional<MadeAckNack> attempt(std::int64_t now_ns) override {
    return run<comp::Due<comp::InitialAttempt>>(now_ns);
  }
  std::optional<MadeAckNack> reply(std::int64_t now_ns) override {
    return run<comp::Due<comp::AckNackGeneration>>(now_ns);
  }
  void ask_again(std::int64_t now_ns) override {
    now_ns_ = now_ns;
    model::RunningWorld<ReaderHost, comp::owner::relation> w{*this, 0};
    Composition::answer_later(w);
  }

  // What a RunningWorld asks of its host.
  /// Of the writer there is this one.
  [[nodiscard]] static std::array<std::uint32_t, 1> readers(std::uint32_t) { return {0}; }
  template <class World>
  [[nodiscard]] std::int64_t answer(comp::Now, const World&) const {
    return now_ns_;
  }
  /// What the application is told, no ACKNACK says.
  template <class World>
  [[nodiscard]] static bool answer(comp::RunEnds, const World&) {
    return true;
  }
  template <class World>
  [[nodiscard]] static bool answer(comp::fastdds::CrossHost, const World&) {
    return true;
  }

  template <class P>
  auto driver(P) {
    return Machines<P>{*this};
  }
  fsm::StateId& state(comp::Reader, std::uint32_t) { return reader_; }
  fsm::StateId& state(comp::InitialTimer, std::uint32_t) { return initial_; }
  fsm::StateId& state(comp::fastdds::Reply, std::uint32_t) { return reply_; }

  [[nodiscard]] bool value(comp::HeartbeatSeen, std::uint32_t) const { return heartbeat_seen_; }
  [[nodiscard]] std::int64_t value(comp::LastDelay, std::uint32_t) const {
    return initial_delay_ns_;
  }
  void assign(comp::HeartbeatSeen, std::uint32_t, bool holds) { heartbeat_seen_ = holds; }
  void assign(comp::LastDelay, std::uint32_t, std::int64_t delay) { initial_delay_ns_ = delay; }
  static void assign(comp::fastdds::Notified, std::uint32_t, std::uint32_t, bool) {}
  void assign_word(comp::X, std::uint32_t, std::uint32_t k, std::uint64_t bits) { x_[k] = bits; }
  void assign_word(comp::fastdds::Known, std::uint32_t, std::uint32_t k, std::uint64_t bits) {
    known_[k] = bits;
  }
  [[nodiscard]] std::uint64_t word(comp::X, std::uint32_t, std::uint32_t k) const { return x_[k]; }
  [[nodiscard]] std::uint64_t word(comp::fastdds::Known, std::uint32_t, std::uint32_t k) const {
    return known_[k];
  }
  [[nodiscard]] static std::uint64_t word(comp::fastdds::Notified, std::uint32_t, std::uint32_t) {
    return 0;
  }
  [[nodiscard]] static std::uint64_t word(comp::Carries, const Submessage& packet,
                                          std::uint32_t k) {
    const std::uint32_t d = packet.descriptor.value_or(UINT32_MAX);
    return d / 64 == k ? std::uint64_t{1} << d % 64 : 0;
  }
  [[nodiscard]] static std::uint64_t word(comp::Announces, const Submessage& packet,
                                          std::uint32_t k) {
    return packet.heartbeat ? model::bits_below(packet.heartbeat->announced, k) : 0;
  }
  /// Each HEARTBEAT is a submessage of its own, also behind DATA.
  [[nodiscard]] static bool said(comp::CarriesHeartbeat, const Submessage&) { return false; }

  void schedule(comp::AckNackGeneration, std::uint32_t, std::int64_t time) { reply_due_ns_ = time; }
  void schedule(comp::InitialAttempt, std::uint32_t, std::int64_t) { waits_for_initial_ = true; }
  template <class World, class... Sayings>
  void emit(comp::fastdds::AckNack, World& w, const std::tuple<Sayings...>& sayings) {
    said_.emplace();
    std::apply([&](const auto&... each) { (say(w, each), ...); }, sayings);
  }
  template <class World>
  static void perform(comp::control::OpenTopics, World&) {}

 private:
  /// Runs the rule of what happens at this time; returns what it sends.
  template <class Trigger>
  std::optional<MadeAckNack> run(std::int64_t now_ns, const Submessage* packet = nullptr) {
    now_ns_ = now_ns;
    said_.reset();
    model::run_rule<Trigger>(*this, 0, packet);
    return std::move(said_);
  }

  template <class P>
  struct Machines {
    ReaderHost& host;

    template <class Event, class Input>
    auto step(fsm::StateId& state, const Input& input, std::uint32_t) {
      if constexpr (std::is_same_v<P, comp::Reader>) {
        return host.machines_.reader.step<Event>(state, input);
      } else if constexpr (std::is_same_v<P, comp::InitialTimer>) {
        return host.machines_.initial.step<Event>(state, input);
      } else {
        return host.timers_.step<Event>(state, input);
      }
    }
  };
  template <class World, class Saying>
  void say(World& w, const Saying& saying) {
    using Field = typename Saying::Field;
    if constexpr (std::is_same_v<Field, comp::IsInitial>) {
      said_->is_initial = saying.value;
    } else if constexpr (std::is_same_v<Field, comp::BelowBase>) {
      said_->base = static_cast<std::uint32_t>(w.count(saying.value));
    } else {
      static_assert(std::is_same_v<Field, comp::Listed>);
      said_->listed = w.set_of(saying.value);
    }
  }

  ReaderMachines& machines_;
  Tally<fsm::SingleShot>& timers_;
  fsm::StateId reader_ = Tally<fsm::DiscoveryReader>::Fly::initial;
  fsm::StateId initial_ = Tally<fsm::InitialAckNack>::Fly::initial;
  fsm::StateId reply_ = Tally<fsm::SingleShot>::Fly::initial;
  bool heartbeat_seen_ = false;
  std::vector<std::uint64_t> x_;  ///< words
  std::vector<std::uint64_t> known_;
  std::optional<MadeAckNack> said_;
};

}  // namespace stormproof::conform
