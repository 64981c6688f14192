// The verdict about one deployment, and by how much it misses it.
#include <algorithm>
#include <exception>

#include <fmt/core.h>
#include <z3++.h>

#include "checker/engines/calculus/calculus.hpp"
#include "checker/engines/calculus/cannot_start.hpp"
#include "checker/engines/calculus/closed_loop.hpp"
#include "checker/engines/calculus/gain.hpp"
#include "checker/engines/timeline/theorem.hpp"
#include "model/implementations.hpp"
#include "props/monitors/delay_meter.hpp"
#include "props/monitors/describe.hpp"
#include "props/property.hpp"

namespace stormproof::calculus {

namespace {

using model::Nanoseconds;
using props::time_text;

Nanoseconds longest_constant(const model::WirelessProfile& wireless) {
  Nanoseconds longest = wireless.one_way;
  for (const model::PacketDelay& delay : wireless.packet_delays) {
    longest = std::max(longest, delay.one_way);
  }
  return longest;
}

/// "DATA 12.3 ms (30 %), …": the largest parts of the busy period.
std::string parts_text(const OpenLoop& traffic, Nanoseconds busy, Nanoseconds delay) {
  std::vector<std::pair<std::int64_t, const Flow*>> parts;
  for (const Flow& flow : traffic.flows) {
    parts.emplace_back(times(flow.airtime, flow.when.most(busy.count(), delay.count())), &flow);
  }
  std::ranges::stable_sort(parts, std::greater<>{}, [](const auto& part) { return part.first; });
  std::string text;
  for (std::size_t k = 0; k < std::min<std::size_t>(parts.size(), 5); ++k) {
    text += fmt::format("{}{} {}", k == 0 ? "" : ", ", parts[k].second->what,
                        time_text(Nanoseconds{parts[k].first}));
  }
  return text;
}

void add_margin(const Judged& judged, props::Finding& finding) {
  const Threshold& threshold = judged.threshold;
  if (!threshold.exists()) {
    finding.details.push_back("there is no threshold: " + threshold.why);
    return;
  }
  const std::string limit = threshold.unlimited
                                ? "at any delay"
                                : fmt::format("if no packet takes longer than Δ* = {} = {}",
                                              threshold.formula, time_text(threshold.delta));
  finding.details.push_back(fmt::format("no repair {}: {}", limit, threshold.why));
  if (!judged.delay || threshold.unlimited) return;
  const bool within = *judged.delay <= threshold.delta;
  const Nanoseconds distance =
      within ? threshold.delta - *judged.delay : *judged.delay - threshold.delta;
  finding.details.push_back(
      fmt::format("{} {}", within ? "margin" : "missed by", time_text(distance)));
}

void add_load(const Judged& judged, props::Finding& finding) {
  if (!judged.gap.empty()) {
    finding.details.push_back("no bound on the delay: " + judged.gap);
  } else if (!judged.traffic) {
    finding.details.push_back("no packet takes longer than " + time_text(*judged.delay));
  } else {
    const bool is_local = *judged.delay > *judged.busy;
    finding.details.push_back(fmt::format(
        "no packet of the open-loop traffic takes longer than {}, {}", time_text(*judged.delay),
        is_local ? fmt::format("as long as on the same host (loopback_delay); the longest busy "
                               "period of the channel is {}",
                               time_text(*judged.busy))
                 : std::string{"the longest busy period of the channel"}));
    finding.details.push_back("  its work: " +
                              parts_text(*judged.traffic, *judged.busy, *judged.delay));
  }
}

std::string sentence(const Judged& judged) {
  const Threshold& threshold = judged.threshold;
  if (!threshold.exists()) return "no threshold: " + threshold.why;
  if (!judged.delay) return judged.gap;
  if (threshold.unlimited) return "no repair is possible at any delay: " + threshold.why;
  return fmt::format("open-loop packets take at most {}; no repair is possible up to {}",
                     time_text(*judged.delay), time_text(threshold.delta));
}

/// "0.54", "38": a gain below 1 is never shown as 1.
std::string gain_text(double gain) {
  return gain < 1 ? fmt::format("{:.2f}", std::min(gain, 0.99)) : fmt::format("{:.0f}", gain);
}

/// What is true of the deployment whatever packets take.
std::string gain_line(const Gain& gain, Nanoseconds until) {
  const std::string start = fmt::format("gain {}: ", gain_text(gain.worst.value()));
  const auto repairs = gain.repairs(until);
  if (!repairs) {
    return start +
           "one repair can cause so many more, through the HEARTBEATs that its bytes add to";
  }
  return start + fmt::format(
                     "repairs cannot feed themselves; without a loss and at any delays at "
                     "most {} are sent within {}",
                     *repairs, time_text(until));
}

/// The closed loop of a deployment, found once and only where somebody asks for it.
class LazyLoop {
 public:
  explicit LazyLoop(const model::Scenario& scenario) : scenario_{scenario} {}
  const ClosedLoop& operator()() {
    if (!found_) found_ = closed_loop(scenario_);
    return *found_;
  }

 private:
  const model::Scenario& scenario_;
  std::optional<ClosedLoop> found_;
};

props::Finding decide(const checker::CheckRequest& request, LazyLoop& loop) {
  const Judged judged = judge(request.scenario);
  timeline::Theorem theorem{cannot_start, request};
  prove_lemmas(theorem, judged.threshold.lemma);
  if (judged.busy) prove_numbers(theorem, *judged.traffic, *judged.busy, *judged.delay);
  const std::optional<Gain> gain = gain_of(request.scenario);
  const Nanoseconds until = request.scenario.time_limit;
  if (!judged.is_proved()) {
    if (gain) prove_gain(theorem, gain->worst, times(gain->worst.readers, gain->asked(until)));
    const bool missed = judged.delay && judged.threshold.exists();
    theorem.give_up(missed ? "missed by " + time_text(*judged.delay - judged.threshold.delta)
                           : std::string{"nothing is proved of this deployment"});
  }
  props::Finding finding = theorem.finish(sentence(judged));
  finding.engine = props::name_of(props::Engine::calculus);
  finding.assumptions = {without_losses(request.scenario), "start times may be any"};
  if (judged.traffic) {
    finding.assumptions.emplace_back(
        "the channel never pauses while something waits for it "
        "(safety.conservation)");
  }
  add_margin(judged, finding);
  add_load(judged, finding);
  if (judged.is_proved()) return finding;
  if (gain) finding.details.push_back(gain_line(*gain, until));
  for (std::string& line : closed_loop_lines(loop(), request.scenario)) {
    finding.details.push_back(std::move(line));
  }
  return finding;
}

props::Finding failed(const char* why) {
  props::Finding finding;
  finding.engine = props::name_of(props::Engine::calculus);
  finding.how = std::string{"inconclusive: "} + why;
  return finding;
}

}  // namespace

Judged judge(const model::Scenario& scenario, const Omission& omission) {
  Judged judged;
  const bool channel = scenario.wireless.kind == model::ServiceKind::shared_channel;
  const char* const gap = channel ? uncovered(scenario) : nullptr;
  if (gap != nullptr) judged.gap = gap;
  if (channel && gap == nullptr) judged.traffic = open_loop(scenario, omission);
  judged.threshold = threshold_of(scenario, judged.traffic ? &*judged.traffic : nullptr);
  const Nanoseconds loopback = props::loopback_of(scenario);
  if (!channel) {
    judged.delay = std::max(longest_constant(scenario.wireless), loopback);
  } else if (judged.traffic) {
    if (const auto busy = busy_period(*judged.traffic, loopback)) {
      judged.busy = busy->length;
      judged.delay = std::max(busy->length, loopback);
    } else {
      judged.gap = "the open-loop traffic can occupy the channel without end";
    }
  }
  return judged;
}

std::string without_losses(const model::Scenario& scenario) {
  const std::size_t lost = scenario.wireless.lost_packets.size();
  if (lost == 0) return "no packet is lost";
  return fmt::format(
      "no packet is lost, so nothing is said of the scenario's own run, which is to lose {} "
      "(wireless.lost_packets)",
      lost);
}

checker::Findings check(std::span<const std::string_view> properties,
                        const checker::CheckRequest& request) {
  checker::Findings findings;
  if (request.mutant != nullptr) return findings;
  const auto is_asked = [&](std::string_view id) {
    return std::ranges::find(properties, id) != properties.end() &&
           (!request.on_progress || request.on_progress(id));
  };
  const auto answer = [&](std::string_view id, const auto& decided) {
    if (!is_asked(id)) return;
    try {
      if (std::optional<props::Finding> finding = decided()) {
        findings.emplace_back(id, *std::move(finding));
      }
    } catch (const z3::exception& error) {
      findings.emplace_back(id, failed(error.msg()));
    } catch (const std::exception& error) {
      findings.emplace_back(id, failed(error.what()));
    }
  };
  LazyLoop loop{request.scenario};
  answer(cannot_start, [&] { return std::optional{decide(request, loop)}; });
  answer("live.completion", [&] { return completion_of_deployment(loop(), request); });
  answer("live.quiescence", [&] { return quiescence_of_deployment(loop(), request); });
  return findings;
}

}  // namespace stormproof::calculus
