// live.completion for a scenario: the theorem, the bound in numbers, and what the scenario's own
// run says about the theorem's assumptions.
#include <algorithm>

#include <fmt/core.h>

#include "checker/engines/tables/completion_certificate.hpp"
#include "checker/engines/timeline/completion_theorem.hpp"
#include "checker/engines/timeline/completion_witness.hpp"
#include "checker/engines/timeline/directed_check.hpp"
#include "checker/engines/timeline/fastdds_runs.hpp"
#include "checker/engines/timeline/findings.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::timeline {
namespace {

using model::Nanoseconds;
using props::time_text;

constexpr std::int64_t most_rounds = 4'000;

/// Every writer has one reader at most.
bool has_pairs_only(const model::Deployment& deployment) {
  return std::ranges::all_of(deployment.participants, [&](const model::Participant& one) {
    return std::ranges::count_if(deployment.participants, [&](const model::Participant& other) {
             return other.host != one.host;
           }) <= 1;
  });
}

Circumstances circumstances_of(const Question& question) {
  Circumstances c;
  c.delta = question.measured.largest_delay;
  if (question.has_constant_delay()) c.source = Nanoseconds{0};
  c.timer_starts_with_relation = has_pairs_only(question.request.scenario.deployment);
  return c;
}

std::string numbers(const CompletionBound& bound, Nanoseconds delta) {
  std::string text = "at Δ = " + time_text(delta) + ":";
  for (unsigned k = 0; k <= 3; ++k) {
    const auto after = bound.after(k);
    text += fmt::format("{} B({}) = {}", k == 0 ? "" : ",", k, after ? time_text(*after) : "?");
  }
  return text;
}

void describe(const Question& question, props::Finding& finding) {
  const Circumstances c = circumstances_of(question);
  const auto bound = completion_bound(question.dds(), c);
  if (!bound) return;
  finding.details.push_back(bound->formula);
  finding.details.push_back(
      "region: all τ_A, τ_N, τ_S ≥ 0, τ_H > 0, 0 ≤ μ ≤ Δ, 0 ≤ σ ≤ Δ; rounds may overlap");
  finding.details.push_back("the measured Δ: " + numbers(*bound, c.delta));
  for (const std::int64_t ms : {1, 100}) {
    Circumstances other = c;
    other.delta = Nanoseconds{ms * 1'000'000};
    if (const auto b = completion_bound(question.dds(), other)) {
      finding.details.push_back("for comparison " + numbers(*b, other.delta));
    }
  }
  finding.assumptions.push_back("no packet takes longer than Δ from emission to reception (" +
                                measured_text(question.measured) + ")");
  finding.assumptions.push_back("at most k packets of the relation are lost");
  if (question.writer() == model::Writer::stateful) {
    finding.assumptions.push_back(
        "time counts from the creation of the descriptor or the match of both sides, whichever "
        "comes last");
  } else {
    finding.assumptions.push_back(c.source
                                      ? "a packet leaves its source at once (σ = 0)"
                                      : "a packet may need all of Δ to leave its source (σ = Δ)");
    finding.assumptions.push_back(c.timer_starts_with_relation
                                      ? "a writer has one reader, so its timer starts with it"
                                      : "the writer's timer may be at any phase when a relation "
                                        "opens, and HEARTBEATs for other reasons may come at any "
                                        "time");
  }
  if (!question.measured.t_disc) {
    finding.details.push_back("the run of this scenario does not complete discovery in its time");
  }
}

BoundaryPoint worst_case(const model::DdsProfile& dds, const Circumstances& c, unsigned losses,
                         const CompletionBound& bound) {
  const Nanoseconds limit = *bound.after(losses);
  BoundaryPoint point;
  point.name = fmt::format("worst case, Δ = {}, {} losses{}", time_text(c.delta), losses,
                           c.timer_starts_with_relation ? "" : ", worst phase");
  point.setting.dds = dds;
  if (!c.timer_starts_with_relation) point.setting.phase = worst_phase(dds.sedp, c);
  point.setting.run_until = model::RunUntil::time_limit;
  point.setting.time_limit = limit + bound.exchange + dds.sedp.heartbeat_period;
  point.director = worst_completion(dds.sedp, c, losses);
  point.expected = [limit](const Prediction& p) -> std::string {
    if (p.received == limit) return {};
    return "B is " + time_text(limit) + ", but the descriptor is received " +
           (p.received ? "after " + time_text(*p.received) : "never");
  };
  return point;
}

/// Worst cases with at most three losses, for a delay at which rounds do not overlap and for one at
/// which they may.
std::vector<BoundaryPoint> worst_cases(const Question& question) {
  std::vector<BoundaryPoint> points;
  const model::DdsProfile dds = encoded_profile(question.dds());
  const Nanoseconds period = dds.sedp.heartbeat_period;
  for (const std::int64_t share : {16, 4, 1}) {
    Circumstances c;
    c.delta = Nanoseconds{std::max<std::int64_t>(2, period.count() / share)};
    if (!is_attained(dds.sedp, c.delta)) c.delta = dds.sedp.initial_acknack_delay;
    c.least = Nanoseconds{1};
    if (c.delta < Nanoseconds{2}) continue;
    c.source = Nanoseconds{c.delta.count() / 2};
    for (const bool starts : {true, false}) {
      c.timer_starts_with_relation = starts;
      const auto bound = completion_bound(dds, c);
      if (!bound || !bound->after(3)) continue;
      if (bound->after(3)->count() / period.count() > most_rounds) continue;
      for (unsigned k = 0; k <= 3; ++k) points.push_back(worst_case(dds, c, k, *bound));
    }
  }
  return points;
}

/// Everything follows from the rules.
props::Finding stateful_finding(const Question& question, Theorem& theorem) {
  props::Finding finding = theorem.is_asked_for() ? tables::completion_certificate(question.request)
                                                  : theorem.finish("");
  finding.engine = "timelines";
  describe(question, finding);
  finding.details.push_back("an upper bound; it is not claimed that it is attained");
  hold_fastdds_against_bound(question, finding);
  return finding;
}

/// What the theorem about the paper's writer takes from the rules, and what they give alone.
void rest_on_rules(const Question& question, props::Finding& finding) {
  finding.assumptions.push_back(
      "an exchange takes the times that specs/guide/bounds.md gives it; runs are compared with "
      "them");
  const std::string why = tables::not_certified(question.dds());
  if (!why.empty()) {
    finding.assumptions.push_back(
        "while something is not acknowledged, an expiry is pending within τ_H that sends to its "
        "reader (" +
        why + ")");
    return;
  }
  const Losses<fsm::Plain> losses = loss_bound(question.dds(), circumstances_of(question));
  finding.details.push_back(fmt::format(
      "the rules alone give at the measured Δ: {} after k = 0 losses, and L = {} later for each",
      time_text(Nanoseconds{losses.first + losses.exchange}), time_text(Nanoseconds{losses.loss})));
  rest_on(finding, tables::completion_certificate(question.request));
}

}  // namespace

props::Finding completion_finding(const Question& question) {
  Theorem theorem{"live.completion", question.request};
  if (question.is_adaptive()) {
    props::Finding finding = theorem.finish("bound for the periodic HEARTBEAT policy");
    leave_open(finding, "the adaptive policy has no fixed period; no bound is derived for it");
    return finding;
  }
  if (question.writer() == model::Writer::stateful) return stateful_finding(question, theorem);
  if (theorem.is_asked_for()) prove_completion(theorem);
  props::Finding finding = theorem.finish(
      "inductive invariant over the periodic HEARTBEATs, with all timers, delays and the number of "
      "losses symbolic");
  describe(question, finding);
  if (theorem.is_asked_for()) rest_on_rules(question, finding);
  if (is_attained(question.sedp(), question.measured.largest_delay)) {
    finding.details.push_back("the bound is attained: see the worst cases among the boundary runs");
  } else {
    finding.details.push_back(
        "an upper bound at the measured Δ; attained only up to Δ = τ_I, because initial ACKNACKs "
        "ask earlier, and if both sides open at once");
  }
  hold_against_runs(worst_cases(question), "live.completion", question.request, finding);
  return finding;
}

}  // namespace stormproof::timeline
