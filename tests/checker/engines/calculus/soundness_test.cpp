// The bound against runs: random deployments of all implementations over all kinds of channels,
// with start times drawn anew. No packet takes longer than proved, no class of traffic takes more
// airtime, and where storm.cannot-start is proved no run repairs. A bound that forgets something is
// noticed by the same comparison.
#include <array>
#include <map>
#include <optional>
#include <string>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "checker/engines/calculus/cannot_start.hpp"
#include "tests/checker/engines/calculus/covered_scenarios.hpp"
#include "tests/checker/engines/calculus/observed_delays.hpp"

namespace stormproof::calculus {
namespace soundness_test {

using model::Nanoseconds;
using model::TrafficClass;

constexpr std::uint64_t deployments = 300;
constexpr std::uint64_t schedules = 3;

/// Airtime of traffic in a window, by what can be told apart: a HEARTBEAT inside of DATA counts as
/// one of both.
std::map<std::string, std::int64_t> airtimes(const OpenLoop& traffic, std::int64_t window,
                                             std::int64_t delay) {
  std::map<std::string, std::int64_t> sums;
  for (const Flow& flow : traffic.flows) {
    const std::int64_t sum = times(flow.airtime, flow.when.most(window, delay));
    const bool data =
        flow.traffic == TrafficClass::initial_data || flow.traffic == TrafficClass::heartbeat;
    std::int64_t& entry = sums[data ? "DATA and HEARTBEATs" : model::words_of(flow.traffic)];
    entry = plus(entry, sum);
    if (flow.traffic == TrafficClass::heartbeat) {
      std::int64_t& messages = sums["HEARTBEAT messages"];
      messages = plus(messages, times(flow.messages, flow.when.most(window, delay)));
    }
  }
  return sums;
}

std::map<std::string, std::int64_t> airtimes(const model::RunResult& result) {
  std::map<std::string, std::int64_t> sums;
  for (const model::ChannelUse& channel : result.channels) {
    for (std::size_t k = 0; k < model::traffic_class_count; ++k) {
      const auto traffic = static_cast<TrafficClass>(k);
      const bool data = traffic == TrafficClass::initial_data || traffic == TrafficClass::heartbeat;
      sums[data ? "DATA and HEARTBEATs" : model::words_of(traffic)] += channel.busy[k].count();
    }
  }
  sums["HEARTBEAT messages"] = static_cast<std::int64_t>(result.counts.heartbeat);
  return sums;
}

/// What a run does that the bound says it cannot; nothing: nothing.
std::optional<std::string> excess(const Observed& run, const Judged& judged) {
  if (run.result.counts.repair_data > 0) return std::nullopt;
  if (judged.busy && run.longest > *judged.busy) {
    return fmt::format("a packet takes {} ns, not at most {} ns", run.longest.count(),
                       judged.busy->count());
  }
  if (!judged.busy) return std::nullopt;
  auto bounds = airtimes(*judged.traffic, run.result.end_time.count(), judged.delay->count());
  for (const auto& [what, measured] : airtimes(run.result)) {
    if (measured > bounds[what]) {
      return fmt::format("{}: {}, not at most {}", what, measured, bounds[what]);
    }
  }
  return std::nullopt;
}

template <class Use>
void for_runs(const Use& use) {
  for (std::uint64_t seed = 1; seed <= deployments; ++seed) {
    model::Scenario scenario = covered_scenario(seed);
    if (seed % 4 != 0) be_patient(scenario, seed % 4 == 1);
    const Judged judged = judge(scenario);
    if (!judged.delay) continue;
    for (std::uint64_t k = 0; k < schedules; ++k) {
      if (k > 0) draw_starts(scenario, 1'000 * seed + k);
      use(seed, run_of(scenario, *judged.delay), judged);
    }
  }
}

TEST(CannotStart, NoRunExceedsTheBoundAndNoProvedOneRepairs) {
  std::map<Lemma, int> proved;
  int compared = 0;
  for_runs([&](std::uint64_t seed, const Observed& run, const Judged& judged) {
    const bool same_host_repairs = model::traits_of(run.scenario.dds).discovers_same_host;
    if (judged.is_proved()) {
      ++proved[judged.threshold.lemma];
      EXPECT_EQ(run.result.counts.repair_data, 0U)
          << "seed " << seed << ": " << judged.threshold.formula;
    }
    if (!judged.is_proved() && same_host_repairs) return;
    ++compared;
    EXPECT_EQ(excess(run, judged).value_or(""), "") << "seed " << seed;
  });
  for (const Lemma lemma : {Lemma::any_order, Lemma::in_order, Lemma::constant_delay,
                            Lemma::patient_reader, Lemma::long_suppression}) {
    EXPECT_GT(proved[lemma], 3) << static_cast<int>(lemma);
  }
  EXPECT_GT(compared, 300);
}

TEST(CannotStart, ABoundThatForgetsSomethingIsNoticed) {
  constexpr std::array<std::pair<const char*, Omission>, 5> omissions{
      {{"HEARTBEATs", {.heartbeats = true}},
       {"piggyback HEARTBEATs", {.piggyback = true}},
       {"same-host participants", {.same_host = true}},
       {"user control", {.user_control = true}},
       {"copies to ports", {.port_copies = true}}}};
  std::array<int, omissions.size()> noticed{};
  for_runs([&](std::uint64_t, const Observed& run, const Judged& correct) {
    if (!correct.is_proved() || !correct.busy) return;
    for (std::size_t k = 0; k < omissions.size(); ++k) {
      Judged judged = judge(run.scenario, omissions[k].second);
      if (judged.delay && excess(run, judged)) ++noticed[k];
    }
  });
  for (std::size_t k = 0; k < omissions.size(); ++k) {
    EXPECT_GT(noticed[k], 0) << omissions[k].first;
  }
}

}  // namespace soundness_test
}  // namespace stormproof::calculus
