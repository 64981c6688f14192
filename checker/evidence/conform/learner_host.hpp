// The hosts of the readers' rules that a Discovery Server adds (fsm/composition/server.hpp), in a
// replay of one captured relation: a client's reader of one of the server's relays, and the
// server's reader of a client's announcements. They keep what the reader knows, and its timers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include "checker/evidence/conform/arrivals.hpp"
#include "checker/evidence/conform/reader_side.hpp"
#include "checker/evidence/conform/relation_host.hpp"
#include "checker/evidence/conform/replayed.hpp"
#include "fsm/composition/server.hpp"

namespace stormproof::conform {

namespace comp = fsm::composition;

/// A client's reader of a relay.
struct OfRelay {
  using Reply = comp::server::LearnerReply;
  using ReplyDue = comp::server::LearnerReplyDue;
  using AttemptDue = comp::server::LearnerAttempt;
  using Seen = comp::server::LearnerHeartbeatSeen;
  using Open = comp::server::LearnerOpen;
  using LastDelay = comp::server::LearnerLastDelay;
  using ResponseDelay = comp::server::LearnerResponseDelay;
  static constexpr comp::Owner owner = comp::owner::relation;
};
/// The server's reader of a client's announcements.
struct OfRegistration {
  using Reply = comp::server::RegistrationReply;
  using ReplyDue = comp::server::RegistrationReplyDue;
  using AttemptDue = comp::server::RegistrationAttempt;
  using Seen = comp::server::RegistrationHeartbeatSeen;
  using Open = comp::Recognised;
  using LastDelay = comp::server::RegistrationLastDelay;
  using ResponseDelay = comp::server::RegistrationResponseDelay;
  static constexpr comp::Owner owner = comp::owner::pair;
};

template <class Of>
class LearnerHost final : public RelationHost, public ReplayedReader {
  static constexpr bool of_relay = std::is_same_v<Of, OfRelay>;

 public:
  using Composition = comp::server::FastDdsServer;
  using Packet = Submessage;
  /// `count`: how many descriptors the writer has. The delays of SEDP in `dds` are those of the
  /// relation.
  LearnerHost(const model::DdsProfile& dds, std::uint32_t count, ReaderMachines& machines,
              Tally<fsm::SingleShot>& timers)
      : RelationHost{dds, count},
        response_delay_ns_{dds.sedp.heartbeat_response_delay.count()},
        machines_{machines},
        timers_{timers} {}

  void open(std::int64_t now_ns) override {
    now_ns_ = now_ns;
    if constexpr (of_relay) {
      model::run_rule<comp::Happens<comp::server::LearnerOpens>>(*this, 0);
    } else {
      // RegistrationArrives does much else.
      is_open_ = true;
      model::RunningWorld<LearnerHost, Of::owner> w{*this, 0};
      comp::server::RegistrationAttempts::open(w);
    }
  }
  void receive(const Submessage& message, std::int64_t now_ns) override {
    now_ns_ = now_ns;
    if constexpr (!of_relay) {
      knowledge_.take(message);
      if (!message.heartbeat) return;
      model::run_rule<comp::Received<comp::server::RegistrationHeartbeat>>(*this, 0, &message);
    } else if (message.heartbeat) {
      model::run_rule<comp::Received<comp::server::RelayHeartbeat>>(*this, 0, &message);
    } else if (message.descriptor) {
      model::run_rule<comp::Received<comp::server::RelayedData>>(*this, 0, &message);
    } else {
      model::run_rule<comp::Received<comp::server::Gap>>(*this, 0, &message);
    }
  }
  void ask_again(std::int64_t now_ns) override {
    now_ns_ = now_ns;
    model::RunningWorld<LearnerHost, Of::owner> w{*this, 0};
    comp::request<typename Of::Reply, typename Of::ResponseDelay, typename Of::ReplyDue>(w);
  }
  std::optional<MadeAckNack> attempt(std::int64_t now_ns) override {
    return run<comp::Due<typename Of::AttemptDue>>(now_ns);
  }
  std::optional<MadeAckNack> reply(std::int64_t now_ns) override {
    return run<comp::Due<typename Of::ReplyDue>>(now_ns);
  }

  // What a RunningWorld asks of its host.
  [[nodiscard]] static std::array<std::uint32_t, 1> readers(std::uint32_t) { return {0}; }
  template <class World>
  [[nodiscard]] std::int64_t answer(comp::Now, const World&) const {
    return now_ns_;
  }
  template <class World>
  [[nodiscard]] static bool answer(comp::RunEnds, const World&) {
    return false;
  }
  template <class World>
  [[nodiscard]] std::int64_t answer(comp::server::LearnerResponseDelay, const World&) const {
    return response_delay_ns_;
  }
  [[nodiscard]] static bool said(comp::CarriesHeartbeat, const Submessage& message) {
    return message.heartbeat.has_value();
  }
  [[nodiscard]] bool value(typename Of::Seen, std::uint32_t) const { return heartbeat_seen_; }
  [[nodiscard]] bool value(typename Of::Open, std::uint32_t) const { return is_open_; }
  [[nodiscard]] std::int64_t value(typename Of::LastDelay, std::uint32_t) const {
    return initial_delay_ns_;
  }
  void assign(typename Of::Seen, std::uint32_t, bool holds) { heartbeat_seen_ = holds; }
  void assign(typename Of::Open, std::uint32_t, bool holds) { is_open_ = holds; }
  void assign(typename Of::LastDelay, std::uint32_t, std::int64_t delay) {
    initial_delay_ns_ = delay;
  }

  template <class P>
  auto driver(P) {
    return Machines<P>{*this};
  }
  template <class P>
  fsm::StateId& state(P, std::uint32_t) {
    return std::is_same_v<P, typename Of::Reply> ? reply_ : initial_;
  }
  template <class T>
  void schedule(T, std::uint32_t, std::int64_t time) {
    if constexpr (std::is_same_v<T, typename Of::ReplyDue>) {
      reply_due_ns_ = time;
    } else {
      waits_for_initial_ = true;
    }
  }
  /// It asks for all that is missing of what is announced; an initial one claims nothing.
  template <class P, class World, class... Sayings>
  void emit(P, World&, const std::tuple<Sayings...>&) {
    said_.emplace();
    said_->is_initial = sizeof...(Sayings) > 0;
    if (said_->is_initial) return;
    said_->base = knowledge_.base();
    for (std::uint32_t d = said_->base; d < knowledge_.announced; ++d) {
      if (!knowledge_.knows(d)) said_->listed.add(d / 64, std::uint64_t{1} << d % 64);
    }
  }
  template <class World>
  void perform(comp::server::TakeRelayed, World& w) {
    knowledge_.take(w.packet());
  }

 private:
  template <class Trigger>
  std::optional<MadeAckNack> run(std::int64_t now_ns) {
    now_ns_ = now_ns;
    said_.reset();
    model::run_rule<Trigger>(*this, 0);
    return std::move(said_);
  }

  template <class P>
  struct Machines {
    LearnerHost& host;

    template <class Event, class Input>
    auto step(fsm::StateId& state, const Input& input, std::uint32_t) {
      if constexpr (std::is_same_v<P, typename Of::Reply>) {
        return host.timers_.template step<Event>(state, input);
      } else {
        return host.machines_.initial.template step<Event>(state, input);
      }
    }
  };

  const std::int64_t response_delay_ns_;
  ReaderMachines& machines_;
  Tally<fsm::SingleShot>& timers_;
  fsm::StateId initial_ = Tally<fsm::InitialAckNack>::Fly::initial;
  fsm::StateId reply_ = Tally<fsm::SingleShot>::Fly::initial;
  Knowledge knowledge_{};
  bool is_open_ = false;
  bool heartbeat_seen_ = false;
  std::optional<MadeAckNack> said_;
};

}  // namespace stormproof::conform
