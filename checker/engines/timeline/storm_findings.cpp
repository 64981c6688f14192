// storm.free-threshold and storm.single-copy for a scenario: the theorems, the threshold, the
// margin, and if there is none a schedule with a needless repair that the machines run.
#include <algorithm>

#include <fmt/core.h>

#include "checker/engines/tables/free_certificate.hpp"
#include "checker/engines/timeline/directed_check.hpp"
#include "checker/engines/timeline/findings.hpp"
#include "checker/engines/timeline/free_threshold.hpp"
#include "checker/engines/timeline/needless_repair.hpp"
#include "checker/engines/timeline/single_copy.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::timeline {
namespace {

using model::Nanoseconds;
using props::time_text;

/// The scenario against the threshold: the same for both properties, as without a loss every repair
/// of pushed DATA is a second copy.
void judge(const Question& question, std::string_view property, props::Finding& finding) {
  if (finding.kind != props::VerdictKind::proved) return;
  const Nanoseconds delta = question.measured.largest_delay;
  finding.assumptions.push_back("no packet is lost (" + measured_text(question.measured) + ")");
  if (question.writer() == model::Writer::of_the_paper) {
    const FreeThreshold threshold = free_threshold(question.sedp(), question.has_constant_delay());
    if (question.has_constant_delay()) {
      finding.assumptions.push_back("every packet between two hosts takes the same time");
    }
    if (threshold.unlimited) {
      finding.details.push_back("no repair is possible at any delay");
      return;
    }
    if (threshold.exists) {
      const bool within = delta <= threshold.delta;
      finding.details.push_back(fmt::format(
          "no repair is possible at delays up to Δ* = {} = {}; largest measured {}, {} {}",
          threshold.formula, time_text(threshold.delta), time_text(delta),
          within ? "margin" : "too much by",
          time_text(within ? threshold.delta - delta : delta - threshold.delta)));
      if (within) {
        finding.longest_delay = threshold.delta;
        finding.assumptions.push_back(fmt::format("no packet takes longer than Δ* = {} = {}",
                                                  threshold.formula, time_text(threshold.delta)));
        return;
      }
    }
  }
  if (auto example = needless_repair(question.request.scenario, property, delta)) {
    finding.kind = props::VerdictKind::violated;
    finding.details.push_back(
        "at delays that this scenario reaches a needless repair is possible: " + example->reason);
    finding.counterexample = std::move(example);
    return;
  }
  leave_open(finding,
             question.writer() == model::Writer::stateful
                 ? fmt::format("{}'s shared timers leave no threshold above 0, and no schedule at "
                               "the measured delay was found; the exact run decides",
                               model::traits_of(question.dds()).whose)
                 : "the measured delay is above what is proved for this profile, and no schedule "
                   "at that delay was found; the exact run decides");
}

/// What is proved is so by the rules, too, where they have a certificate for these delays.
void rest_on_free_certificate(const Question& question, props::Finding& finding) {
  if (finding.kind != props::VerdictKind::proved) return;
  const bool constant = question.has_constant_delay();
  const auto covered = tables::certified_free(question.dds(), constant);
  if (!covered || question.measured.largest_delay > *covered) return;
  rest_on(finding, tables::free_certificate(question.request, constant));
  if (finding.longest_delay) finding.longest_delay = std::min(*finding.longest_delay, *covered);
}

}  // namespace

props::Finding free_threshold_finding(const Question& question) {
  Theorem theorem{"storm.free-threshold", question.request};
  std::vector<EliminatedCondition> parts;
  if (theorem.is_asked_for()) parts = prove_free_threshold(theorem);
  props::Finding finding =
      theorem.finish("quantifier elimination over all delays and HEARTBEAT times");
  for (const EliminatedCondition& part : parts) {
    const char* what = "";
    switch (part.cause) {
      case RepairCause::heartbeat:
        what = "a HEARTBEAT overtakes pushed DATA";
        break;
      case RepairCause::initial_acknack:
        what = "an initial ACKNACK (bitmap) asks for pushed DATA";
        break;
      case RepairCause::in_order:
        what = "a HEARTBEAT asks for pushed DATA that it does not overtake";
        break;
      case RepairCause::constant_delay:
        what = "an initial ACKNACK (bitmap) leads to a repair of pushed DATA, constant delay";
        break;
      case RepairCause::second_request:
        what = "pulled DATA is requested again (one packet)";
        break;
      case RepairCause::fastdds_heartbeat:
        what = "Fast DDS, one descriptor: a HEARTBEAT overtakes pushed DATA";
        break;
    }
    finding.details.push_back(fmt::format("{}: possible iff {}", what, part.simplified));
    finding.details.push_back("  eliminated: " + part.eliminated);
  }
  judge(question, "storm.free-threshold", finding);
  if (theorem.is_asked_for()) rest_on_free_certificate(question, finding);
  if (question.writer() == model::Writer::of_the_paper) {
    hold_against_runs(threshold_points(question.dds()), "storm.free-threshold", question.request,
                      finding);
  }
  return finding;
}

props::Finding single_copy_finding(const Question& question) {
  Theorem theorem{"storm.single-copy", question.request};
  if (theorem.is_asked_for()) {
    prove_single_copy(theorem);
    // That pushed DATA within the threshold is not repaired is part of the other theorem.
    prove_free_threshold(theorem);
  }
  props::Finding finding = theorem.finish("linear arithmetic with all timers and delays symbolic");
  const model::SedpProfile& sedp = question.sedp();
  const Nanoseconds lower = sedp.nack_response_delay + sedp.nack_suppression_duration;
  const Nanoseconds upper = question.measured.largest_delay * 2 + sedp.nack_response_delay;
  finding.details.push_back(
      "with constant delay Δ, two HEARTBEATs g apart and the descriptor missing, a needless repair "
      "appears iff λ + τ_N + τ_S < g < 2Δ + τ_N, λ the time to leave the source");
  finding.details.push_back("Fast DDS: iff also g > τ_A, with λ = 0");
  finding.details.push_back(fmt::format("here, at λ = 0 and the measured Δ: {} < g < {}{}",
                                        time_text(lower), time_text(upper),
                                        lower + Nanoseconds{1} < upper ? "" : ", so never"));
  judge(question, "storm.single-copy", finding);
  if (theorem.is_asked_for()) rest_on_free_certificate(question, finding);
  if (question.writer() == model::Writer::of_the_paper) {
    hold_against_runs(single_copy_points(question.dds()), "storm.single-copy", question.request,
                      finding);
  }
  return finding;
}

}  // namespace stormproof::timeline
