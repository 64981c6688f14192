// One relation of Fast DDS (specs/guide/fastdds.md) as a world for the explorer: a default
// participant's nine publications, of which the last ones may be created after the match, towards
// one reader. Rules and order are those of model/fastdds/; piggybacked HEARTBEATs are left out,
// because they depend on everything that the participant sends.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "checker/engines/explorer/frame.hpp"
#include "fsm/change_for_reader.hpp"
#include "fsm/discovery_reader.hpp"
#include "fsm/heartbeat_timer.hpp"
#include "fsm/initial_acknack.hpp"
#include "fsm/single_shot.hpp"
#include "fsm/stepper.hpp"
#include "model/scenario.hpp"

namespace stormproof::explorer {

class FastDdsWorld {
 public:
  /// Publications of a default participant.
  static constexpr unsigned descriptor_count = 9;
  static constexpr unsigned max_pushed = 2;
  static constexpr bool receives_separately = true;

  struct State {
    std::uint16_t received = 0;   ///< X
    std::uint16_t asked = 0;      ///< listed by an ACKNACK since they were last generated
    std::uint16_t generated = 0;  ///< descriptors that have been generated
    std::uint16_t queued = 0;     ///< the participant's async queue, ascending
    std::array<fsm::StateId, descriptor_count> changes{};
    std::uint8_t created = 0;    ///< H
    std::uint8_t low = 0;        ///< every descriptor below it is acknowledged
    std::uint8_t announced = 0;  ///< descriptors that the reader knows to exist
    fsm::StateId heartbeat = 0;
    std::uint8_t expiries = 0;
    fsm::StateId reader = 0;
    fsm::StateId initial = 0;
    std::uint8_t attempts = 0;
    fsm::StateId nack_response = 0;
    fsm::StateId async_run = 0;
    fsm::StateId suppression = 0;
    fsm::StateId reply = 0;
    std::uint8_t flags = 0;
    std::array<std::uint8_t, 2> unused{};  // no padding: states are compared and hashed bytewise

    static constexpr std::uint8_t heartbeat_seen = 1;
    static constexpr std::uint8_t matched = 2;
    [[nodiscard]] bool has(std::uint8_t flag) const { return (flags & flag) != 0; }
    bool operator==(const State&) const = default;
  };

  /// `scenario` is the one that runs, `specification` the one whose τ_S has to be honoured.
  FastDdsWorld(const model::Scenario& scenario, const model::Scenario& specification,
               const Scope& scope, const model::Mutation& mutation);

  State start(Frame& frame);
  void fire(State& state, Frame& frame, const Slot& slot);

  [[nodiscard]] bool complete(const State& state) const { return state.received == all; }
  [[nodiscard]] std::uint16_t received(const State& state) const { return state.received; }
  [[nodiscard]] unsigned descriptors() const { return descriptor_count; }
  [[nodiscard]] const Scope& scope() const { return scope_; }
  [[nodiscard]] const EventRules& rules() const { return rules_; }
  [[nodiscard]] std::string describe(const State& state) const;

  /// Time between the creations of two pushed descriptors.
  [[nodiscard]] static model::Nanoseconds creation_distance(const model::Scenario& scenario);

 private:
  static constexpr std::uint16_t all = (1U << descriptor_count) - 1;

  void open_reader(State& state, Frame& frame);
  void open_writer(State& state, Frame& frame);
  void create(State& state, Frame& frame, std::uint16_t set);
  void data_received(State& state, const Slot& packet, Frame& frame);
  void heartbeat_received(State& state, Frame& frame, std::uint8_t announced);
  void acknack_generation(State& state, Frame& frame);
  void emit_acknack(State& state, Frame& frame, bool initial);
  void acknack_received(State& state, Frame& frame, const Slot& packet);
  void nack_response(State& state, Frame& frame);
  void async_run(State& state, Frame& frame);
  void suppression_end(State& state, Frame& frame);
  void deliver(State& state, Frame& frame, unsigned d);
  void send_heartbeat(const State& state, Frame& frame);
  void heartbeat_expiry(State& state, Frame& frame);
  template <class Event>
  void step_heartbeat(State& state, Frame& frame);
  template <class Event>
  void step_initial(State& state, Frame& frame);
  void request(fsm::StateId& timer, Frame& frame, What what, model::Nanoseconds delay);
  bool expire(fsm::StateId& timer);
  void check_descriptors(const State& before, const State& state, Frame& frame);

  [[nodiscard]] bool needs_heartbeat(const State& state) const;
  [[nodiscard]] fsm::Stepper<fsm::DiscoveryReader>::Input reader_input(std::uint16_t missing) const;
  [[nodiscard]] static std::uint16_t missing(const State& state) {
    return static_cast<std::uint16_t>(all & ~state.received);
  }

  const model::SedpProfile sedp_;
  const std::int64_t suppression_ns_;
  const Scope scope_;
  const EventRules rules_;
  const bool live_bitmaps_;
  const model::Nanoseconds creation_distance_;
  fsm::Stepper<fsm::ChangeForReader> changes_;
  fsm::Stepper<fsm::DiscoveryReader> reader_;
  fsm::Stepper<fsm::HeartbeatTimer> timer_;
  fsm::Stepper<fsm::InitialAckNack> initial_;
  fsm::Stepper<fsm::SingleShot> shots_;
};

}  // namespace stormproof::explorer
