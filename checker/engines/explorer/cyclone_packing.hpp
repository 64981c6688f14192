// What Cyclone DDS's rules leave to a host: the publications of participant 0 and their reader,
// participant 1, with the event threads of both. The rules
//   compare times: those are marks of the frame, and a comparison that the zone leaves open makes
//     two steps (Frame::holds);
//   move timers: each time that a timer is moved to is an event, of which the first one that comes
//     is the due one, and the others are forgotten;
//   leave messages to a thread, which does all that it has to do at once: the time that sending
//     takes is part of the delay of a packet. It fills packets with the simulator's packer, in the
//     order in which the simulator does.
// Counts of HEARTBEATs and ACKNACKs only matter in comparison with each other, and are kept as
// small as that allows.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "checker/engines/explorer/packing.hpp"
#include "checker/engines/explorer/rule_runner.hpp"
#include "model/cyclone/packer.hpp"

namespace stormproof::explorer {

class CyclonePacking final : public Packing {
 public:
  CyclonePacking(const fsm::program::Program& program, const model::Scenario& running,
                 const Scope& scope, const EventRules& rules);

  [[nodiscard]] bool has_two_ends() const override { return true; }
  [[nodiscard]] std::vector<std::string_view> occasions() const override {
    return {"PacketEnds", "AckTimerFires", "HeartbeatTimerFires", "ThreadSleeps"};
  }
  Specialised::Action action(std::string_view step) override;
  void keep(Layout& layout) override;
  void start(WorldState& state) override { state.set(sent_, state.get<Members>(exists_)); }
  [[nodiscard]] std::optional<unsigned> keeps(std::string_view thing) const override;
  [[nodiscard]] bool is_decided_by_reading(unsigned own) const override;
  std::int64_t read(unsigned own, RuleRunner& w) override;
  void set(unsigned own, std::int64_t value, RuleRunner& w) override;
  bool leaves(const Slot& packet, RuleRunner& w) override;
  bool moves(const Slot& slot, std::int64_t time, RuleRunner& w) override;
  bool happens(const Slot& slot, RuleRunner& w) override;
  [[nodiscard]] std::string describe(const WorldState& state) const override;

 private:
  /// Messages that can wait at once.
  static constexpr std::size_t most_queued = 6;
  /// Messages of the writer's participant that wait, the first one first.
  struct Queue {
    std::array<Slot, most_queued> messages{};
    std::uint64_t count = 0;

    [[nodiscard]] std::span<Slot> waiting() { return std::span{messages}.first(count); }
  };
  [[nodiscard]] Queue queue(const WorldState& state) const { return state.get<Queue>(queue_); }

  std::int64_t until(What mark, Frame& frame);
  std::int64_t last_heartbeat(RuleRunner& w);
  [[nodiscard]] std::int64_t interval(const WorldState& state) const;
  [[nodiscard]] std::int64_t due(What what, bool missed) const;
  [[nodiscard]] Kept missed(What what) const {
    return what == What::ack_time ? ack_missed_ : heartbeat_missed_;
  }
  void come(const Slot& slot, RuleRunner& w);
  void receive(const Slot& part, RuleRunner& w);
  void enqueue(const Slot& message, RuleRunner& w);
  void let_answer_go(RuleRunner& w);
  void work(RuleRunner& w);
  bool next_task(RuleRunner& w);
  void send(const model::cyclone::Bundle& bundle, RuleRunner& w);
  void settle(RuleRunner& w);
  void keep_counts_small(RuleRunner& w, What kind, Kept made, Kept last);

  const fsm::program::Program& program_;
  const EventRules& rules_;
  const std::int64_t most_heartbeats_;
  Kept queue_{};
  Kept kept_{};    ///< the answer that waits
  Kept keeps_{};   ///< if one does
  Kept listed_{};  ///< by participant: how often its timer is on the list
  Kept heartbeats_since_{};
  // The time that a timer was due at is over, and it has not come: only a mistake does that.
  Kept ack_missed_{};
  Kept heartbeat_missed_{};
  // Of the program.
  Kept sent_{};
  Kept exists_{};
  Kept received_{};
  Kept judge_{};
  Kept peer_{};
  Kept acked_{};
  std::array<std::pair<Kept, Kept>, 2> counts_{};  ///< given, and accepted: HEARTBEATs, ACKNACKs
  // Within an event.
  std::uint8_t flags_ = 0;        ///< of what a step to all emits
  std::optional<What> coming_{};  ///< the timer whose time it is
  bool works_ = false;            ///< a thread does
  std::deque<Slot> given_{};      ///< what the timer that it fires gives
};

}  // namespace stormproof::explorer
