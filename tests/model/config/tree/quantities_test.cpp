// Laws and examples of exact decimal parsing and printing.
#include "model/config/tree/quantities.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace stormproof::model::config {
namespace quantities_test {

std::int64_t ns(const char* text) {
  const auto parsed = parse_duration(text);
  EXPECT_TRUE(parsed) << text;
  return parsed ? parsed->count() : -1;
}

std::string wrong_duration(const std::string& text) {
  const auto parsed = parse_duration(text);
  return parsed ? "accepted" : parsed.error();
}

RC_GTEST_PROP(Quantities, durations_survive_printing, ()) {
  const auto count = *rc::gen::inRange<std::int64_t>(0, std::numeric_limits<std::int64_t>::max());
  const std::string text = print_duration(Nanoseconds{count});
  const auto parsed = parse_duration(text);
  RC_ASSERT((parsed && parsed->count() == count));
}

RC_GTEST_PROP(Quantities, round_durations_survive_printing, (std::uint32_t digits)) {
  std::int64_t count = digits;
  for (int zeros = *rc::gen::inRange(0, 9); zeros > 0; --zeros) count *= 10;
  const auto parsed = parse_duration(print_duration(Nanoseconds{count}));
  RC_ASSERT((parsed && parsed->count() == count));
}

RC_GTEST_PROP(Quantities, rates_survive_printing, ()) {
  const auto count = *rc::gen::inRange<std::int64_t>(0, std::numeric_limits<std::int64_t>::max());
  const auto parsed = parse_rate(print_rate(BitsPerSecond{count}));
  RC_ASSERT((parsed && parsed->count() == count));
}

RC_GTEST_PROP(Quantities, fractions_survive_printing, ()) {
  const auto numerator = *rc::gen::inRange<std::int64_t>(1, 1'000'000'000);
  const auto denominator = *rc::gen::inRange<std::int64_t>(1, 1'000'000'000);
  const auto reduced = parse_fraction(print_fraction({numerator, denominator}));
  RC_ASSERT(reduced);
  RC_ASSERT(reduced->numerator * denominator == numerator * reduced->denominator);
  const auto again = parse_fraction(print_fraction(*reduced));
  RC_ASSERT((again && *again == *reduced));
}

RC_GTEST_PROP(Quantities, no_text_is_more_than_refused, (const std::string& text)) {
  for (const auto& parsed : {parse_duration(text), parse_duration(text + "ns")}) {
    RC_ASSERT((!parsed || parsed->count() >= 0));
  }
  (void)parse_rate(text);
  (void)parse_count(text);
  (void)parse_fraction(text);
}

TEST(Quantities, durations_are_exact) {
  EXPECT_EQ(ns("0"), 0);
  EXPECT_EQ(ns("0s"), 0);
  EXPECT_EQ(ns("1ns"), 1);
  EXPECT_EQ(ns("194.5us"), 194'500);
  EXPECT_EQ(ns("0.000000001s"), 1);
  EXPECT_EQ(ns("1.500s"), 1'500'000'000);
  EXPECT_EQ(ns("1.0000000000000000000s"), 1'000'000'000);
  EXPECT_EQ(ns("9223372036854775807ns"), 9'223'372'036'854'775'807);
}

TEST(Quantities, wrong_durations_say_why) {
  EXPECT_EQ(wrong_duration("5"), "'5' has no unit (ns, us, ms, s)");
  EXPECT_EQ(wrong_duration("1.5"), "'1.5' has no unit (ns, us, ms, s)");
  EXPECT_EQ(wrong_duration("5min"), "'5min' has the unknown unit 'min' (known: ns, us, ms, s)");
  EXPECT_EQ(wrong_duration("1.5ns"), "'1.5ns' is not a whole number of ns");
  EXPECT_EQ(wrong_duration("0.0000000001s"), "'0.0000000001s' is not a whole number of ns");
  EXPECT_EQ(wrong_duration("-5ms"), "'-5ms' is negative");
  EXPECT_EQ(wrong_duration("9223372036854775808ns"), "'9223372036854775808ns' is too large");
  EXPECT_EQ(wrong_duration("9223372037s"), "'9223372037s' is too large");
  for (const char* text :
       {"", "s", ".5s", "1.s", "1..5s", "+1s", "01s", "0x1s", "1e3s", " 1s", "one"}) {
    EXPECT_NE(wrong_duration(text), "accepted") << text;
  }
}

TEST(Quantities, rates_and_counts) {
  EXPECT_EQ(parse_rate("144.4Mbps")->count(), 144'400'000);
  EXPECT_EQ(parse_rate("1Gbps")->count(), 1'000'000'000);
  EXPECT_EQ(parse_rate("1.2345kbps").error(), "'1.2345kbps' is not a whole number of bps");
  EXPECT_EQ(parse_rate("6").error(), "'6' has no unit (bps, kbps, Mbps, Gbps)");
  EXPECT_EQ(*parse_count("65500"), 65'500);
  for (const char* text : {"", "1.0", "1.5", "1kB", "0x10", "007", "1_000", "1,000"}) {
    EXPECT_FALSE(parse_count(text)) << text;
  }
}

TEST(Quantities, fractions_are_reduced) {
  EXPECT_EQ(*parse_fraction("0.05"), (Fraction{1, 20}));
  EXPECT_EQ(*parse_fraction("5/100"), (Fraction{1, 20}));
  EXPECT_EQ(*parse_fraction("1.0"), (Fraction{1, 1}));
  EXPECT_EQ(parse_fraction("0.0").error(), "'0.0' is not greater than 0");
  for (const char* text :
       {"1/0", "/2", "1/", "1/2/3", "a", "-1/2", "5%", "0.0000000000000000001"}) {
    EXPECT_FALSE(parse_fraction(text)) << text;
  }
}

TEST(Quantities, printing_is_short) {
  EXPECT_EQ(print_duration(Nanoseconds{0}), "0s");
  EXPECT_EQ(print_duration(Nanoseconds{100'000}), "100us");
  EXPECT_EQ(print_duration(Nanoseconds{100'000'000}), "100ms");
  EXPECT_EQ(print_duration(Nanoseconds{194'500}), "194.5us");
  EXPECT_EQ(print_duration(Nanoseconds{1'500'000'000}), "1.5s");
  EXPECT_EQ(print_duration(Nanoseconds{1'000'001}), "1000001ns");
  EXPECT_EQ(print_rate(BitsPerSecond{144'400'000}), "144.4Mbps");
  EXPECT_EQ(print_rate(BitsPerSecond{1}), "1bps");
}

TEST(Quantities, SharesHaveThreeSpellings) {
  for (const char* text : {"2%", "2 %", "0.02", "1/50", "2.0%"}) {
    const auto share = parse_share(text);
    ASSERT_TRUE(share) << text;
    EXPECT_EQ(*share, (Fraction{1, 50})) << text;
  }
  for (const char* text : {"0", "0%"}) {
    const auto none = parse_share(text);
    ASSERT_TRUE(none) << text;
    EXPECT_EQ(none->value(), 0);
  }
  EXPECT_EQ(*parse_share("150%"), (Fraction{3, 2}));
  for (const char* text : {"", "%", "-1%", "2%%", "two", "1/0", "0.5 ", "0.00000000000000001%"}) {
    EXPECT_FALSE(parse_share(text)) << text;
  }
}

}  // namespace quantities_test
}  // namespace stormproof::model::config
