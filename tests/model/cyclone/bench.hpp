// One participant of `implementation: cyclone` on a bench: a test hands it submessages, one event
// after the other happens, and what it sends is kept in plain lists and arrives nowhere. So a test
// can reach what a run reaches hardly ever.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/cyclone/protocol.hpp"
#include "model/engine/network.hpp"
#include "model/engine/run_state.hpp"

namespace stormproof::model::cyclone {

inline constexpr std::int64_t ms = 1'000'000;

/// A packet that was sent: to whom, and its submessages in words ("DATA 3", "HEARTBEAT 9 to 1").
struct Sent {
  std::int64_t time_ns = 0;
  std::uint32_t to = 0;  ///< `group`: the group
  std::int64_t bytes = 0;
  std::vector<std::string> messages;

  bool operator==(const Sent&) const = default;
};

class Bench : public Probe {
 public:
  /// Participant 0 on a host of its own, `peers` others on another; all start at 0, and create
  /// their endpoints one after the other, one every `step_ns`.
  explicit Bench(std::uint32_t peers, std::int64_t step_ns = 0, std::uint32_t publications = 0);
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  Scenario& scenario() { return scenario_; }
  /// Builds the run; the scenario stays as it is from here on.
  void start();
  /// Everything up to this time happens.
  void run_to(std::int64_t time_ns);
  /// Only the next event.
  void step();
  /// A packet from `sender` reaches `receiver` now.
  void receive(std::uint32_t sender, std::uint32_t receiver, std::vector<Submessage> contents);
  /// i and j hear of each other.
  void introduce(std::uint32_t i, std::uint32_t j);

  /// What `source` has sent since the last call, about publications and subscriptions only, or all.
  [[nodiscard]] std::vector<Sent> sent_by(std::uint32_t source, bool all = false);

  void emitted(const Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override;

 private:
  Scenario scenario_;
  std::unique_ptr<RunState> run_;
  std::unique_ptr<Network> network_;
  std::unique_ptr<Protocol> protocol_;
  std::vector<std::pair<std::uint32_t, Sent>> sent_;
  std::vector<std::pair<std::uint32_t, Sent>> sent_of_streams_;
};

[[nodiscard]] Submessage announcement_of(std::uint32_t participant);
[[nodiscard]] Submessage heartbeat_of(std::uint32_t participant, std::uint32_t writer,
                                      std::uint32_t announced, std::int64_t count,
                                      bool directed = false);
[[nodiscard]] Submessage data_of(std::uint32_t participant, std::uint32_t writer,
                                 std::uint32_t sample);
/// `missing` are samples from 1, ascending; the first of them is the base.
[[nodiscard]] Submessage request_for(std::uint32_t participant, std::uint32_t writer,
                                     std::vector<std::uint32_t> missing, std::int64_t count);

}  // namespace stormproof::model::cyclone
