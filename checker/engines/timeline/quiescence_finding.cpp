// live.quiescence for a scenario: the theorem, the bound, and the schedule in which initial
// ACKNACKs never end.
#include <algorithm>

#include <fmt/core.h>

#include "checker/engines/tables/completion_certificate.hpp"
#include "checker/engines/timeline/directed_check.hpp"
#include "checker/engines/timeline/findings.hpp"
#include "checker/engines/timeline/needless_repair.hpp"
#include "checker/engines/timeline/quiescence.hpp"
#include "props/monitors/describe.hpp"
#include "props/monitors/quiescence.hpp"

namespace stormproof::timeline {
namespace {

using model::Nanoseconds;
using props::time_text;

bool is_doubling(const model::SedpProfile& sedp) {
  return sedp.initial_acknack_interval == model::InitialAckNackInterval::doubling;
}

std::optional<props::Counterexample> endless_attempts(const model::Scenario& scenario) {
  Setting setting;
  setting.dds = scenario.dds;
  setting.run_until = model::RunUntil::time_limit;
  // DATA comes after the HEARTBEATs of that time, so that no loss follows completion.
  const Nanoseconds attempt = scenario.dds.sedp.initial_acknack_delay;
  const Nanoseconds data =
      attempt < scenario.dds.sedp.heartbeat_period ? std::min(attempt, Nanoseconds{2}) : attempt;
  // Attempts come at τ_I·(2ⁿ − 1): there is one between x and 2x + τ_I. With a constant interval
  // there is one between x and x + τ_I.
  const Nanoseconds quiet = data + props::quiescence_bound(scenario.dds, data);
  setting.time_limit =
      is_doubling(scenario.dds.sedp) ? quiet * 2 + attempt * 3 : quiet + attempt * 2;
  const auto run = direct(setting, all_heartbeats_lost(data));
  if (!run) return std::nullopt;
  return confirmed_counterexample("live.quiescence", run->scenario);
}

/// The schedule that attains the bound, for a delay at which it does.
std::vector<BoundaryPoint> late_packets(const Question& question) {
  BoundaryPoint point;
  point.setting.dds = encoded_profile(question.dds());
  model::SedpProfile& sedp = point.setting.dds.sedp;
  sedp.initial_data = model::InitialData::push;
  Nanoseconds delta{sedp.heartbeat_period.count() / 3};
  if (sedp.initial_acknack_delay > Nanoseconds{0}) {
    delta = std::min(delta, sedp.initial_acknack_delay);
  }
  const Nanoseconds answered = delta + sedp.heartbeat_response_delay;
  if (delta < Nanoseconds{1} || answered >= sedp.heartbeat_period) return {};
  if (delta + answered > sedp.heartbeat_period) return {};
  point.name = "the last HEARTBEAT after completion is lost, Δ = " + time_text(delta);
  point.setting.run_until = model::RunUntil::time_limit;
  const Nanoseconds last = sedp.heartbeat_period * 2 + answered;
  point.setting.time_limit = last + sedp.heartbeat_period * 3;
  point.director = last_packet_late(delta);
  point.expected = [last](const Prediction& p) -> std::string {
    if (p.last_packet == last) return {};
    return "the last packet should be sent at " + time_text(last);
  };
  return {point};
}

}  // namespace

props::Finding quiescence_finding(const Question& question) {
  Theorem theorem{"live.quiescence", question.request};
  const bool single = question.sedp().heartbeat_timer == model::HeartbeatTimerKind::single;
  const bool covered =
      question.writer() == model::Writer::of_the_paper && !question.is_adaptive() && single;
  if (covered && theorem.is_asked_for()) prove_quiescence(theorem);
  props::Finding finding = theorem.finish(
      "linear arithmetic over the last exchanges, with all timers and delays symbolic");
  const Nanoseconds delta = question.measured.largest_delay;
  finding.details.push_back(fmt::format("Q = {} after completion at the measured Δ = {}",
                                        time_text(props::quiescence_bound(question.dds(), delta)),
                                        time_text(delta)));
  finding.assumptions.push_back("no packet takes longer than Δ (" +
                                measured_text(question.measured) + ")");
  finding.assumptions.push_back("nothing is lost from completion on");
  if (!covered) {
    leave_open(finding,
               "the proof is for the paper's writer with a single periodic timer; for this one the "
               "exact run is held against Q");
    return finding;
  }
  finding.details.push_back(
      "Q = max((1 + m)·τ_H + Δ + τ_A, 2Δ + τ_N + τ_A), m = max(0, ⌈(2Δ + τ_A)/τ_H⌉ − 1); with "
      "initial_acknack: heartbeat at least τ_H + 3Δ + τ_A; counted from the last loss if that "
      "comes "
      "after completion, and then attained");
  if (theorem.is_asked_for()) {
    rest_on(finding, tables::completion_certificate(question.request));
  }
  if (asks_by_itself(question.sedp())) {
    finding.details.push_back(fmt::format(
        "Q is proved for relations whose reader has seen a HEARTBEAT; one that has not may go on "
        "asking for ever, at {} distances",
        is_doubling(question.sedp()) ? "doubling" : "equal"));
    if (auto example = endless_attempts(question.request.scenario)) {
      if (finding.kind != props::VerdictKind::disputed) {
        finding.kind = props::VerdictKind::violated;
      }
      finding.details.push_back(
          "if every HEARTBEAT until then is lost, an initial ACKNACK confirms everything, the "
          "writer falls silent, and the reader never sees a HEARTBEAT: " +
          example->reason);
      finding.counterexample = std::move(example);
    } else {
      leave_open(finding, "initial ACKNACKs may not end, but no schedule was confirmed");
    }
  }
  hold_against_runs(late_packets(question), "live.quiescence", question.request, finding);
  return finding;
}

}  // namespace stormproof::timeline
