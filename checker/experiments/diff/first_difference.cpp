// Both runs are fingerprinted, and the first fingerprint that differs is the place. What stands
// there is described in describe_parting.cpp.
#include "checker/experiments/diff/first_difference.hpp"

#include <algorithm>
#include <optional>

#include "checker/experiments/diff/run_log.hpp"
#include "model/simulator.hpp"

namespace stormproof::diff {

namespace {

using model::Scenario;

Scenario with_profile(const Scenario& scenario, const model::DdsProfile& dds) {
  Scenario other = scenario;
  other.dds = dds;
  return other;
}

struct Followed {
  Fingerprints prints;
  bool ended = false;  ///< by itself
};

Followed follow(const Scenario& scenario, std::uint64_t most_events, std::uint64_t& events,
                const std::function<bool()>& goes_on) {
  Followed run;
  model::RunOptions options;
  options.probe = &run.prints;
  options.max_events = most_events;
  options.on_progress = [&](const model::Progress&) { return !goes_on || goes_on(); };
  const model::RunResult result = model::simulate(scenario, options);
  events += result.events;
  run.ended = result.end != model::RunEnd::interrupted;
  return run;
}

/// The first position at which the lists differ; nothing if one of them is the start of the other
/// and that is no difference (`is_cut`) or if they are equal.
std::optional<std::uint64_t> parting_of(const std::vector<std::uint64_t>& one,
                                        const std::vector<std::uint64_t>& other, bool is_cut) {
  const auto [a, b] = std::ranges::mismatch(one, other);
  const bool at_end = a == one.end() || b == other.end();
  if (at_end && (is_cut || one.size() == other.size())) return std::nullopt;
  return static_cast<std::uint64_t>(a - one.begin());
}

}  // namespace

Parting compare_runs(const Scenario& scenario, const model::DdsProfile& candidate,
                     std::uint64_t most_events, std::uint64_t& events,
                     const std::function<bool()>& goes_on) {
  const Followed one = follow(scenario, most_events, events, goes_on);
  const Followed other = follow(with_profile(scenario, candidate), most_events, events, goes_on);
  Parting parting;
  parting.followed_to_the_end = one.ended && other.ended;
  const bool is_cut = !parting.followed_to_the_end;
  if (const auto packet = parting_of(one.prints.packets, other.prints.packets, is_cut)) {
    parting.kind = Parting::Kind::packets;
    parting.position = *packet;
  } else if (const auto event = parting_of(one.prints.events, other.prints.events, is_cut)) {
    parting.kind = Parting::Kind::inside;
    parting.position = *event;
  }
  return parting;
}

}  // namespace stormproof::diff
