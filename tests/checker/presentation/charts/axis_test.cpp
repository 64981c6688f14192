// Ticks at round values, labels with SI prefixes, and ranges that hold the data whatever it is.
#include "checker/presentation/charts/axis.hpp"

#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

namespace stormproof::plot {
namespace axis_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

ScaledAxis axis_of(const Axis& axis, std::initializer_list<double> values, double wanted = 6) {
  DataRange range{axis.scale};
  for (const double value : values) range.add(value);
  return ScaledAxis{axis, range, wanted};
}

std::vector<std::string> texts(const ScaledAxis& axis) {
  std::vector<std::string> result;
  for (const Tick& tick : axis.ticks()) result.push_back(tick.text);
  return result;
}

Axis linear(std::string unit) { return {"", Scale::linear, {}, {}, std::move(unit), {}}; }
Axis logarithmic(std::string unit) { return {"", Scale::log, {}, {}, std::move(unit), {}}; }

TEST(SiText, ChoosesThePrefixThatFits) {
  EXPECT_EQ(si_text(0.0125, "s"), "12.5 ms");
  EXPECT_EQ(si_text(6.263, "s"), "6.26 s");
  EXPECT_EQ(si_text(1e-6, "s"), "1 µs");
  EXPECT_EQ(si_text(144.4e6, "bit/s"), "144 Mbit/s");
  EXPECT_EQ(si_text(-2500, ""), "-2.5k");
  EXPECT_EQ(si_text(1, ""), "1");
  EXPECT_EQ(si_text(0, "s"), "0 s");
}

TEST(SiText, RoundsBeforeItChooses) {
  EXPECT_EQ(si_text(0.9999, "s"), "1 s");
  EXPECT_EQ(si_text(999.9, ""), "1k");
  EXPECT_EQ(si_text(999.4, ""), "999");
}

TEST(SiText, NamesWhatIsNoNumber) {
  EXPECT_EQ(si_text(nan, "s"), "–");
  EXPECT_EQ(si_text(infinity, "s"), "–");
}

TEST(LinearAxis, HasRoundTicksWithOnePrefix) {
  const ScaledAxis axis = axis_of(linear("s"), {0.0, 0.3, 1.9});
  EXPECT_EQ(texts(axis), (std::vector<std::string>{"0", "0.5 s", "1 s", "1.5 s", "2 s"}));
  EXPECT_EQ(axis.low(), 0);
  EXPECT_EQ(axis.high(), 2);
}

TEST(LinearAxis, StartsAtZeroUnlessThatWastesHalf) {
  EXPECT_EQ(axis_of(linear(""), {40.0, 100.0}).low(), 0);
  EXPECT_EQ(axis_of(linear(""), {90.0, 100.0}).low(), 90);
}

TEST(LinearAxis, TellsCloseTicksApart) {
  const ScaledAxis axis = axis_of(linear(""), {100'000.0, 100'003.0});
  const std::vector<std::string> labels = texts(axis);
  EXPECT_GE(labels.size(), 3U);
  EXPECT_EQ(std::set<std::string>(labels.begin(), labels.end()).size(), labels.size());
}

TEST(LinearAxis, KeepsAGivenRange) {
  Axis axis = linear("");
  axis.min = -3;
  axis.max = 17;
  const ScaledAxis scaled = axis_of(axis, {0.0, 100.0});
  EXPECT_EQ(scaled.low(), -3);
  EXPECT_EQ(scaled.high(), 17);
  EXPECT_TRUE(scaled.contains(17));
  EXPECT_FALSE(scaled.contains(18));
}

TEST(LogAxis, HasDecadesAsTicks) {
  const ScaledAxis axis = axis_of(logarithmic("s"), {0.0012, 8.0}, 6);
  EXPECT_EQ(texts(axis), (std::vector<std::string>{"1 ms", "10 ms", "100 ms", "1 s", "10 s"}));
  EXPECT_EQ(axis.low(), 0.001);
  EXPECT_EQ(axis.high(), 10);
  EXPECT_NEAR(axis.fraction(0.1), 0.5, 1e-12);
}

TEST(LogAxis, HasOneTwoFiveWhereDecadesAreFew) {
  const ScaledAxis axis = axis_of(logarithmic(""), {1.1, 9.0});
  EXPECT_EQ(texts(axis), (std::vector<std::string>{"1", "2", "5", "10"}));
}

TEST(LogAxis, LeavesOutDecadesWithoutRoom) {
  const ScaledAxis axis = axis_of(logarithmic(""), {1e-15, 1e15}, 6);
  EXPECT_LE(axis.ticks().size(), 7U);
  EXPECT_GE(axis.ticks().size(), 4U);
}

TEST(LogAxis, IgnoresWhatHasNoLogarithm) {
  const ScaledAxis axis = axis_of(logarithmic(""), {0.0, -5.0, nan, 2.0, 30.0});
  EXPECT_EQ(axis.low(), 2);
  EXPECT_EQ(axis.high(), 50);
  EXPECT_FALSE(axis.contains(0));
  EXPECT_FALSE(axis.contains(-5));
}

TEST(EveryAxis, HoldsItsDataWhateverItIs) {
  const std::vector<std::vector<double>> cases{{},
                                               {0.0},
                                               {5.0},
                                               {-1.0},
                                               {nan, infinity},
                                               {1e-300, 1e299},
                                               {-1e299, 1e299},
                                               {1e15, 1e15 + 1},
                                               {1e-12, 2e-12},
                                               {0.999999, 1.000001}};
  for (const Scale scale : {Scale::linear, Scale::log}) {
    for (const std::vector<double>& values : cases) {
      DataRange range{scale};
      for (const double value : values) range.add(value);
      const ScaledAxis axis{Axis{"", scale, {}, {}, "s", {}}, range, 6};
      EXPECT_LT(axis.low(), axis.high());
      EXPECT_LE(axis.ticks().size(), 60U);
      for (const double value : values) {
        EXPECT_EQ(drawable(value, scale), axis.contains(value)) << value;
      }
      for (const Tick& tick : axis.ticks()) {
        EXPECT_TRUE(axis.contains(tick.value)) << tick.value;
        EXPECT_EQ(tick.text.find("nan"), std::string::npos);
      }
    }
  }
}

}  // namespace axis_test
}  // namespace stormproof::plot
