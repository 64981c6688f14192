// Parsing of hostile lines, and the first difference of two values.
#include "model/trace/trace_json.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stormproof::model::trace {
namespace trace_json_test {

std::string difference(const char* recorded, const char* replayed) {
  const auto found = first_difference(Json::parse(recorded), Json::parse(replayed));
  if (!found) return "equal";
  return found->key + ": " + found->recorded + " / " + found->replayed;
}

TEST(TraceJson, ParsesOneValue) {
  EXPECT_EQ(parse_line(R"({"a":[1,{"b":null}]})"), Json::parse(R"({"a":[1,{"b":null}]})"));
  for (const char* bad : {"", "{", "{}{}", "{\"a\":}", "\xff", "{\"a\":1,}", "nul"}) {
    EXPECT_FALSE(parse_line(bad)) << bad;
  }
}

TEST(TraceJson, RefusesDeepNesting) {
  EXPECT_TRUE(parse_line(std::string(32, '[') + std::string(32, ']')));
  EXPECT_FALSE(parse_line(std::string(34, '[') + std::string(34, ']')));
  EXPECT_FALSE(parse_line(std::string(5'000'000, '[')));
}

TEST(TraceJson, EqualValuesDoNotDiffer) {
  EXPECT_EQ(difference("{}", "{}"), "equal");
  EXPECT_EQ(difference(R"({"a":1,"b":[2]})", R"({ "b": [2], "a": 1 })"), "equal");
}

TEST(TraceJson, TheFirstDifferenceHasItsPath) {
  EXPECT_EQ(difference(R"({"a":1,"b":2,"c":3})", R"({"a":1,"b":4,"c":5})"), "b: 2 / 4");
  EXPECT_EQ(difference(R"({"a":[{"b":1},{"b":2}]})", R"({"a":[{"b":1},{"b":3}]})"), "a.1.b: 2 / 3");
  EXPECT_EQ(difference("1", "\"1\""), ": 1 / \"1\"");
}

TEST(TraceJson, WhatIsNotThereIsAbsent) {
  EXPECT_EQ(difference(R"({"a":1})", R"({"b":2})"), "a: 1 / absent");
  EXPECT_EQ(difference(R"({})", R"({"b":2})"), "b: absent / 2");
  EXPECT_EQ(difference(R"({"a":[1]})", R"({"a":[1,2]})"), "a.1: absent / 2");
  EXPECT_EQ(difference(R"({"a":null})", R"({})"), "a: null / absent");
}

TEST(TraceJson, LongValuesAreCut) {
  const Json recorded{{"a", std::string(10'000, 'x')}};
  const auto found = first_difference(recorded, Json::object());
  ASSERT_TRUE(found);
  EXPECT_LT(found->recorded.size(), 500U);
}

}  // namespace trace_json_test
}  // namespace stormproof::model::trace
