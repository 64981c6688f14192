// Fast DDS whose participants have a life, as a host of its rules
// (fsm/composition/fastdds_life.hpp, specs/guide/museum.md).
#pragma once

#include <cstdint>
#include <optional>

#include "fsm/composition/fastdds_life.hpp"
#include "model/engine/living_host.hpp"
#include "model/fastdds/protocol.hpp"

namespace stormproof::model::fastdds {

/// The endpoints of a participant are created.
struct Creations : comp::Timer<comp::owner::participant> {};

namespace detail {
/// Beside timers that can be cancelled, which ACKNACK a writer has heard last.
using OfLives = fsm::TypeList<rules::AckNackHeard, comp::Announcement, comp::AckNackGeneration,
                              comp::InitialAttempt, rules::SuppressionEnd, rules::NackResponseDue,
                              rules::AsyncRunDue, control::ControlInitialAttempt,
                              control::ControlReplyDue, Creations>;
}  // namespace detail

class LivingProtocol : public LivingHost<Protocol, rules::FastDdsLiving, detail::OfLives> {
 public:
  LivingProtocol(RunState& run, Network& network) : LivingHost{run, network} {}

  void start() override;
  void handle(const Event& event) override;
  [[nodiscard]] std::optional<std::uint32_t> sender_of(const Event& event) const override;
  void received(const Packet& packet, std::uint32_t receiver) override;

  // The host of a RunningWorld.
  using LivingHost::renew;
  using Protocol::perform;

  /// A side that closes loses its turn in the cycle of its writer.
  using LivingHost::assign;
  void assign(rules::WriterOpen open, std::uint32_t relation, bool matched);
  void renew(rules::C, std::uint32_t relation) { changes().renew(relation, renewed); }
  template <class P>
  void renew(P part, std::uint32_t n);
  using LivingHost::answer;
  template <class World>
  [[nodiscard]] std::int64_t answer(rules::AckNackNumber, const World& w) const {
    return w.packet().number_of_acknack();
  }
  template <class World>
  void perform(rules::HearWriter, World& w) {
    hear_from(control_.pair_of(w.template number<comp::owner::control_relation>()));
  }
  template <class World>
  void perform(rules::HearReader, World& w) {
    const std::uint32_t pair = control_.pair_of(w.template number<comp::owner::control_relation>());
    hear_from(topology().pair(pair).reverse);
  }
  template <class World>
  void perform(rules::ForgetTopics, World& w) {
    forget_topics(w.template number<comp::owner::pair>());
  }
  template <class World>
  void perform(rules::Life::LoseAll, World& w) {
    lose_all(w.template number<comp::owner::participant>());
  }

 private:
  void take_descriptors(std::uint32_t relation, const DescriptorSet& received) override;
  void hear_from(std::uint32_t pair);
  void forget_topics(std::uint32_t pair);
  /// Before the run all endpoints of i exist, its writers believe that j has everything, and i has
  /// everything of j.
  void open_before(std::uint32_t i, std::uint32_t j);
  void open_topics_before(std::uint32_t there, std::uint32_t back);
  [[nodiscard]] bool was_there_before(std::uint32_t i) const;
  /// The participant is a new one.
  void lose_all(std::uint32_t participant);
};

template <class P>
void LivingProtocol::renew(P part, std::uint32_t n) {
  const fsm::StateId before = std::exchange(state(part, n), fsm::Stepper<fsm::SingleShot>::initial);
  if (before == state(part, n)) return;
  note_renewed<typename P::Machine>(Columns::kind(P::owner), n, before, state(part, n));
}

}  // namespace stormproof::model::fastdds
