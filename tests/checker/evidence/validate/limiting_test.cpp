// What runs waited for: shares of one run, and which of the three is named.
#include "checker/evidence/validate/limiting.hpp"

#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "model/simulator.hpp"

namespace stormproof::validate {
namespace limiting_test {

using model::Nanoseconds;

TEST(Limiting, AShareIsThatOfTheWorst) {
  model::RunResult run;
  run.end_time = Nanoseconds{1'000};
  run.channels.push_back({"quiet", {Nanoseconds{10}}});
  run.channels.push_back({"busy", {Nanoseconds{300}, Nanoseconds{400}}});
  run.waiting.push_back({Nanoseconds{0}, Nanoseconds{250}});
  run.waiting.push_back({Nanoseconds{100}, Nanoseconds{0}});
  const Shares shares = shares_of(run);
  EXPECT_DOUBLE_EQ(shares.air, 0.7);
  EXPECT_DOUBLE_EQ(shares.sender, 0.1);
  EXPECT_DOUBLE_EQ(shares.processor, 0.25);
  EXPECT_DOUBLE_EQ(shares_of({}).air, 0);
}

TEST(Limiting, TheGreatestMedianIsNamedIfItIsHalfOfTheTime) {
  EXPECT_EQ(limiting({}).limit, Limit::none);
  EXPECT_EQ(limiting({{0.4, 0.4, 0.49}}).limit, Limit::none);
  EXPECT_EQ(limiting({{0.6, 0.9, 0.7}}).limit, Limit::sender);
  EXPECT_EQ(limiting({{0.9, 0.9, 0.7}}).limit, Limit::air);
  EXPECT_EQ(limiting({{0.1, 0, 0.5}}).limit, Limit::processor);
  const Limiting three = limiting({{0.9, 0, 0}, {0.2, 0, 0}, {0.3, 0, 0}});
  EXPECT_DOUBLE_EQ(three.median.air, 0.3);
  EXPECT_EQ(three.limit, Limit::none);
}

Limit of(std::vector<std::string> overrides) {
  const auto scenario = model::config::read_scenario("wifi-5x20-fastdds", overrides,
                                                     model::config::SpecPath::standard());
  EXPECT_TRUE(scenario) << to_string(scenario.error());
  return limiting({shares_of(model::simulate(*scenario))}).limit;
}

TEST(Limiting, RunsAreLimitedByWhatIsScarce) {
  EXPECT_EQ(of({}), Limit::air);
  EXPECT_EQ(of({"wireless=wired"}), Limit::none);
  EXPECT_EQ(of({"wireless=wired",
                "hosts={cores: 1, reception: 1ms, emission: 1ms, submessage: 0s, timer: 0s}"}),
            Limit::processor);
}

}  // namespace limiting_test
}  // namespace stormproof::validate
