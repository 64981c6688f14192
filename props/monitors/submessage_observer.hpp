// What monitors of Cyclone DDS hear of its packets: each submessage once when its packet is sent,
// however many copies of it are, and each one that a machine takes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "props/monitors/observer.hpp"
#include "props/monitors/received_submessages.hpp"

namespace stormproof::props {

class SubmessageObserver : public Observer {
 public:
  using Observer::Observer;

  void run_started(const model::Topology& topology) override {
    Observer::run_started(topology);
    received_.reset(topology);
    last_.assign(topology.participant_count(), nullptr);
  }
  void received(const model::Packet& packet, std::uint32_t) override { received_.arriving(packet); }
  void transition(const model::Transition& fired) override {
    if (fired.machine.machine == "MatchedReader" && fired.event == "Opened")
      matched(fired.machine.subject);
    if (fired.machine.machine == "CautiousReader" && fired.event == "TimerFired")
      timer_fired(fired.machine.subject);
    const model::Submessage* taken = received_.heard(fired.machine, fired.event);
    if (taken != nullptr) heard(fired.machine.subject, *taken, {fired.before, fired.after});
  }
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t>) override {
    note(packet, source);
  }
  void looped_back(const model::Packet& packet, std::uint32_t) override {
    note(packet, packet.to_group ? packet.pair : topology().pair(packet.pair).source);
  }

 protected:
  /// A writer has a reader more.
  virtual void matched(std::uint32_t /*relation*/) {}
  /// The ACK timer of a reader is about to do what it is for.
  virtual void timer_fired(std::uint32_t /*relation*/) {}
  /// The states of the machine that takes a submessage.
  struct States {
    std::string_view before;
    std::string_view after;
  };
  /// A machine of the relation takes DATA, a HEARTBEAT or an ACKNACK.
  virtual void heard(std::uint32_t relation, const model::Submessage&, const States&) = 0;
  virtual void sent(const model::Packet& /*packet*/, const model::Submessage&) {}

  [[nodiscard]] const ReceivedSubmessages& numbers() const { return received_; }
  /// The relation of what a writer sends to one participant.
  [[nodiscard]] std::uint32_t relation_of(const model::Packet& packet,
                                          const model::Submessage& submessage) const {
    return received_.stride() * packet.pair + submessage.writer;
  }
  /// The relation of what a reader sends to the writer's participant.
  [[nodiscard]] std::uint32_t relation_answered(const model::Packet& packet,
                                                const model::Submessage& submessage) const {
    return received_.stride() * topology().pair(packet.pair).reverse + submessage.writer;
  }

 private:
  void note(const model::Packet& packet, std::uint32_t source) {
    if (packet.submessages == nullptr || last_[source] == packet.submessages) return;
    last_[source] = packet.submessages;
    for (const model::Submessage& each : *packet.submessages) sent(packet, each);
  }

  ReceivedSubmessages received_;
  std::vector<std::shared_ptr<const std::vector<model::Submessage>>> last_;  // by source
};

}  // namespace stormproof::props
