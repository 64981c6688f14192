// law.control: the relations of which only HEARTBEATs and ACKNACKs are modelled. A writer side
// sends a HEARTBEAT when it opens and when an initial ACKNACK calls for it, and no other but about
// what it says of types; a reader side answers what comes within one response delay once, and until
// it has seen a HEARTBEAT asks by itself after τ_I, and then after twice as long each time (or as
// long).
#include <algorithm>
#include <map>

#include <fmt/core.h>

#include "props/laws/families.hpp"
#include "props/laws/watching.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::props {

namespace {

using model::Nanoseconds;
using model::PacketKind;
using Number = std::uint32_t;

/// heartbeatResponseDelay of user topics; of what is built in it is a knob.
constexpr Nanoseconds topic_response_delay{5'000'000};

class ControlWatch : public Observer {
 public:
  explicit ControlWatch(const model::Scenario& scenario)
      : Observer{"law.control"},
        builtin_delay_{scenario.dds.version.builtin_response_delay},
        first_{scenario.dds.sedp.initial_acknack_delay},
        doubles_{scenario.dds.sedp.initial_acknack_interval ==
                 model::InitialAckNackInterval::doubling} {}

  void event_finished(const model::Depths&) override {
    for (auto& [number, side] : relations_) {
      if (side.heartbeats_due != 0) {
        object_now(fmt::format("At {} {} HEARTBEATs of control-only relation {} are {}.",
                               time_text(now()), std::abs(side.heartbeats_due), number,
                               side.heartbeats_due > 0 ? "missing" : "too many"));
      }
      side.heartbeats_due = 0;
      judge(number, side, now());
    }
  }
  void finish(Nanoseconds end) override {
    for (const auto& [number, side] : relations_) judge(number, side, end);
  }
  void transition(const model::Transition& fired) override {
    if (fired.event != "Opened") return;
    Relation& side = relations_[fired.machine.subject];
    if (fired.machine.machine == "ControlWriter") {
      side.writer_open = true;
      ++side.heartbeats_due;
    } else if (fired.machine.machine == "ControlReader") {
      side.reader_open = true;
      side.wait = first_;
      if (first_ > Nanoseconds{0}) side.attempt = now() + first_;
    }
  }
  void received(const model::Packet& packet, Number) override {
    const bool rides = packet.kind == PacketKind::lookup && packet.heartbeats > 0;
    if (packet.kind == PacketKind::user_heartbeat || rides) {
      Relation& side = relations_[packet.detail];
      if (!side.reader_open) return;
      judge(packet.detail, side, now());
      side.attempt.reset();
      if (!side.asked) side.asked = now();
    } else if (packet.kind == PacketKind::user_acknack && packet.initial_acknack) {
      Relation& side = relations_[packet.detail];
      if (side.writer_open) ++side.heartbeats_due;
    }
  }
  void emitted(const model::Packet& packet, Number, std::span<const Number>) override {
    note(packet);
  }
  void looped_back(const model::Packet& packet, Number) override { note(packet); }

 private:
  struct Relation {
    bool writer_open = false;
    bool reader_open = false;
    int heartbeats_due = 0;              ///< in this event
    std::optional<Nanoseconds> asked;    ///< when the HEARTBEAT came that is not answered yet
    std::optional<Nanoseconds> attempt;  ///< when the reader asks by itself
    Nanoseconds wait;                    ///< before that
  };

  void judge(Number number, const Relation& side, Nanoseconds time) {
    const Nanoseconds longest = std::max(builtin_delay_, topic_response_delay);
    if (side.asked && *side.asked + longest < time) {
      object_now(fmt::format("The HEARTBEAT of {} in control-only relation {} is not answered.",
                             time_text(*side.asked), number));
    }
    if (side.attempt && *side.attempt < time) {
      object_now(fmt::format("In control-only relation {} nobody asks at {}.", number,
                             time_text(*side.attempt)));
    }
  }
  void note(const model::Packet& packet) {
    const bool is_of_samples =  // they say more, which is for law.lookups to judge
        kind() == model::EventKind::lookup_expiry || kind() == model::EventKind::async_run;
    if (packet.kind == PacketKind::user_heartbeat && !is_of_samples) {
      --relations_[packet.detail].heartbeats_due;
    }
    if (packet.kind != PacketKind::user_acknack) return;
    Relation& side = relations_[packet.detail];
    const std::optional<Nanoseconds>& asked = side.asked;
    const bool due = packet.initial_acknack ? side.attempt == now()
                                            : asked && (*asked + builtin_delay_ == now() ||
                                                        *asked + topic_response_delay == now());
    if (!due) {
      object_now(fmt::format("At {} an ACKNACK of control-only relation {} is sent, not due.",
                             time_text(now()), packet.detail));
    }
    if (packet.initial_acknack) {
      side.wait = side.wait * (doubles_ ? 2 : 1);
      side.attempt = now() + side.wait;
    } else {
      side.asked.reset();
    }
  }

  const Nanoseconds builtin_delay_;
  const Nanoseconds first_;
  const bool doubles_;
  std::map<Number, Relation> relations_;
};

constexpr Law control_list[] = {watched_law<ControlWatch>(
    "law.control",
    "In control-only relations a HEARTBEAT is sent at the opening and for an initial ACKNACK, and "
    "answered once after the response delay; until it comes its reader asks ever more rarely.",
    is_stateful)};

}  // namespace

std::span<const Law> control_laws() { return control_list; }

}  // namespace stormproof::props
