// Cyclone DDS 0.10 as a host of its rules (fsm/composition/cyclone*.hpp, specs/guide/cyclone.md):
// it keeps what they are about, and sends what they say. What the steps do that they leave to a
// host is in thread_steps.hpp. By source file:
//   protocol.cpp       events and packets to rules, what a descriptor's arrival means
//   sender.cpp         packets, and what they count as
//   event_threads.cpp  messages and their destinations
//   packer.cpp         which messages share a packet
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/cyclone/sender.hpp"
#include "model/cyclone/thread_steps.hpp"
#include "model/engine/network.hpp"
#include "model/engine/stored.hpp"

namespace stormproof::model::cyclone {

struct Columns : Numbers {
  using Numbers::column;
  // These hold for the first samples of a writer.
  static way::Prefix column(rules::Exists);
  static way::Prefix column(rules::Sent);
  static way::Prefix column(rules::Known);
  static way::Prefix column(rules::Historic);
  static way::Bits column(rules::Notified);
  static way::Bits column(comp::X);
};

/// `Self` is the host, and `Steps` what it has of ThreadSteps.
template <class Self, class Composition_, class Columns_, class Steps>
class ProtocolOf : public Stored<Self, HostBase, ThingsOf<Composition_>, Columns_,
                                 fsm::TypeList<rules::WriterOpen>>,
                   public Steps {
 protected:
  using Stored = model::Stored<Self, HostBase, ThingsOf<Composition_>, Columns_,
                               fsm::TypeList<rules::WriterOpen>>;
  using ThreadSteps = Steps;

 public:
  using Number = std::uint32_t;
  using Composition = Composition_;
  using Packet = Submessage;  ///< rules receive submessages

  ProtocolOf(RunState& run, Network& network);

  void start() override;
  void handle(const Event& event) override;
  /// Only the event thread sends.
  [[nodiscard]] std::optional<Number> sender_of(const Event& event) const override {
    if (event.kind != EventKind::thread_run) return {};
    return event.subject;
  }
  void count(const model::Packet& packet) override { sender_.count_admitted(packet); }
  void source_completed(const model::Packet&) override {}
  [[nodiscard]] bool receives_separately() const override { return true; }
  [[nodiscard]] std::vector<Number> receivers(const model::Packet& packet) const override;
  [[nodiscard]] std::optional<Nanoseconds> receives_later(Number receiver) const override;
  void received(const model::Packet& packet, Number receiver) override;
  void renew_bitmap(model::Packet&) override {}  // its bitmaps are in submessages
  [[nodiscard]] Number next_recipient(const model::Packet&, Number pair) const override {
    return pair;  // every packet stands for itself
  }
  [[nodiscard]] std::vector<MissingDescriptor> missing(std::size_t limit) override;

  // The host of a RunningWorld.
  using Stored::answer;
  using Stored::assign_word;
  using Stored::knob;
  using Stored::word;
  using ThreadSteps::answer;
  using ThreadSteps::knob;
  using ThreadSteps::word;
  void assign_word(comp::X, Number r, Number k, std::uint64_t received) { take(r, k, received); }

  // Facts that are kept up to date.
  template <class World>
  [[nodiscard]] Number fact(rules::History, const World& w) const {
    return this->template first<rules::Exists>(w.template number<comp::owner::writer>());
  }
  template <class World>
  [[nodiscard]] Number fact(rules::FirstMissing, const World& w) const {
    return this->template first<comp::X>(w.template number<comp::owner::relation>()) + 1;
  }

  // What steps ask of it.
  template <class Trigger>
  void run(Number n, const Packet* m = nullptr, Number descriptor = 0) {
    run_rule<Trigger>(static_cast<Self&>(*this), n, m, descriptor);
  }
  void send_copy(Number i, Number to);
  [[nodiscard]] bool pauses(Number i) const {
    return this->run_.scenario.deployment.time_to_send() > Nanoseconds{0} || sender_.stalls(i);
  }

 protected:
  /// The packet that thread i sends, to a participant or to the group.
  [[nodiscard]] model::Packet packet_of(Number i, Number to) const;

  Sender sender_;

 private:
  void take(Number relation, Number word, std::uint64_t received);
};

class Protocol final : public ProtocolOf<Protocol, rules::Cyclone, Columns, ThreadSteps<Protocol>> {
 public:
  Protocol(RunState& run, Network& network) : ProtocolOf{run, network} { begin_liveliness(); }
};

extern template class ProtocolOf<Protocol, rules::Cyclone, Columns, ThreadSteps<Protocol>>;

}  // namespace stormproof::model::cyclone
