// What the tests of conformance are made of: shipped captures and profiles, captures of simulated
// runs, and the bounds within which a simulated run is exact.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "checker/evidence/capture/events.hpp"
#include "checker/evidence/conform/conform.hpp"
#include "model/scenario.hpp"
#include "model/simulator.hpp"

namespace stormproof::conform::testing {

/// The file specs/captures/NAME.pcap.xz.
[[nodiscard]] capture::Conversation shipped(const std::string& name);
/// The shipped profile of this name ("fastdds-2.6.11").
[[nodiscard]] model::DdsProfile profile(const std::string& name);
/// The shipped scenario of this name.
[[nodiscard]] model::Scenario scenario(const std::string& name);

/// A simulated run as a capture; nothing if no packet left a host.
struct Simulated {
  capture::Conversation conversation{};
  model::RunResult run{};
  bool is_empty = false;
};
[[nodiscard]] Simulated simulated(const model::Scenario& scenario,
                                  const model::RunOptions& options = {});

/// Without lag, lateness and clock error; any delay within the run.
[[nodiscard]] Bounds exact_bounds(const model::Scenario& scenario, const Simulated& run);

/// The result, which must not be an error.
[[nodiscard]] Conformance conformance(const capture::Conversation& conversation,
                                      const model::DdsProfile& dds, const Bounds& bounds = {});
/// Verdict, counts and findings, for messages of failed tests.
[[nodiscard]] std::string description(const Conformance& result);
/// Whether it conforms with every event explained and replayed.
[[nodiscard]] bool is_explained(const Conformance& result);

}  // namespace stormproof::conform::testing
