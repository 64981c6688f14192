// The simulator against the oracle (tests/oracle: another author, another style, no shared code) on
// random scenarios that use every knob: the same events in the same order, the same outcome, the
// same missing descriptors. A seed that fails names its scenario: print it with
// config::effective_yaml.
#include "tests/oracle/oracle.hpp"

#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "model/reference.hpp"
#include "model/simulator.hpp"
#include "tests/oracle/random_scenario.hpp"

namespace stormproof {
namespace {

/// Time, class and insertion number of a processed event.
using EventKey = std::tuple<std::int64_t, int, std::uint64_t>;

class EventRecorder final : public model::Probe {
 public:
  void event_started(const model::Event& event) override {
    keys.emplace_back(event.time.count(), static_cast<int>(class_of(event.kind)),
                      event.insertion());
  }
  std::vector<EventKey> keys;
};

struct Observed {
  std::vector<EventKey> events;
  std::vector<std::int64_t> outcome;  ///< completion time or -1, the six counts, missing deliveries
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
  observed.outcome.push_back(static_cast<std::int64_t>(result.missing_count));
  for (const auto& m : result.missing) {
    observed.missing.emplace_back(m.source.value, m.destination.value, static_cast<int>(m.stream),
                                  m.descriptor.value);
  }
  return observed;
}

Observed run_oracle(const model::Scenario& scenario) {
  Observed observed;
  const oracle::Outcome o = oracle::run(scenario, [&](const oracle::LogEntry& entry) {
    observed.events.emplace_back(entry.time_ns, entry.event_class, entry.insertion);
  });
  observed.outcome = {
      o.t_disc_ns, o.initial_data,   o.repair_data,  o.heartbeat,
      o.acknack,   o.spdp_multicast, o.spdp_unicast, static_cast<std::int64_t>(o.missing.size())};
  for (const auto& m : o.missing) {
    if (observed.missing.size() == model::RunResult::missing_listed) break;
    observed.missing.emplace_back(m.source, m.destination, static_cast<int>(m.stream),
                                  m.descriptor);
  }
  return observed;
}

class AgainstOracle : public testing::TestWithParam<int> {};

TEST_P(AgainstOracle, SameEventsSameOutcome) {
  constexpr int scenarios = 100;
  for (int k = 0; k < scenarios; ++k) {
    const auto seed = static_cast<std::uint64_t>(scenarios * GetParam() + k);
    const model::Scenario scenario = oracle::random_scenario(seed);
    const Observed product = run_product(scenario);
    const Observed expected = run_oracle(scenario);
    ASSERT_EQ(product.outcome, expected.outcome) << "seed " << seed;
    ASSERT_EQ(product.missing, expected.missing) << "seed " << seed;
    ASSERT_TRUE(product.events == expected.events) << "other events, seed " << seed;
    if (scenario.wireless.kind == model::ServiceKind::shared_channel) {
      ASSERT_EQ(model::open_loop_airtime(scenario)->count(), oracle::open_loop_ns(scenario));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(RandomScenarios, AgainstOracle, testing::Range(0, 20));

}  // namespace
}  // namespace stormproof
