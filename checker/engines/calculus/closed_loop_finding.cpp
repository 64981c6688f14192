// What the closed loop says of a deployment, for reports.
#include <fmt/core.h>

#include "checker/engines/bounds/resting.hpp"
#include "checker/engines/calculus/cannot_start.hpp"
#include "checker/engines/calculus/closed_loop.hpp"
#include "checker/engines/tables/completion_certificate.hpp"
#include "checker/engines/timeline/quiescence.hpp"
#include "checker/engines/timeline/theorem.hpp"
#include "props/monitors/describe.hpp"
#include "props/property.hpp"

namespace stormproof::calculus {

namespace {

using model::Nanoseconds;
using props::time_text;

std::string repairs_line(const ClosedLoop& loop) {
  if (loop.repairs.sent == 0) return "nothing is repaired without need";
  if (loop.repairs.sent == endless) return "how often something is repaired has no bound";
  return fmt::format("at most {} repairs without need, {} of a descriptor at a reader",
                     loop.repairs.sent, loop.repairs.copies);
}

/// D*, and the bound of the rules at it. A check decides it once.
props::Finding closed_loop_certificate(const ClosedLoop& loop,
                                       const checker::CheckRequest& request) {
  return checker::known(request, "live.completion.deployment", [&] {
    timeline::Theorem theorem{"live.completion.deployment", request};
    prove_closed_loop(theorem, loop);
    props::Finding finding = theorem.finish("the least delay that suffices for its own load");
    finding.engine = props::name_of(props::Engine::calculus);
    finding.assumptions = {without_losses(request.scenario), "start times may be any",
                           "the bound of the rules, at Δ = D*"};
    if (loop.busy) {
      finding.assumptions.emplace_back(
          "the channel never pauses while something waits for it (safety.conservation)");
    }
    finding.details = closed_loop_lines(loop, request.scenario);
    checker::rest_on(finding, tables::completion_certificate(request));
    return finding;
  });
}

/// What it says of the deployment.
props::Finding of_deployment(const ClosedLoop& loop, const checker::CheckRequest& request,
                             const std::string& what) {
  props::Finding finding = closed_loop_certificate(loop, request);
  finding.how =
      fmt::format("from the deployment alone: without a loss {} the last start or creation; {}",
                  what, finding.how);
  return finding;
}

}  // namespace

std::vector<std::string> closed_loop_lines(const ClosedLoop& loop,
                                           const model::Scenario& scenario) {
  std::vector<std::string> lines;
  if (loop.gain) {
    lines.push_back(fmt::format(
        "gain of lateness {:.3g}: each second that packets take longer allows for so many seconds "
        "of repairs and what they cause",
        *loop.gain));
  }
  if (!loop.delay) {
    lines.push_back("the closed loop has no bound: " + loop.gap);
    return lines;
  }
  lines.push_back(
      fmt::format("no packet takes longer than D* = {}, repairs included", time_text(*loop.delay)));
  lines.push_back(repairs_line(loop));
  const std::int64_t messages = loop.messages(scenario.time_limit);
  if (messages != endless) {
    lines.push_back(
        fmt::format("at most {} messages within {}", messages, time_text(scenario.time_limit)));
  }
  return lines;
}

std::optional<props::Finding> completion_of_deployment(const ClosedLoop& loop,
                                                       const checker::CheckRequest& request) {
  if (!loop.delay) return std::nullopt;
  return of_deployment(
      loop, request,
      fmt::format("everything is received within {} of", time_text(loop.completion)));
}

std::optional<props::Finding> quiescence_of_deployment(const ClosedLoop& loop,
                                                       const checker::CheckRequest& request) {
  if (!loop.delay || !loop.silence) return std::nullopt;
  props::Finding finding =
      of_deployment(loop, request,
                    fmt::format("no DATA, HEARTBEAT or ACKNACK is sent later than {} after",
                                time_text(loop.completion + *loop.silence)));
  timeline::Theorem theorem{"live.quiescence.deployment", request};
  timeline::prove_quiescence(theorem);
  checker::rest_on(finding, theorem.finish("the last exchanges end within Q(D*) of completion"));
  return finding;
}

}  // namespace stormproof::calculus
