// Integers, exact microseconds, lists and strings.
#include "model/trace/json_text.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace stormproof::model::trace {
namespace json_text_test {

std::string microseconds(std::int64_t ns) {
  std::string text;
  append_microseconds(text, Nanoseconds{ns});
  return text;
}

std::string members(const std::vector<std::uint64_t>& words) {
  std::string text;
  append_members(text, Words{words});
  return text;
}

TEST(JsonText, AppendsTextsAndIntegers) {
  std::string text = "x";
  append(text, "a", 17, std::string_view{"b"}, std::numeric_limits<std::int64_t>::min(), "",
         std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(text, "xa17b-922337203685477580818446744073709551615");
}

TEST(JsonText, MicrosecondsHaveThreeDecimals) {
  EXPECT_EQ(microseconds(0), "0.000");
  EXPECT_EQ(microseconds(7), "0.007");
  EXPECT_EQ(microseconds(42), "0.042");
  EXPECT_EQ(microseconds(999), "0.999");
  EXPECT_EQ(microseconds(16'136'228), "16136.228");
  EXPECT_EQ(microseconds(200'000'000'000), "200000000.000");
}

TEST(JsonText, MembersAreListedAscending) {
  EXPECT_EQ(members({}), "[]");
  EXPECT_EQ(members({0, 0}), "[]");
  EXPECT_EQ(members({0b1001}), "[0,3]");
  EXPECT_EQ(members({1ULL << 63U, 0, 1}), "[63,128]");
}

TEST(JsonText, StringsAreEscapedAndAlwaysUtf8) {
  EXPECT_EQ(json_string("air"), R"("air")");
  EXPECT_EQ(json_string("a\"\\\n"), R"("a\"\\\n")");
  EXPECT_EQ(json_string("\xff"), "\"\xef\xbf\xbd\"");
}

}  // namespace json_text_test
}  // namespace stormproof::model::trace
