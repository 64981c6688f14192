// There is no encoding of Fast DDS's whole relation to compare runs with, so they are held against
// the bound alone.
#include "checker/engines/timeline/fastdds_runs.hpp"

#include <algorithm>
#include <bit>

#include <fmt/core.h>

#include "checker/engines/bounds/completion_bound.hpp"
#include "checker/engines/timeline/directed_run.hpp"
#include "props/monitors/describe.hpp"

namespace stormproof::timeline {
namespace {

using model::Nanoseconds;
using model::PacketKind;

constexpr std::uint32_t publications = 9;  // default ones: what is pushed is one packet each

/// Everything takes Δ. Bits of `losses`: the last descriptor's first DATA, the repair after it, the
/// second HEARTBEAT, the second ACKNACK.
struct Schedule {
  Nanoseconds delta;
  bool pushed = false;
  unsigned losses = 0;

  Passing operator()(const DirectedPacket& packet) const {
    const std::uint32_t first = pushed ? publications - 1 : 0;
    bool lost = false;
    if (packet.kind == PacketKind::data) {
      lost = ((losses & 1U) != 0 && packet.ordinal == first) ||
             ((losses & 2U) != 0 && packet.ordinal == first + 1);
    } else if (packet.ordinal == 1) {
      lost = (losses & (packet.kind == PacketKind::heartbeat ? 4U : 8U)) != 0;
    }
    return {delta, Nanoseconds{0}, lost};
  }
};

struct Outcome {
  std::optional<DirectedRun> run;
  Nanoseconds limit;
  [[nodiscard]] bool keeps_bound() const {
    return run && run->completion && *run->completion <= limit;
  }
};

Outcome run_schedule(const Question& question, const Schedule& schedule) {
  const model::DdsProfile& dds = question.dds();
  const auto bound = completion_bound(dds, {schedule.delta, std::nullopt, false, {}});
  Setting setting;
  model::Scenario scenario = question.request.scenario;
  const checker::Mutant* const mutant = question.request.mutant;
  if (mutant != nullptr && mutant->knobs) mutant->knobs(scenario);
  setting.dds = scenario.dds;
  setting.descriptors = 0;
  if (schedule.pushed) setting.endpoints_done = dds.sedp.heartbeat_period;
  Outcome outcome;
  const unsigned losses = static_cast<unsigned>(std::popcount(schedule.losses));
  outcome.limit = setting.endpoints_done + bound->after(losses).value_or(Nanoseconds{0});
  setting.time_limit = outcome.limit + dds.sedp.heartbeat_period;
  outcome.run = direct(setting, schedule, mutant != nullptr ? &mutant->rules : nullptr);
  return outcome;
}

}  // namespace

void hold_fastdds_against_bound(const Question& question, props::Finding& finding) {
  const Nanoseconds delta{std::max<std::int64_t>(1, question.sedp().heartbeat_period.count() / 16)};
  if (!completion_bound(question.dds(), {delta, std::nullopt, false, {}})) return;
  unsigned kept = 0;
  constexpr unsigned schedules = 32;
  for (unsigned k = 0; k < schedules; ++k) {
    const Outcome outcome = run_schedule(question, {delta, k % 2 == 1, k / 2});
    if (outcome.keeps_bound()) {
      ++kept;
      continue;
    }
    run_contradicts(finding, question.request, "a run of the machines exceeds the bound");
    if (!outcome.run || finding.counterexample) continue;
    const std::string took = outcome.run->completion
                                 ? props::time_text(*outcome.run->completion)
                                 : "more than " + props::time_text(outcome.run->result.end_time);
    finding.counterexample = props::Counterexample{
        "live.completion",
        outcome.run->scenario,
        outcome.run->result.events,
        outcome.run->result.end_time,
        fmt::format("A relation takes {}; the bound is {}.", took, props::time_text(outcome.limit)),
        {}};
  }
  finding.details.push_back(
      fmt::format("{} of {} runs with up to 4 losses keep the bound", kept, schedules));
}

}  // namespace stormproof::timeline
