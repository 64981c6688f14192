// Counterexamples for the tests: runs of the smallest deployment that really break a property, and
// a monitor that objects to something that every run with repairs does.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "model/scenario.hpp"
#include "props/monitor.hpp"
#include "props/verdict.hpp"

namespace stormproof::counterexample {

/// Objects to the first repair DATA, under the id of a property of the catalogue.
class FirstRepair final : public props::Monitor {
 public:
  [[nodiscard]] std::string_view property() const override { return "storm.free-threshold"; }
  void event_started(const model::Event& event) override;
  void emitted(const model::Packet& packet, std::uint32_t source,
               std::span<const std::uint32_t> destinations) override;

 private:
  std::uint64_t events_ = 0;
  model::Nanoseconds now_;
};

/// A shipped scenario, with overrides.
[[nodiscard]] model::Scenario scenario_named(const std::string& name,
                                             const std::vector<std::string>& overrides = {});

/// What the catalogue's monitor of the property objects to; the scenario must break it.
[[nodiscard]] props::Counterexample counterexample_of(const std::string& property,
                                                      const model::Scenario& scenario);

/// Two participants, one useless repair: `storm.free-threshold` breaks at event 101.
[[nodiscard]] props::Counterexample smallest();
/// Four participants whose additive timers break `timer.single-heartbeat`.
[[nodiscard]] props::Counterexample additive();
/// Constant delay, a lost packet, and a repair that the monitor above objects to.
[[nodiscard]] props::Counterexample lossy();
/// A DATA packet that takes 30 ms while all others take 30 µs: `storm.single-copy` breaks.
[[nodiscard]] props::Counterexample delayed();
/// Fast DDS, on one host: `timer.suppression-honoured` breaks without the network.
[[nodiscard]] props::Counterexample fastdds();
/// Six participants: thousands of events lead to the second copy of a descriptor.
[[nodiscard]] props::Counterexample storm();

/// The names of all of these, for parametrised tests.
inline constexpr std::array example_names{"smallest", "additive", "lossy",
                                          "fastdds",  "storm",    "delayed"};
struct Example {
  std::string name;
  props::Counterexample counterexample;
};
/// The same order.
[[nodiscard]] const std::vector<Example>& examples();

}  // namespace stormproof::counterexample
