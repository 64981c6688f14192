// One relation of the paper's model as a world for the explorer: the writer's descriptors and
// HEARTBEAT timer, the reader with its bitmap X, and everything that is pending between them. It
// applies the rules of specs/guide/model.md in the order in which the simulator (model/paper/)
// does, through the same machines, so that a path of the explorer can be run by the simulator.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "checker/engines/explorer/frame.hpp"
#include "fsm/descriptor_repair.hpp"
#include "fsm/discovery_reader.hpp"
#include "fsm/heartbeat_timer.hpp"
#include "fsm/initial_acknack.hpp"
#include "fsm/stepper.hpp"
#include "model/descriptor_sizes.hpp"
#include "model/scenario.hpp"

namespace stormproof::explorer {

class PaperWorld {
 public:
  static constexpr unsigned max_descriptors = 3;
  static constexpr bool receives_separately = false;

  struct State {
    std::int64_t budget = 0;      ///< piggyback budget of the writer, bytes
    std::int64_t sent_bytes = 0;  ///< cumulative piggyback charge of the participant
    std::uint16_t received = 0;   ///< X
    std::uint16_t asked = 0;      ///< listed by an ACKNACK since they were last generated
    std::uint16_t generated = 0;  ///< descriptors that have been generated
    std::array<fsm::StateId, max_descriptors> repair{};
    fsm::StateId heartbeat = 0;
    std::uint8_t expiries = 0;  ///< scheduled HEARTBEAT expiries, as the writer counts them
    fsm::StateId reader = 0;
    fsm::StateId initial = 0;
    std::uint8_t attempts = 0;        ///< initial ACKNACKs sent
    std::uint8_t unacknowledged = 0;  ///< descriptors not in A, as the writer counts them
    std::uint8_t flags = 0;           // no padding: states are compared and hashed bytewise

    static constexpr std::uint8_t heartbeat_seen = 1;
    static constexpr std::uint8_t writer_open = 2;
    [[nodiscard]] bool has(std::uint8_t flag) const { return (flags & flag) != 0; }
    bool operator==(const State&) const = default;
  };

  /// `scenario` is the one that runs, `specification` the one whose τ_S has to be honoured;
  /// `scope.descriptors` is at most `max_descriptors`.
  PaperWorld(const model::Scenario& scenario, const model::Scenario& specification,
             const Scope& scope, const model::Mutation& mutation);

  /// The initial state; `frame` is empty.
  State start(Frame& frame);
  /// `slot` happens.
  void fire(State& state, Frame& frame, const Slot& slot);

  [[nodiscard]] bool complete(const State& state) const { return state.received == all_; }
  [[nodiscard]] std::uint16_t received(const State& state) const { return state.received; }
  [[nodiscard]] unsigned descriptors() const { return count_; }
  [[nodiscard]] const Scope& scope() const { return scope_; }
  [[nodiscard]] const EventRules& rules() const { return rules_; }
  /// The state in words.
  [[nodiscard]] std::string describe(const State& state) const;

 private:
  void open_reader(State& state, Frame& frame);
  void open_writer(State& state, Frame& frame);
  void data_received(State& state, Frame& frame, const Slot& packet);
  void heartbeat_received(State& state, Frame& frame);
  void acknack_generation(State& state, Frame& frame);
  void initial_acknack_due(State& state, Frame& frame);
  void emit_acknack(State& state, Frame& frame, bool initial);
  void acknack_received(State& state, Frame& frame, const Slot& packet);
  void repair_generation(State& state, Frame& frame);
  void source_completion(State& state, Frame& frame, const Slot& packet);
  void suppression_end(State& state, Frame& frame);
  void generate_data(State& state, Frame& frame, std::uint16_t set, bool repair);
  void charge(State& state, Slot& packet, std::int64_t& payload_bytes, std::int64_t added);
  void send_heartbeat(State& state, Frame& frame);
  void heartbeat_expiry(State& state, Frame& frame);
  template <class Event>
  void step_heartbeat(State& state, Frame& frame);
  template <class Event>
  void step_initial(State& state, Frame& frame);
  void check_descriptors(const State& before, const State& state, Frame& frame);

  [[nodiscard]] fsm::Stepper<fsm::DiscoveryReader>::Input reader_input(std::uint16_t missing) const;
  [[nodiscard]] std::uint16_t missing(const State& state) const {
    return static_cast<std::uint16_t>(all_ & ~state.received);
  }

  const model::SedpProfile sedp_;
  const std::int64_t suppression_ns_;
  const Scope scope_;
  const EventRules rules_;
  const bool live_bitmaps_;
  const bool accepts_unmatched_;
  const unsigned count_;
  const std::uint16_t all_;
  const model::DescriptorSizes sizes_;
  fsm::Stepper<fsm::DescriptorRepair> descriptors_;
  fsm::Stepper<fsm::DiscoveryReader> reader_;
  fsm::Stepper<fsm::HeartbeatTimer> timer_;
  fsm::Stepper<fsm::InitialAckNack> initial_;
};

}  // namespace stormproof::explorer
