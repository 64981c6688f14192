// The simulator of `implementation: fastdds` against its oracle (tests/oracle: another author,
// another style, no shared code) on random scenarios: the same number of events, of the same
// classes at the same times, the same outcome, the same missing descriptors. A seed that fails
// names its scenario: print it with config::effective_yaml.
#include "tests/oracle/fastdds_oracle.hpp"

#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "model/simulator.hpp"
#include "tests/oracle/random_fastdds_scenario.hpp"

namespace stormproof {
namespace {

/// Time and class of a processed event.
using EventKey = std::pair<std::int64_t, int>;

class EventRecorder final : public model::Probe {
 public:
  void event_started(const model::Event& event) override {
    keys.emplace_back(event.time.count(), static_cast<int>(class_of(event.kind)));
  }
  std::vector<EventKey> keys;
};

struct Observed {
  std::vector<EventKey> events;
  /// Completion time or -1, the six counts, control traffic, number of events, missing deliveries.
  std::vector<std::int64_t> outcome;
  std::vector<std::tuple<std::uint32_t, std::uint32_t, int, std::uint32_t>> missing;
};

Observed run_product(const model::Scenario& scenario) {
  EventRecorder recorder;
  model::RunOptions options;
  options.probe = &recorder;
  const model::RunResult result = model::simulate(scenario, options);
  Observed observed{std::move(recorder.keys), {}, {}};
  observed.outcome.push_back(result.discovery_time ? result.discovery_time->count() : -1);
  for (const auto& entry : result.counts.entries()) {
    observed.outcome.push_back(static_cast<std::int64_t>(entry.value));
  }
  observed.outcome.push_back(static_cast<std::int64_t>(result.user_control));
  observed.outcome.push_back(static_cast<std::int64_t>(result.events));
  observed.outcome.push_back(static_cast<std::int64_t>(result.missing_count));
  for (const auto& m : result.missing) {
    observed.missing.emplace_back(m.source.value, m.destination.value, static_cast<int>(m.stream),
                                  m.descriptor.value);
  }
  return observed;
}

Observed run_oracle(const model::Scenario& scenario) {
  Observed observed;
  const oracle::FastddsOutcome o =
      oracle::run_fastdds(scenario, [&](const oracle::LogEntry& entry) {
        observed.events.emplace_back(entry.time_ns, entry.event_class);
      });
  observed.outcome = {o.t_disc_ns,
                      o.initial_data,
                      o.repair_data,
                      o.heartbeat,
                      o.acknack,
                      o.spdp_multicast,
                      o.spdp_unicast,
                      o.user_control,
                      static_cast<std::int64_t>(o.events),
                      static_cast<std::int64_t>(o.missing.size())};
  for (const auto& m : o.missing) {
    if (observed.missing.size() == model::RunResult::missing_listed) break;
    observed.missing.emplace_back(m.source, m.destination, static_cast<int>(m.stream),
                                  m.descriptor);
  }
  return observed;
}

class AgainstFastddsOracle : public testing::TestWithParam<int> {};

TEST_P(AgainstFastddsOracle, SameEventsSameOutcome) {
  constexpr int scenarios = 100;
  for (int k = 0; k < scenarios; ++k) {
    const auto seed = static_cast<std::uint64_t>(scenarios * GetParam() + k);
    model::Scenario scenario = oracle::random_fastdds_scenario(seed);
    scenario.dds.implementation = model::ImplementationKind::fastdds;
    const Observed product = run_product(scenario);
    const Observed expected = run_oracle(scenario);
    ASSERT_EQ(product.outcome, expected.outcome) << "seed " << seed;
    ASSERT_EQ(product.missing, expected.missing) << "seed " << seed;
    ASSERT_TRUE(product.events == expected.events) << "other events, seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(RandomScenarios, AgainstFastddsOracle, testing::Range(0, 15));

}  // namespace
}  // namespace stormproof
