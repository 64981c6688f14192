// All verbs mean the same by STORM: of every shipped scenario, run with its own start times, the
// judgement of a run (simulate, check, fuzz, diff), that of a sample (compare-discovery, launch),
// and that of the run's own capture (doctor, watch) agree.
#include <algorithm>

#include <gtest/gtest.h>

#include "checker/engines/exact/health.hpp"
#include "checker/evidence/capture/write/simulated_capture.hpp"
#include "checker/evidence/doctor/doctor.hpp"
#include "checker/experiments/trials/sample_runs.hpp"
#include "model/config/spec_path.hpp"
#include "tests/props/monitored_run.hpp"

namespace stormproof::doctor {
namespace one_storm_test {

/// By its run, and by the capture of that run over the run's own channel.
void expect_agreement(const std::string& name, const model::Scenario& scenario) {
  const capture::SimulatedCapture simulated = capture::simulated_capture(scenario);
  const exact::RunHealth run = exact::health_of(scenario, simulated.run);
  const std::vector<capture::MemoryCapture> files{
      {name, simulated.pcap, simulated.pcap.size() + 1}};
  const auto conversation = capture::read_conversation(files);
  ASSERT_TRUE(conversation) << name << ": " << to_string(conversation.error());
  const bool has_channel = !simulated.run.channels.empty();
  const Report report =
      examine(*conversation, INT64_MAX, has_channel ? &scenario.wireless : nullptr);
  EXPECT_EQ(report.storm, run.health == exact::Health::storm)
      << name << ": " << exact::name_of(run.health) << " " << run.needless << " "
      << run.took.count() << "; captured " << report.took.ratio() << " late "
      << report.took.is_late;
}

TEST(OneStorm, TheVerbsAgreeOnEveryShippedScenario) {
  std::size_t storms = 0;
  const auto names = model::config::SpecPath::standard().names(model::config::SpecKind::scenarios);
  ASSERT_GT(names.size(), 10U);
  for (const std::string& name : names) {
    model::Scenario scenario = props::shipped(name);
    scenario.run_until = model::RunUntil::completion;
    expect_agreement(name, scenario);
    trials::SampleOptions options;
    options.samples = 1;
    options.threads = 1;
    const auto samples = trials::sample_runs(scenario, options);
    ASSERT_EQ(samples.size(), 1U);
    const auto outlook = trials::outlook_of(samples);
    ASSERT_TRUE(outlook);
    if (outlook->health() == exact::Health::storm) ++storms;
  }
  EXPECT_GT(storms, 0U);
  EXPECT_LT(storms, names.size());
}

TEST(OneStorm, OneProcessOnEachHostAndTwoProcessesAreFine) {
  expect_agreement("one process", props::shipped("wifi-5x20-fastdds",
                                                 {"deployment.participants_per_host=1",
                                                  "deployment.endpoints_per_participant=100"}));
}

}  // namespace one_storm_test
}  // namespace stormproof::doctor
