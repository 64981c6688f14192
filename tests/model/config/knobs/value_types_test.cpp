// Each kind of value reads what it wrote and refuses the rest; names in files belong to the right
// enumerators.
#include "model/config/knobs/value_types.hpp"

#include <gtest/gtest.h>

#include "model/config/knobs/dds_knobs.hpp"
#include "model/config/knobs/value_json.hpp"
#include "model/config/knobs/wireless_knobs.hpp"
#include "model/config/tree/yaml_text.hpp"

namespace stormproof::model::config {
namespace value_types_test {

static_assert(name_of(ImplementationKind::fastdds) == "fastdds");
static_assert(name_of(SpdpResend::all_known) == "all_known" && name_of(SpdpResend::none) == "none");
static_assert(name_of(SpdpResend::new_and_multicast) == "new_and_multicast");
static_assert(name_of(SpdpResend::new_only) == "new_only");
static_assert(name_of(RelationOpening::each_side) == "each_side");
static_assert(name_of(InitialData::pull) == "pull");
static_assert(name_of(Unmatched::accept) == "accept");
static_assert(name_of(InitialAckNackReply::heartbeat) == "heartbeat");
static_assert(name_of(InitialAckNackReply::none) == "none");
static_assert(name_of(Acknowledge::prefix) == "prefix");
static_assert(name_of(HeartbeatTimerKind::additive) == "additive");
static_assert(name_of(HeartbeatRecipients::matched) == "matched");
static_assert(name_of(HeartbeatPolicy::adaptive) == "adaptive");
static_assert(name_of(Grouping::mtu) == "mtu" && name_of(Grouping::single) == "single");
static_assert(name_of(Piggyback::linear) == "linear" && name_of(Piggyback::off) == "off");
static_assert(name_of(ServiceKind::constant_delay) == "constant_delay");
static_assert(name_of(ServiceOrder::fifo_downlink) == "fifo_downlink");
static_assert(name_of(ServiceOrder::fifo) == "fifo");
static_assert(name_of(ServiceOrder::datagram_uplink) == "datagram_uplink");
static_assert(name_of(FragmentRequest::at_admission) == "at_admission");
static_assert(name_of(MulticastAs::multicast) == "multicast");

Node node(const std::string& text) {
  auto parsed = parse_yaml(text, "f");
  EXPECT_TRUE(parsed) << text;
  return parsed ? *parsed : Node{};
}

template <class Value>
std::string complaint(const auto& type, const std::string& text, Value& value) {
  const Complaint wrong = type.read(node(text), value);
  return wrong ? wrong->place.to_string() + ": " + wrong->reason : "";
}

TEST(ValueTypes, numbers_have_ranges) {
  std::uint32_t value = 0;
  const NumberType type = count_range(2, 10);
  EXPECT_EQ(complaint(type, "10", value), "");
  EXPECT_EQ(value, 10U);
  EXPECT_EQ(complaint(type, "11", value), "f:1:1: '11' is out of range");
  EXPECT_EQ(complaint(type, "'5'", value), "f:1:1: '5' in quotes is text");
  EXPECT_EQ(complaint(type, "[5]", value), "f:1:1: a list is not a number");
  EXPECT_EQ(value, 10U);
  EXPECT_EQ(type.expected(), "an integer from 2 to 10");
}

TEST(ValueTypes, zero_is_no_period) {
  Nanoseconds value;
  EXPECT_EQ(complaint(delay_range, "0", value), "");
  EXPECT_EQ(complaint(period_range, "0", value), "f:1:1: '0' is out of range");
  EXPECT_EQ(complaint(delay_range, "1000000s", value), "");
  EXPECT_EQ(complaint(delay_range, "1000000.000000001s", value),
            "f:1:1: '1000000.000000001s' is out of range");
}

TEST(ValueTypes, choices_suggest) {
  Piggyback value = Piggyback::cumulative;
  EXPECT_EQ(complaint(ChoiceType<Piggyback>{}, "off", value), "");
  EXPECT_EQ(value, Piggyback::off);
  EXPECT_EQ(complaint(ChoiceType<Piggyback>{}, "liner", value),
            "f:1:1: 'liner' is not known; did you mean 'linear'?");
  EXPECT_EQ(complaint(ChoiceType<Piggyback>{}, "~", value), "f:1:1: nothing is not a word");
}

TEST(ValueTypes, number_sets_are_sorted_without_duplicates) {
  std::vector<std::uint64_t> value;
  const NumberSetType type{count_range(0, 100)};
  EXPECT_EQ(complaint(type, "[41, 3, 40, 3]", value), "");
  EXPECT_EQ(value, (std::vector<std::uint64_t>{3, 40, 41}));
  EXPECT_EQ(complaint(type, "[1, 2, 101]", value), "f:1:8: '101' is out of range");
  EXPECT_EQ(complaint(type, "5", value), "f:1:1: '5' is not a list");
}

TEST(ValueTypes, bytes_or_a_word) {
  Bytes value;
  const BytesOrWordType type{byte_range(1, 1000), "unlimited", WirelessProfile::unlimited};
  EXPECT_EQ(complaint(type, "unlimited", value), "");
  EXPECT_EQ(value, WirelessProfile::unlimited);
  EXPECT_EQ(json_of(type, value), Json("unlimited"));
  EXPECT_EQ(json_of(type, Bytes{7}), Json(7));
  EXPECT_EQ(complaint(type, "unlimted", value),
            "f:1:1: 'unlimted' is not an integer in plain decimal digits");
}

TEST(ValueTypes, fractions_are_bounded) {
  std::int64_t numerator = 0;
  std::int64_t denominator = 0;
  FractionParts parts{numerator, denominator};
  const FractionType type{1000};
  EXPECT_FALSE(type.read(node("0.05"), parts));
  EXPECT_EQ(numerator, 1);
  EXPECT_EQ(denominator, 20);
  EXPECT_EQ(type.read(node("3/2"), parts)->reason, "'3/2' = 3/2 is out of range");
  EXPECT_EQ(type.read(node("0.0001"), parts)->reason, "'0.0001' = 1/10000 is out of range");
  EXPECT_EQ(type.read(node("0"), parts)->reason, "'0' is not greater than 0");
}

TEST(ValueTypes, pairs_have_two_elements) {
  std::array<Bytes, 2> value;
  const BytesPairType type{packet_bytes};
  EXPECT_EQ(complaint(type, "[532, 452]", value), "");
  EXPECT_EQ(json_of(type, value).dump(), "[532,452]");
  EXPECT_EQ(complaint(type, "[1, 2, 3]", value), "f:1:1: a list of 3");
  EXPECT_EQ(complaint(type, "[1, x]", value),
            "f:1:5: 'x' is not an integer in plain decimal digits");
}

TEST(ValueTypes, seeds_have_64_bits) {
  std::uint64_t value = 0;
  EXPECT_EQ(complaint(SeedType{}, "18446744073709551615", value), "");
  EXPECT_EQ(value, 18'446'744'073'709'551'615ULL);
  EXPECT_EQ(json_of(SeedType{}, value).dump(), "18446744073709551615");
  EXPECT_EQ(complaint(SeedType{}, "0", value), "");
  EXPECT_EQ(value, 0U);
  EXPECT_EQ(complaint(SeedType{}, "18446744073709551616", value),
            "f:1:1: '18446744073709551616' is too large");
  EXPECT_EQ(complaint(SeedType{}, "-1", value), "f:1:1: '-1' is negative");
  for (const char* text : {"1.5", "07", "0x1", "seed", "+1", "''"}) {
    EXPECT_NE(complaint(SeedType{}, text, value), "") << text;
  }
  EXPECT_EQ(complaint(SeedType{}, "'5'", value), "f:1:1: '5' in quotes is text");
  EXPECT_EQ(complaint(SeedType{}, "[5]", value), "f:1:1: a list is not a number");
}

TEST(ValueTypes, ranges_do_not_run_backwards) {
  Nanoseconds low;
  Nanoseconds high;
  RangeParts parts{low, high};
  const DurationRangeType type{delay_range};
  EXPECT_FALSE(type.read(node("[1ms, 1ms]"), parts));
  EXPECT_EQ(json_of(type, {low, high}).dump(), R"(["1ms","1ms"])");
  EXPECT_EQ(complaint(type, "[2ms, 1ms]", parts), "f:1:1: '2ms' is more than '1ms'");
  EXPECT_EQ(complaint(type, "[1ms]", parts), "f:1:1: a list of 1");
  EXPECT_EQ(complaint(type, "1ms", parts), "f:1:1: '1ms' is not a list");
  EXPECT_EQ(complaint(type, "[0, 5]", parts), "f:1:5: '5' has no unit (ns, us, ms, s)");
  EXPECT_EQ(complaint(type, "[-1s, 0]", parts), "f:1:2: '-1s' is negative");
}

TEST(ValueTypes, text_is_one_line) {
  std::string value;
  EXPECT_EQ(complaint(TextType{}, "air", value), "");
  EXPECT_EQ(complaint(TextType{}, "''", value), "f:1:1: '' is empty");
  EXPECT_EQ(complaint(TextType{}, "\"a\\nb\"", value), "f:1:1: 'a\\x0ab' has control characters");
  EXPECT_EQ(complaint(TextType{}, "{a: b}", value), "f:1:1: a map is not text");
}

}  // namespace value_types_test
}  // namespace stormproof::model::config
