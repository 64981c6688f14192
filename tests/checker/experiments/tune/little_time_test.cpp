// With little time a search makes less than half of the runs and cuts storms. The settings that it
// finds are as good as those of the whole search, under seeds that neither was chosen by. The clock
// is one of runs, so nothing depends on the machine.
#include <atomic>

#include <gtest/gtest.h>

#include "checker/experiments/statistics/completion.hpp"
#include "checker/experiments/statistics/quantiles.hpp"
#include "checker/experiments/trials/sample_runs.hpp"
#include "checker/experiments/tune/tune.hpp"

namespace stormproof::tune {
namespace little_time_test {

const model::config::SpecPath specs{{STORMPROOF_SPECS_DIR}};

struct Fleet {
  const char* name;
  const char* scenario;
  std::vector<std::string> changes;
  std::size_t runs_in_time;
};

/// Fleets whose discovery storms as they are.
const std::vector<Fleet> fleets{
    {"TwoHostsOverAnAccessPoint",
     "live-5x20",
     {"deployment.participants_per_host=3", "time_limit=20s"},
     300},
    {"TwoRobotsOverWifi",
     "wifi-5x20-fastdds",
     {"deployment.participants_per_host=3", "time_limit=30s"},
     800},
    {"FourRobotsOneAfterTheOther", "fleet-4x2x20", {"time_limit=30s"}, 300}};

class TuneInLittleTime : public testing::TestWithParam<Fleet> {};

constexpr model::Nanoseconds jitter{10'000'000};

/// The median completion with what is recommended, under new seeds.
double completion_with(const Report& report, const Subject& subject) {
  if (!report.recommended) {
    ADD_FAILURE() << "nothing is recommended";
    return statistics::unreached;
  }
  const Row& best = report.rows[*report.recommended];
  trials::Runner runner;
  const auto samples = trials::present(runner.run(24, [&](std::size_t k) {
    return trials::sample_run(runner, best.scenario, 9'000'000 + k,
                              model::is_drawn(subject.scenario) ? model::Nanoseconds{} : jitter,
                              best.plan);
  }));
  std::vector<double> completion;
  for (const trials::Sample& run : samples) {
    completion.push_back(statistics::completion_ns(run.discovery_time));
  }
  return statistics::median(std::move(completion));
}

TEST_P(TuneInLittleTime, FindsSettingsAsGood) {
  auto subject = read_subject(GetParam().scenario, GetParam().changes, "", specs);
  ASSERT_TRUE(subject) << to_string(subject.error());
  Options options;
  options.samples = 12;
  if (!model::is_drawn(subject->scenario)) options.start_jitter = jitter;
  const auto whole = tune(*subject, options);
  ASSERT_TRUE(whole) << to_string(whole.error());
  std::atomic<std::size_t> made = 0;
  options.on_progress = [&made](std::string_view, std::size_t runs, std::size_t) {
    made = runs;
    return true;
  };
  options.time = trials::Budget{[&made] {
    return std::optional{static_cast<double>(GetParam().runs_in_time) - static_cast<double>(made)};
  }};
  const auto little = tune(*subject, options);
  ASSERT_TRUE(little) << to_string(little.error());
  EXPECT_TRUE(little->unasked.lacked_time());
  EXPECT_LT(little->runs * 2, whole->runs);
  ASSERT_EQ(little->answer, Answer::better);
  EXPECT_LE(completion_with(*little, *subject), 1.05 * completion_with(*whole, *subject));
}

INSTANTIATE_TEST_SUITE_P(Fleets, TuneInLittleTime, testing::ValuesIn(fleets),
                         [](const auto& one) { return std::string{one.param.name}; });

}  // namespace little_time_test
}  // namespace stormproof::tune
