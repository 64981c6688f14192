// The completion bound is exact: for drawn timers the worst case runs through the machines and
// takes exactly B.
#include "checker/engines/timeline/completion_witness.hpp"
#include "tests/checker/engines/timeline/drawn_runs.hpp"

namespace stormproof::timeline {
namespace worst_case_test {

TEST(WorstCase, TakesExactlyTheBound) {
  STORMPROOF_DRAWN("completion of the worst case = B", [] {
    Setting setting;
    model::SedpProfile& sedp = setting.dds.sedp;
    sedp = drawn_timers();
    Circumstances c;
    c.delta = drawn_time(1, 12);
    c.least = drawn_time(1, c.delta.count());
    c.source = drawn_time(0, c.delta.count());
    c.timer_starts_with_relation = *rc::gen::arbitrary<bool>();
    RC_PRE(is_attained(sedp, c.delta));
    if (!c.timer_starts_with_relation) setting.phase = worst_phase(sedp, c);
    const auto losses = *rc::gen::inRange(0U, 6U);
    const auto run = direct(setting, worst_completion(sedp, c, losses));
    RC_ASSERT(run.has_value());
    RC_ASSERT(run->completion == completion_bound(setting.dds, c)->after(losses));
  });
}

TEST(WorstCase, InitialAckNacksMakeItShorter) {
  Setting setting;
  model::SedpProfile& sedp = setting.dds.sedp;
  sedp.initial_acknack_delay = model::Nanoseconds{100'000};
  Circumstances c;
  c.delta = model::Nanoseconds{1'000'000};
  c.least = model::Nanoseconds{1};
  c.timer_starts_with_relation = true;
  ASSERT_FALSE(is_attained(sedp, c.delta));
  const auto run = direct(setting, worst_completion(sedp, c, 1));
  ASSERT_TRUE(run && run->completion);
  EXPECT_LT(*run->completion, *completion_bound(setting.dds, c)->after(1));
}

TEST(WorstCase, PhaseLiesWithinThePeriod) {
  model::SedpProfile sedp;
  for (const std::int64_t ms : {1, 300, 400, 2'000}) {
    const Circumstances c{model::Nanoseconds{ms * 1'000'000}, std::nullopt, false, {}};
    EXPECT_GE(worst_phase(sedp, c), model::Nanoseconds{0});
    EXPECT_LT(worst_phase(sedp, c), sedp.heartbeat_period);
  }
}

}  // namespace worst_case_test
}  // namespace stormproof::timeline
