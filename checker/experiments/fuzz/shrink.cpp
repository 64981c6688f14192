// Greedy descent: the first simpler scenario that breaks the same is taken, and the search starts
// over from there. A candidate may take twice as long to break as what it simplifies.
#include "checker/experiments/fuzz/shrink.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/tree/quantities.hpp"
#include "props/generators/simpler.hpp"

namespace stormproof::fuzz {

namespace {

using model::config::NumericKnob;
using model::config::print_duration;

void add_knob_differences(const model::Scenario& scenario, const model::Scenario& base,
                          std::vector<std::string>& lines) {
  const std::vector<NumericKnob> before = model::config::numeric_knobs(base);
  for (const NumericKnob& knob : model::config::numeric_knobs(scenario)) {
    const auto old = std::ranges::find(before, knob.key, &NumericKnob::key);
    if (old == before.end() || old->value == knob.value) continue;
    lines.push_back(fmt::format("{} {} instead of {}", knob.key,
                                print_quantity(knob.unit, knob.value),
                                print_quantity(old->unit, old->value)));
  }
}

std::uint64_t endpoint_count(const model::Deployment& deployment) {
  std::uint64_t count = 0;
  for (const model::Participant& participant : deployment.participants) {
    count += std::uint64_t{participant.publications} + participant.subscriptions;
  }
  return count;
}

std::string starts_text(const model::Deployment& deployment) {
  constexpr std::size_t listed = 10;
  std::vector<std::string> starts;
  for (const model::Participant& participant : deployment.participants) {
    if (starts.size() == listed) {
      starts.emplace_back("…");
      break;
    }
    starts.push_back(print_duration(participant.start));
  }
  return fmt::format("the participants start at {}", fmt::join(starts, ", "));
}

/// What differs in the life of participants.
void add_life_differences(const model::Deployment& now, const model::Deployment& before,
                          std::vector<std::string>& lines) {
  if (now.life == before.life) return;
  if (!now.life) {
    lines.emplace_back("nobody fails");
    return;
  }
  for (const model::Outage& o : now.life->outages) {
    lines.push_back(fmt::format("{} does not hear {} from {} to {}", o.to, o.from,
                                print_duration(o.start), print_duration(o.end)));
  }
  for (const model::Restart& r : now.life->restarts) {
    lines.push_back(fmt::format("{} stops at {} and is back at {}", r.participant,
                                print_duration(r.stop), print_duration(r.start)));
  }
  for (const model::LateEndpoints& late : now.life->endpoints) {
    lines.push_back(fmt::format(
        "{} creates {} publications and {} subscriptions at {}{}", late.participant,
        late.publications, late.subscriptions, print_duration(late.at),
        late.until ? fmt::format(" and deletes them at {}", print_duration(*late.until)) : ""));
  }
}

std::string losses_text(const std::vector<std::uint64_t>& lost) {
  constexpr std::size_t listed = 10;
  if (lost.empty()) return "no packet is lost";
  const std::vector<std::uint64_t> first(
      lost.begin(), lost.begin() + static_cast<std::ptrdiff_t>(std::min(listed, lost.size())));
  return fmt::format("{} packet{} lost: {}{}", lost.size(), lost.size() == 1 ? " is" : "s are",
                     fmt::join(first, ", "), lost.size() > listed ? ", …" : "");
}

}  // namespace

Shrunk shrink(props::Counterexample found, const model::Scenario& base, std::uint64_t most_events,
              const GoesOn& goes_on) {
  Shrunk shrunk{std::move(found), 0, 0, false};
  std::uint64_t events = 0;
  bool effort_left = true;
  const auto breaks_too = [&](const model::Scenario& simpler) {
    effort_left = effort_left && events < most_events && (!goes_on || goes_on());
    if (!effort_left) return false;
    const std::uint64_t most =
        std::min(2 * shrunk.counterexample.event + 1'000, most_events - events);
    ++shrunk.tried;
    auto still = find_breach(simpler, shrunk.counterexample.property, most, events, goes_on);
    if (!still) return false;
    shrunk.counterexample = *std::move(still);
    ++shrunk.accepted;
    return true;
  };
  while (effort_left && !shrunk.finished) {
    const model::Scenario current = shrunk.counterexample.scenario;
    const bool simplified = props::first_simpler(current, base, breaks_too).has_value();
    shrunk.finished = !simplified && effort_left;
  }
  return shrunk;
}

std::vector<std::string> differences(const model::Scenario& scenario, const model::Scenario& base) {
  std::vector<std::string> lines;
  const auto& now = scenario.deployment;
  const auto& before = base.deployment;
  const auto note = [&](const char* what, auto is, auto was) {
    if (is != was) lines.push_back(fmt::format("{} {} instead of {}", is, what, was));
  };
  note("participants", now.size(), before.size());
  note("hosts", now.host_count(), before.host_count());
  note("user endpoints", endpoint_count(now), endpoint_count(before));
  note("stages", scenario.wireless.stages.size(), base.wireless.stages.size());
  const auto starts = [](const model::Deployment& deployment) {
    std::vector<model::Nanoseconds> times;
    for (const auto& participant : deployment.participants) times.push_back(participant.start);
    times.resize(std::max<std::size_t>(times.size(), 1));
    return times;
  };
  const std::vector<model::Nanoseconds> new_starts = starts(now);
  const std::vector<model::Nanoseconds> old_starts = starts(before);
  if (!std::equal(new_starts.begin(), new_starts.end(), old_starts.begin(),
                  old_starts.begin() + static_cast<std::ptrdiff_t>(
                                           std::min(new_starts.size(), old_starts.size())))) {
    lines.push_back(starts_text(now));
  }
  add_life_differences(now, before, lines);
  add_knob_differences(scenario, base, lines);
  if (scenario.wireless.lost_packets != base.wireless.lost_packets) {
    lines.push_back(losses_text(scenario.wireless.lost_packets));
  }
  return lines;
}

}  // namespace stormproof::fuzz
