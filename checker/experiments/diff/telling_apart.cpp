// Search from small to large, then greedy shrinking: whatever tells the profiles apart is replaced
// by something simpler that still does. Scenarios whose packets differ are preferred; a difference
// that no packet shows is taken only if none was found.
#include "checker/experiments/diff/telling_apart.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "checker/experiments/diff/first_difference.hpp"
#include "checker/experiments/diff/normal_form.hpp"
#include "checker/experiments/diff/small_scenarios.hpp"
#include "checker/presentation/text/numbers.hpp"
#include "checker/presentation/text/plain_text.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/knobs/value_types.hpp"
#include "model/implementations.hpp"
#include "props/generators/simpler.hpp"

namespace stormproof::diff {

namespace {

using model::DdsProfile;
using model::Nanoseconds;
using model::Scenario;

constexpr std::uint64_t events_of_small_run = 20'000;
constexpr const char* property_id = "diff.first-difference";

/// Three periods of everything that a profile schedules, and a little more.
Nanoseconds span_of(const DdsProfile& dds) {
  const auto& sedp = dds.sedp;
  const bool adaptive = sedp.heartbeat_policy == model::HeartbeatPolicy::adaptive;
  const std::int64_t longest =
      std::max({dds.spdp.period, sedp.heartbeat_period, sedp.heartbeat_response_delay,
                sedp.nack_response_delay, sedp.nack_suppression_duration,
                sedp.initial_acknack_delay, adaptive ? sedp.adaptive.max_period : Nanoseconds{0}})
          .count();
  const std::int64_t most = model::config::max_duration_ns;
  const std::int64_t startups = std::int64_t{dds.spdp.startup_announcements} + 1;
  const std::int64_t startup =
      std::min(dds.spdp.startup_period.count(), most / startups) * startups;
  constexpr std::int64_t more = 1'000'000'000;
  return Nanoseconds{std::min({3 * longest + startup + more, most / 2})};
}

SmallScenarios parts_of(const Scenario& start, const DdsProfile& base,
                        const DdsProfile& candidate) {
  SmallScenarios parts;
  parts.base = base;
  parts.suppression =
      std::max(base.sedp.nack_suppression_duration, candidate.sedp.nack_suppression_duration);
  parts.horizon = std::max(span_of(base), span_of(candidate));
  if (start.wireless.kind == model::ServiceKind::shared_channel) {
    parts.shared = start.wireless;
    parts.shared.lost_packets.clear();
  }
  parts.implementation =
      (model::traits_of(base).creates_endpoints_over_time ? base : candidate).implementation;
  return parts;
}

class Search {
 public:
  Search(const DdsProfile& base, const DdsProfile& candidate, const std::function<bool()>& goes_on)
      : base_{base}, candidate_{candidate}, goes_on_{goes_on} {}

  TellingApart run(const Scenario& start) {
    const SmallScenarios parts = parts_of(start, base_, candidate_);
    const auto look = [this](const Scenario& scenario) {
      return try_one(scenario) || !has_effort();
    };
    static_cast<void>(visit_small_scenarios(parts, 2, look) ||
                      visit_random_scenarios(parts, Crowd::pair, look) ||
                      visit_small_scenarios(parts, 3, look) || look_at(start) ||
                      visit_random_scenarios(parts, Crowd::group, look));
    if (!found_ && !inside_) return nothing_found();
    if (!found_) found_ = inside_;
    shrink(plainest_scenario(parts));
    return answer();
  }

 private:
  struct Found {
    Scenario scenario;
    Parting parting;
  };

  [[nodiscard]] bool has_effort() {
    if (events_ < telling_apart_events && (!goes_on_ || goes_on_())) return true;
    spent_ = true;
    return false;
  }

  /// Whether the packets of the scenario differ; then it is what was looked for.
  bool try_one(const Scenario& scenario) {
    std::optional<Found> found = parts_company(scenario, events_of_small_run);
    if (!found) return false;
    if (found->parting.kind == Parting::Kind::packets) {
      found_ = std::move(found);
      return true;
    }
    if (!inside_) inside_ = std::move(found);
    return false;
  }

  bool look_at(Scenario start) {
    start.dds = base_;
    start.limits.reset();
    start.vary.reset();
    const std::uint64_t half = (telling_apart_events - std::min(telling_apart_events, events_)) / 4;
    std::optional<Found> found = parts_company(start, half);
    if (found && found->parting.kind == Parting::Kind::packets) found_ = std::move(found);
    return found_.has_value();
  }

  std::optional<Found> parts_company(const Scenario& scenario, std::uint64_t most_events) {
    // A deployment may have nothing to discover under one of the profiles.
    Scenario changed = scenario;
    changed.dds = candidate_;
    if (!model::config::is_valid(scenario) || !model::config::is_valid(changed))
      return std::nullopt;
    ++tried_;
    const Parting parting = compare_runs(scenario, candidate_, most_events, events_, goes_on_);
    if (parting.kind == Parting::Kind::none) return std::nullopt;
    return Found{scenario, parting};
  }

  void shrink(const Scenario& plainest) {
    const bool packets = found_->parting.kind == Parting::Kind::packets;
    const auto still_apart = [&](const Scenario& simpler) {
      if (simpler.dds != base_ || !has_effort()) return false;
      std::optional<Found> found = parts_company(simpler, events_of_small_run);
      if (!found || (found->parting.kind == Parting::Kind::packets) != packets) return false;
      found_ = std::move(found);
      return true;
    };
    while (!spent_ && !finished_) {
      const Scenario current = found_->scenario;
      const bool simplified = props::first_simpler(current, plainest, still_apart).has_value();
      finished_ = !simplified && !spent_;
    }
  }

  /// If one of the runs ends too early to show what it does instead, both go on beyond completion.
  FirstDifference describe() {
    const FirstDifference plain = describe_parting(found_->scenario, candidate_, found_->parting);
    if (!plain.is_silent || found_->scenario.run_until == model::RunUntil::time_limit) return plain;
    Scenario longer = found_->scenario;
    longer.run_until = model::RunUntil::time_limit;
    const Parting parting =
        compare_runs(longer, candidate_, events_of_small_run, events_, goes_on_);
    if (parting.kind != Parting::Kind::packets) return plain;
    FirstDifference difference = describe_parting(longer, candidate_, parting);
    if (difference.is_silent) return plain;
    found_ = Found{longer, parting};
    return difference;
  }

  [[nodiscard]] TellingApart answer() {
    const FirstDifference difference = describe();
    const Scenario& scenario = found_->scenario;
    Scenario changed = scenario;
    changed.dds = candidate_;
    TellingApart apart;
    apart.found = true;
    apart.scenario = scenario;
    apart.candidate = candidate_;
    apart.event = difference.base.event;
    apart.difference = difference.text;
    apart.base_run = example(scenario, difference.base);
    apart.candidate_run = example(changed, difference.candidate);
    apart.base_packets = difference.base.packets;
    apart.candidate_packets = difference.candidate.packets;
    apart.tried = tried_;
    apart.finished = finished_;
    apart.how = fmt::format("{} tried, from two participants upward; {}",
                            report::plural(tried_, "scenario"),
                            finished_ ? "nothing simpler than this one tells the profiles apart"
                                      : "the effort was spent before nothing simpler was left");
    return apart;
  }

  static props::Counterexample example(const Scenario& scenario, const Side& side) {
    return {property_id, scenario, side.event, side.time, side.text, {}};
  }

  [[nodiscard]] TellingApart nothing_found() const {
    TellingApart apart;
    apart.candidate = candidate_;
    apart.tried = tried_;
    apart.finished = !spent_;
    apart.how = fmt::format(
        "all of {} scenarios have the same runs: deployments of 2 and 3 participants with 0 to 400 "
        "endpoints each, delays from 1 µs to 1 s, the shared channel, late starts, losses among "
        "the "
        "first 64 packets, the given scenario, and random ones with up to 6 participants{}",
        report::grouped(tried_),
        spent_ ? "; the effort was spent before all of them were tried" : "");
    return apart;
  }

  const DdsProfile& base_;
  const DdsProfile& candidate_;
  const std::function<bool()>& goes_on_;
  std::optional<Found> found_;
  std::optional<Found> inside_;  ///< the first whose packets do not differ
  std::uint64_t events_ = 0;
  std::uint32_t tried_ = 0;
  bool spent_ = false;
  bool finished_ = false;
};

}  // namespace

TellingApart tell_apart(const Scenario& start, const DdsProfile& base, const DdsProfile& candidate,
                        const std::function<bool()>& goes_on) {
  if (normal_form(base) != normal_form(candidate))
    return Search{base, candidate, goes_on}.run(start);
  TellingApart apart;
  apart.candidate = candidate;
  apart.finished = true;
  apart.how = "there is none: no rule reads a knob in which the profiles differ";
  return apart;
}

}  // namespace stormproof::diff
