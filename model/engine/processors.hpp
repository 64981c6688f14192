// Threads that take time (specs/guide/fleet.md, "Processors"): each participant has one, which
// handles one event after the other, and a host runs as many at the same time as it has cores. What
// a busy thread would have to do waits for it, in one line for receptions, timers and sending.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "model/engine/packet.hpp"
#include "model/engine/run_state.hpp"

namespace stormproof::model {

class Fleet;

class Processors {
 public:
  Processors(RunState& run, const Processor& processor, const Fleet& fleet);

  /// Whether the participant hears what reaches it now.
  [[nodiscard]] bool hears(std::uint32_t participant) const {
    return run_.now >= hears_from_[participant];
  }
  /// Whether the participant's thread begins with the event now; otherwise it will happen again.
  [[nodiscard]] bool begins(std::uint32_t participant, const Event& event);
  /// The event that has begun is handled: its thread is busy with it from now on.
  void finish();
  /// A thread has become free.
  void handle(const Event& event);

  /// What the event that has begun costs, part by part.
  void act() { cost_ += processor_.timer; }
  void receive(const Packet& packet) { cost_ += processor_.reception + of_submessages(packet); }
  void send(const Packet& packet, std::uint32_t copies) {
    cost_ += (processor_.emission + of_submessages(packet)) * copies;
  }

  /// How long something has waited for the thread, up to now.
  [[nodiscard]] Nanoseconds waited(std::uint32_t participant) const;

 private:
  struct Thread {
    std::deque<Event> line;
    Nanoseconds line_since;
    Nanoseconds waited;
    std::optional<std::uint64_t> granted;  ///< the event that it is to begin with
    bool has_core = false;
  };
  struct Cores {
    std::uint32_t free = 0;
    std::deque<std::uint32_t> waiting;  ///< threads that need one
  };

  [[nodiscard]] Nanoseconds of_submessages(const Packet& packet) const;
  void give(Cores& cores);

  RunState& run_;
  const Processor processor_;
  const Fleet& fleet_;
  std::vector<Thread> threads_;  // by participant
  std::vector<Cores> hosts_;
  std::vector<Nanoseconds> hears_from_;  // by participant
  std::uint32_t acting_ = 0;
  Nanoseconds cost_;
};

}  // namespace stormproof::model
