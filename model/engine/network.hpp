// The wireless service: backlog, source queue, fragments, the stages of the route and their
// channels (paper, "Shared Wireless Service"; specs/guide/model.md, "Packets, fragments, queue,
// channel"; of units of frames, and of senders that wait, specs/guide/wifi.md). It knows packets,
// not what they mean: their source completion and reception go to the DDS implementation.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "fsm/channel.hpp"
#include "model/airtime.hpp"
#include "model/engine/driver.hpp"
#include "model/engine/fleet.hpp"
#include "model/engine/implementation.hpp"
#include "model/engine/link_losses.hpp"
#include "model/engine/processors.hpp"
#include "model/engine/run_state.hpp"
#include "model/engine/slot_pool.hpp"
#include "model/engine/source_queue.hpp"
#include "model/engine/unit_channel.hpp"
#include "model/engine/waiting_fragments.hpp"

namespace stormproof::model {

class Network {
 public:
  explicit Network(RunState& run);

  /// The implementation that hears of source completions and receptions; set once, before the run.
  void attach(Implementation& implementation) { implementation_ = &implementation; }

  /// Emits the packet (or its copies, in ascending order of the destination) and admits what fits.
  void emit(std::uint32_t source, Packet&& packet);

  /// Delivers the packet to a participant on the same host after the loopback delay: it never sees
  /// the channel.
  void loop_back(Packet&& packet, std::uint32_t receiver);
  /// The same for a packet without lists.
  void loop_back(const PacketNumbers& packet, std::uint32_t receiver);

  /// A service, reception, source completion or dispatch event is due.
  void handle(const Event& event);

  /// What follows from frames that queues dropped in this event, at its end.
  void settle_drops() {
    for (std::uint32_t channel = 0; drops_frames_ && channel < units_.size(); ++channel) {
      while (const auto dropped = units_[channel].next_dropped()) settle(channel, *dropped);
    }
  }

  /// Whether what the participant is about to do has to wait, because packets of its own wait for
  /// room in its source queue (`sender: stalls`).
  [[nodiscard]] bool stalls(std::uint32_t participant) const {
    return sender_stalls_ && sources_[participant].backlog_packets() > 0;
  }
  /// Keeps the event until the participant does not stall any more. It happens then, after those
  /// that were held before it.
  void hold(std::uint32_t participant, const Event& event) { held_[participant].push_back(event); }
  [[nodiscard]] bool sender_stalls() const { return sender_stalls_; }
  /// Whether the packets of a record ask for the channel together, and nobody hears of each: then a
  /// record is the same as its packets, emitted one after the other.
  [[nodiscard]] bool takes_records() const {
    return admits_together_ && !run_.hears_single_packets;
  }
  /// The threads of the participants, if they take time; otherwise null.
  [[nodiscard]] Processors* processors() const { return processors_.get(); }

  [[nodiscard]] Depths depths() const;
  /// Fills the parts of the result that concern channels, backlogs and latencies.
  void report(RunResult& result) const;

 private:
  /// A packet that has left the backlog. Thousands of them wait for their next stage: what each
  /// stage asks of them comes first.
  struct InFlight {
    std::uint32_t source = 0;
    std::uint32_t fragments = 0;
    std::uint32_t at_source = 0;  // of these, not yet on their way from it
    std::uint32_t uses = 1;       // events that still need it; the slot is free at 0
    bool lost_on_the_way_up = false;
    std::int64_t demand = 0;
    Nanoseconds admitted;
    Packet packet;
    std::vector<std::uint32_t> lost_at;  // hosts that a frame did not reach
  };
  struct StageState {
    std::uint32_t channel = 0;
    std::uint32_t position = 0;          // among the stages of its channel
    std::array<MemoizedRate, 2> rate{};  // for unicast and multicast packets
  };
  struct ChannelState {
    fsm::StateId state = fsm::Flyweight<fsm::Channel>::initial;
    bool dispatch_pending = false;
    std::string name;
    WaitingFragments waiting;
    std::vector<std::uint32_t> stages;  // by position
    std::uint32_t serving_stage = 0;
    bool serves = false;
    ServiceRequest serving{};  // if it serves
    Unit unit;                 // the same with `service: unit`
    bool loses = false;        // what it serves, all of it or at the hosts below
    std::vector<std::uint32_t> loses_at;
    Nanoseconds serving_since;
    std::array<Nanoseconds, traffic_class_count> busy{};
  };

  void build_route();
  void admit(std::uint32_t source);
  [[nodiscard]] std::uint32_t take(std::uint32_t source, Nanoseconds admitted);
  [[nodiscard]] std::uint32_t allocate(std::uint32_t source);
  [[nodiscard]] auto next_recipient() const {
    return [this](const Packet& packet, std::uint32_t pair) {
      return implementation_->next_recipient(packet, pair);
    };
  }
  void release(std::uint32_t slot) {
    if (--flights_[slot].uses == 0) flights_.give_back(slot);
  }

  // network_of_units.cpp
  [[nodiscard]] Flow flow_of(const InFlight& flight) const;
  void serve_unit(std::uint32_t channel);
  void unit_finished(std::uint32_t channel);
  void settle(std::uint32_t channel, const DroppedFrame& dropped);
  void add_use(const ChannelState& c, std::array<Nanoseconds, traffic_class_count>& busy,
               Nanoseconds until) const;
  void transmit(Unit& unit, std::vector<std::uint32_t>& loses_at);
  void wake(std::uint32_t participant);

  // network_of_fleet.cpp
  void leave_wired_host(std::uint32_t slot);
  void leave_cable(std::uint32_t slot);
  void request_up(std::uint32_t slot, std::uint32_t fragment);
  void request_down(std::uint32_t slot, std::uint32_t fragment, std::uint32_t access_point);
  void distribute(std::uint32_t slot, std::uint32_t fragment);
  void request_stage(std::uint32_t slot, std::uint32_t fragment, std::uint32_t stage,
                     std::uint32_t access_point);
  void unit_requested(std::uint32_t channel);
  void beacon(std::uint32_t access_point);
  void finish_up(std::uint32_t slot, std::uint32_t fragment, bool lost);
  void finish_down(std::uint32_t slot, std::uint32_t fragment, std::uint32_t access_point);
  void frame_finished(std::uint32_t channel);
  void arrive_at(std::uint32_t slot, std::uint32_t access_point);
  void arrive_on_cable(std::uint32_t slot);
  [[nodiscard]] std::optional<std::uint32_t> destination_of(const Packet& packet) const;
  void lose_at_all(InFlight& flight, std::uint32_t access_point);
  void lose_multicast(std::uint32_t slot, std::uint32_t access_point,
                      std::vector<std::uint32_t>& loses_at);
  [[nodiscard]] std::int64_t transmit(ChannelState& c, std::int64_t airtime_ns);
  [[nodiscard]] ServiceRate rate_of(const ServiceRequest& request, std::uint32_t stage) const;

  /// In place of a slot: the packet that `source` sends when the fragment is served.
  static constexpr std::uint32_t on_tape = UINT32_MAX;
  void request(std::uint32_t slot, std::uint32_t fragment, std::uint32_t stage,
               std::uint32_t source = 0, std::uint32_t packets = 1);
  template <class Event>
  void step(std::uint32_t channel);
  void serve(std::uint32_t channel);
  void service_finished(std::uint32_t channel);
  void loop_back_flight(std::uint32_t slot, std::uint32_t receiver);
  void leave_source(std::uint32_t slot);
  void arrive(std::uint32_t slot);
  void schedule_receptions(std::uint32_t slot, Nanoseconds time);
  void emit_with_delay(std::uint32_t source, Packet&& packet);
  void renew_bitmap(InFlight& flight);
  /// How long the packet with this number takes, with a constant delay.
  [[nodiscard]] PacketDelay delay_of(std::uint64_t number) const;
  [[nodiscard]] bool is_lost(std::uint64_t number) const;
  void note_latency(const InFlight& flight, Nanoseconds received);
  /// To the protocol, noting whether a repair brings anything.
  void hand_over(const Packet& packet, std::uint32_t receiver);
  void note_stall(std::uint32_t participant);
  void note_journey(const InFlight& flight);

  RunState& run_;
  Implementation* implementation_ = nullptr;
  const WirelessProfile& wireless_;
  Fragmentation fragmentation_;
  Driver<fsm::Channel> channel_driver_{run_, MachineRef::Kind::channel};
  std::vector<StageState> stages_;
  std::vector<ChannelState> channels_;
  std::vector<SourceQueue> sources_;
  SlotPool<InFlight> flights_;
  const Fleet fleet_;
  const bool by_unit_;
  const bool over_access_points_;   // each frame goes up to one and down from it, or from several
  const bool some_listen_early_;    // before they are ready
  std::vector<UnitChannel> units_;  // of `service: unit`, by channel
  const bool drops_frames_;
  DroppedFrames dropped_;
  std::optional<LinkLosses> losses_;
  std::unique_ptr<Processors> processors_;
  struct Held {
    std::uint32_t slot = 0;
    std::uint32_t fragment = 0;
  };
  std::map<std::pair<std::uint32_t, Nanoseconds>, std::vector<Held>> held_frames_;
  const bool sender_stalls_;
  const bool counts_at_admission_;
  const bool takes_at_admission_;         // packets, not when the channel serves them first
  const bool admits_together_;            // packets of a record that fit
  std::vector<std::uint32_t> leaving_;    // by participant: what it sends, if it takes packets then
  std::vector<std::vector<Event>> held_;  // by participant, if senders stall
  struct Stall {
    Nanoseconds since;
    Nanoseconds sum;
    bool stalls = false;
  };
  std::vector<Stall> stalled_;               // the same
  std::vector<std::uint32_t> destinations_;  // of what is emitted, if somebody hears of it
  std::uint64_t backlog_packets_ = 0;        // of all sources
  std::int64_t admitted_bytes_ = 0;          // the same
  std::uint64_t next_packet_ = 0;
  std::uint64_t next_request_ = 0;
  std::array<Latency, traffic_class_count> latency_{};
  std::uint64_t repairs_received_ = 0;
  std::uint64_t useful_repairs_ = 0;
  std::optional<LastDelivery> last_arrival_;  // of the packet being received
};

}  // namespace stormproof::model
