// Reads and simulates what the tests of conformance look at.
#include "tests/checker/evidence/conform/captures.hpp"

#include <array>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "checker/evidence/capture/write/simulated_capture.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::conform::testing {

namespace {

const model::config::SpecPath& specs() {
  static const model::config::SpecPath path{{STORMPROOF_SPECS_DIR}};
  return path;
}

template <class T>
T expected(model::config::Result<T> result) {
  if (!result) ADD_FAILURE() << to_string(result.error());
  return result ? std::move(*result) : T{};
}

}  // namespace

capture::Conversation shipped(const std::string& name) {
  const std::array<std::string, 1> files{STORMPROOF_SPECS_DIR "/captures/" + name + ".pcap.xz"};
  return expected(capture::read_conversation(files));
}

model::DdsProfile profile(const std::string& name) {
  return expected(model::config::read_dds_profile(name, {}, specs()));
}

model::Scenario scenario(const std::string& name) {
  return expected(model::config::read_scenario(name, {}, specs()));
}

Simulated simulated(const model::Scenario& scenario, const model::RunOptions& options) {
  capture::SimulatedCapture capture = capture::simulated_capture(scenario, options);
  Simulated result;
  result.run = std::move(capture.run);
  result.is_empty = result.run.counts.total() == 0;
  if (result.is_empty) return result;
  constexpr std::size_t limit = std::size_t{1} << 30U;
  const std::array<capture::MemoryCapture, 1> files{
      capture::MemoryCapture{"simulated.pcap", capture.pcap, limit}};
  result.conversation = expected(capture::read_conversation(files));
  return result;
}

Bounds exact_bounds(const model::Scenario& scenario, const Simulated& run) {
  Bounds bounds;
  bounds.least_delay_ns = 0;
  bounds.most_delay_ns = run.run.end_time.count();
  bounds.most_send_lag_ns = 0;
  bounds.most_lateness_ns = 0;
  bounds.most_clock_age_ns = 0;
  bounds.most_same_host_ns = run.run.end_time.count();
  bounds.may_lose = !scenario.wireless.lost_packets.empty();
  return bounds;
}

Conformance conformance(const capture::Conversation& conversation, const model::DdsProfile& dds,
                        const Bounds& bounds) {
  return expected(
      conform({.conversation = conversation, .until_ns = INT64_MAX, .dds = dds, .bounds = bounds}));
}

std::string description(const Conformance& result) {
  std::string text = fmt::format("{} {}: {} of {} explained, {} not replayed, {} lost",
                                 name_of(result.verdict), result.why_inconclusive, result.explained,
                                 result.checked, result.not_replayed, result.lost);
  for (const Unexplained& one : result.unexplained) {
    text += fmt::format("\n  {} at {}, {}→{} {:x}: {} [{}]", name_of(one.fault), one.event,
                        one.place.source,
                        one.place.destination ? static_cast<int>(*one.place.destination) : -1,
                        one.place.writer, one.what, one.nearest);
    for (const Need& need : one.needs) {
      text += fmt::format("\n    needs {} {} (bound {})", need.what, need.needed_ns.value_or(-1),
                          need.bound_ns.value_or(-1));
    }
  }
  return text;
}

bool is_explained(const Conformance& result) {
  return result.verdict == Verdict::conforms && result.explained == result.checked &&
         result.not_replayed == 0 && result.unexplained.empty();
}

}  // namespace stormproof::conform::testing
