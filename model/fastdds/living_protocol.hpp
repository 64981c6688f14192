// Fast DDS whose participants have a life, as a host of its rules
// (fsm/composition/fastdds_life.hpp, specs/guide/museum.md).
#pragma once

#include <cstdint>
#include <optional>

#include "fsm/composition/fastdds_life.hpp"
#include "model/engine/living_host.hpp"
#include "model/fastdds/protocol.hpp"

namespace stormproof::model::fastdds {

namespace detail {
using Cancellable = fsm::TypeList<comp::Announcement, comp::AckNackGeneration, comp::InitialAttempt,
                                  rules::SuppressionEnd, rules::NackResponseDue, rules::AsyncRunDue,
                                  comp::HeartbeatExpiry, control::ControlInitialAttempt,
                                  control::ControlReplyDue, rules::Created, comp::LeaseCheck>;
}  // namespace detail

class LivingProtocol final
    : public LivingHost<Protocol, rules::FastDdsLiving, detail::Cancellable> {
 public:
  LivingProtocol(RunState& run, Network& network) : LivingHost{run, network} {}

  void start() override;
  void handle(const Event& event) override;
  [[nodiscard]] std::optional<std::uint32_t> sender_of(const Event& event) const override;
  void received(const Packet& packet, std::uint32_t receiver) override;

  // The host of a RunningWorld.
  using LivingHost::answer;
  using LivingHost::assign;
  using LivingHost::cancel;
  using LivingHost::is_due;
  using LivingHost::renew;
  using LivingHost::value;
  using Protocol::assign_each;
  using Protocol::perform;

  /// A side that closes loses its turn in the cycle of its writer.
  void assign(rules::WriterOpen open, std::uint32_t relation, bool matched);
  void renew(rules::C, std::uint32_t relation) { changes_.renew(relation, renewed); }
  void renew(rules::Reply, std::uint32_t relation) {
    renew(relations_[relation].reply, MachineRef::Kind::relation, relation);
  }
  void renew(rules::Suppression, std::uint32_t relation) {
    renew(relations_[relation].suppression, MachineRef::Kind::relation, relation);
  }
  /// Only who forgets says it of all at once.
  void assign_each(rules::Notified, std::uint32_t relation, const DescriptorSet& notified) {
    relations_[relation].notified = notified.empty() ? 0 : notified.highest() + 1;
  }
  template <class World>
  void perform(rules::HearWriter, World& w) {
    hear_from(control_.of(w.template number<comp::owner::control_relation>()).pair);
  }
  template <class World>
  void perform(rules::HearReader, World& w) {
    const std::uint32_t pair = control_.of(w.template number<comp::owner::control_relation>()).pair;
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
  void renew(fsm::StateId& shot, MachineRef::Kind kind, std::uint32_t n);
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

}  // namespace stormproof::model::fastdds
