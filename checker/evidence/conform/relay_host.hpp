// The host of the rules of a Discovery Server's writers (fsm/composition/server.hpp) in a replay of
// the DATA of one captured relation: it keeps the list of its reader, and the timers of what is
// sent again. What enters the list, and when the sending thread gets to a change, the capture says.
// HEARTBEATs and GAPs are explained by themselves (server_relay.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <vector>

#include "checker/evidence/conform/ledger.hpp"
#include "checker/evidence/conform/relation_host.hpp"
#include "checker/evidence/conform/replayed.hpp"
#include "fsm/change_for_reader.hpp"
#include "fsm/composition/server.hpp"
#include "fsm/single_shot.hpp"

namespace stormproof::conform {

namespace comp = fsm::composition;

class RelayHost final : public RelationHost, public ReplayedWriter {
  using Changes = Tally<fsm::ChangeForReader>;

 public:
  using Composition = comp::server::FastDdsServer;
  using Packet = Answer;

  /// `count`: how many changes there are in all. The delays of SEDP in `dds` are the relay's.
  RelayHost(const model::DdsProfile& dds, std::uint32_t count, Changes& changes,
            Tally<fsm::SingleShot>& timers)
      : RelationHost{dds, count},
        sedp_{dds.sedp},
        changes_{changes},
        timers_{timers},
        entries_(count) {}

  void open(std::uint32_t existing) override {
    existing_ = existing;
    model::run_rule<comp::Happens<comp::server::RelayOpens>>(*this, 0);
  }
  void receive(const Answer& answer, std::int64_t now_ns) override {
    now_ns_ = now_ns;
    model::run_rule<comp::Received<comp::server::RelayedAckNack>>(*this, 0, &answer);
  }
  bool create(std::uint32_t change, std::int64_t now_ns) override {
    entries_[change].is_listed = true;
    step<fsm::change_for_reader::Created>(entries_[change]);
    return serve(change, now_ns);
  }
  bool serve(std::uint32_t change, std::int64_t now_ns) override {
    namespace states = fsm::change_for_reader;
    constexpr fsm::StateId queued = fsm::Reflect<fsm::ChangeForReader>::id<states::Q>;
    now_ns_ = now_ns;
    is_served_ = false;
    Entry& entry = entries_[change];
    if (!entry.is_listed || entry.state != queued) return false;
    step<states::Serialized>(entry);
    model::run_rule<comp::Happens<comp::server::Served>>(*this, 0);
    model::run_rule<comp::Happens<comp::server::Delivered>>(*this, 0);
    return is_served_;
  }
  void respond(std::int64_t now_ns) override {
    now_ns_ = now_ns;
    model::run_rule<comp::Due<comp::server::RelayResponseDue>>(*this, 0);
  }
  void end_suppression(std::int64_t now_ns) override {
    if (now_ns < suppressed_until_ns_) return;
    now_ns_ = now_ns;
    suppressed_until_ns_ = INT64_MAX;
    model::run_rule<comp::Due<comp::server::RelaySuppressionEnd>>(*this, 0);
  }
  [[nodiscard]] fsm::StateId state_of(std::uint32_t change) const override {
    return entries_[change].state;
  }

  // What a RunningWorld asks of its host.
  template <class Tag, class World>
  [[nodiscard]] auto answer(Tag, const World& w) const {
    namespace server = comp::server;
    if constexpr (std::is_same_v<Tag, comp::Now>) {
      return now_ns_;
    } else if constexpr (std::is_same_v<Tag, server::RelayHeartbeatPeriod>) {
      return sedp_.heartbeat_period.count();
    } else if constexpr (std::is_same_v<Tag, server::RelayResponseDelay>) {
      return sedp_.nack_response_delay.count();
    } else if constexpr (std::is_same_v<Tag, server::RelaySuppressionDuration>) {
      return sedp_.nack_suppression_duration.count();
    } else if constexpr (std::is_same_v<Tag, server::HistoryNotEmpty>) {
      return existing_ > 0;
    } else if constexpr (std::is_same_v<Tag, server::SomeRequested>) {
      return some_requested_;
    } else if constexpr (std::is_same_v<Tag, server::SomeListed>) {
      return !w.packet().missing.empty();
    } else {
      // When the queues are sent, and what a GAP tells, the capture says.
      static_assert(std::is_same_v<Tag, server::SomethingToSend> ||
                    std::is_same_v<Tag, server::SomeIrrelevant>);
      return false;
    }
  }
  [[nodiscard]] static bool said(comp::IsInitial, const Answer& answer) {
    return answer.is_initial;
  }
  [[nodiscard]] bool value(comp::server::RelayOpen, std::uint32_t) const { return is_open_; }
  void assign(comp::server::RelayOpen, std::uint32_t, bool open) { is_open_ = open; }

  [[nodiscard]] static std::array<std::uint32_t, 1> readers(std::uint32_t) { return {0}; }
  template <class P>
  auto driver(P) {
    return Machines<P>{*this};
  }
  template <class P>
  fsm::StateId& state(P, std::uint32_t) {
    if constexpr (std::is_same_v<P, comp::server::RelayResponse>) return response_;
    if constexpr (std::is_same_v<P, comp::server::RelaySuppression>) return suppression_;
    if constexpr (std::is_same_v<P, comp::server::RelayExpiry>) return expiry_;
    if constexpr (std::is_same_v<P, comp::server::SendingThread>) return thread_;
  }
  template <class T>
  void schedule(T, std::uint32_t, std::int64_t time) {
    if constexpr (std::is_same_v<T, comp::server::RelaySuppressionEnd>) suppressed_until_ns_ = time;
  }
  template <class P, class World, class... Sayings>
  void emit(P, World&, const std::tuple<Sayings...>&) {
    if constexpr (std::is_same_v<P, comp::server::RelayedData>) is_served_ = true;
  }

  template <class World>
  void perform(comp::server::ListRelevant, World&) {
    for (std::uint32_t d = 0; d < existing_ && d < entries_.size(); ++d) {
      entries_[d].is_listed = true;
      step<fsm::change_for_reader::ReaderMatched>(entries_[d]);
    }
  }
  template <class World>
  void perform(comp::server::TakeAckNack, World& w) {
    const Answer& answer = w.packet();
    some_requested_ = false;
    for (std::uint32_t d = 0; d < entries_.size(); ++d) {
      Entry& entry = entries_[d];
      if (!entry.is_listed) continue;
      const bool is_below = d < answer.base;
      if (!is_below && !answer.asks_for(d)) continue;
      const auto output = changes_.step<fsm::change_for_reader::AckNackReceived>(
          entry.state, {.listed = !is_below, .below_base = is_below});
      some_requested_ = some_requested_ || output.requested;
      if (is_below) entry.is_listed = false;
    }
  }
  template <class World>
  void perform(comp::server::QueueAgain, World&) {
    step_listed<fsm::change_for_reader::NackResponseDue>();
  }
  template <class World>
  void perform(comp::server::EndSuppression, World&) {
    step_listed<fsm::change_for_reader::SuppressionEnded>();
  }

 private:
  struct Entry {
    fsm::StateId state = Changes::Fly::initial;
    bool is_listed = false;
  };
  template <class P>
  struct Machines {
    RelayHost& host;

    template <class Event, class Input>
    auto step(fsm::StateId& state, const Input& input, std::uint32_t) {
      if constexpr (std::is_same_v<P, comp::server::SendingThread>) {
        return host.threads_.template step<Event>(state, input);
      } else {
        return host.timers_.template step<Event>(state, input);
      }
    }
  };
  template <class Event>
  void step(Entry& entry) {
    changes_.step<Event>(entry.state, {});
  }
  template <class Event>
  void step_listed() {
    for (Entry& entry : entries_) {
      if (entry.is_listed) step<Event>(entry);
    }
  }

  const model::SedpProfile& sedp_;
  Changes& changes_;
  Tally<fsm::SingleShot>& timers_;
  fsm::Stepper<fsm::EventThread> threads_;
  std::vector<Entry> entries_;
  std::uint32_t existing_ = 0;
  std::int64_t suppressed_until_ns_ = INT64_MAX;
  fsm::StateId response_ = Tally<fsm::SingleShot>::Fly::initial;
  fsm::StateId suppression_ = Tally<fsm::SingleShot>::Fly::initial;
  fsm::StateId expiry_ = Tally<fsm::SingleShot>::Fly::initial;
  fsm::StateId thread_ = fsm::Stepper<fsm::EventThread>::initial;
  bool is_open_ = false;
  bool some_requested_ = false;
  bool is_served_ = false;
};

}  // namespace stormproof::conform
