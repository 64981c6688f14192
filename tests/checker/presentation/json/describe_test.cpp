// JSON by description: what becomes of each kind of member.
#include "checker/presentation/json/describe.hpp"

#include <array>
#include <limits>
#include <map>
#include <vector>

#include <gtest/gtest.h>

namespace stormproof::report {
namespace describe_test {

enum class Colour { red, green };

const char* name_of(Colour colour) { return colour == Colour::red ? "red" : "green"; }

struct Inner {
  int number = 1;
};

template <class V>
void describe(V& v, const Inner& inner) {
  v("number", inner.number);
}

struct Everything {
  std::optional<Inner> inner;
  std::vector<Inner> list{{1}, {2}};
  std::map<std::string, double, std::less<>> map{{"a", 0.5}};
};

template <class V>
void describe(V& v, const Everything& all) {
  v("inner", all.inner);
  v("list", all.list);
  v("map", all.map);
  v.unless_empty("absent", all.inner);
  v.unless_empty("nothing", std::string{});
  v.or_null("null", "");
  v.or_null("text", "x");
}

TEST(Describe, StructsBecomeObjects) {
  EXPECT_EQ(json_of(Everything{}).dump(),
            R"({"inner":null,"list":[{"number":1},{"number":2}],"map":{"a":0.5},)"
            R"("null":null,"text":"x"})");
  EXPECT_EQ(json_of(Everything{Inner{7}, {}, {}}).dump(),
            R"({"inner":{"number":7},"list":[],"map":{},"absent":{"number":7},)"
            R"("null":null,"text":"x"})");
}

TEST(Describe, NumbersThatAreNoneAreNull) {
  EXPECT_EQ(json_of(1.5).dump(), "1.5");
  EXPECT_TRUE(json_of(std::numeric_limits<double>::infinity()).is_null());
  EXPECT_TRUE(json_of(std::numeric_limits<double>::quiet_NaN()).is_null());
  EXPECT_EQ(json_of(std::vector<double>{1, std::nan("")}).dump(), "[1.0,null]");
  EXPECT_EQ(json_of(true).dump(), "true");
  EXPECT_EQ(json_of(std::uint64_t{18'446'744'073'709'551'615U}).dump(), "18446744073709551615");
}

TEST(Describe, TimesAreIntegersAndEnumsAreWords) {
  EXPECT_EQ(json_of(model::Nanoseconds{1'500}).dump(), "1500");
  EXPECT_EQ(json_of(std::optional<model::Nanoseconds>{}).dump(), "null");
  EXPECT_EQ(json_of(Colour::green).dump(), "\"green\"");
  EXPECT_EQ(json_of(std::map<Colour, int>{{Colour::red, 3}}).dump(), R"({"red":3})");
}

TEST(Describe, TextsPairsAndRanges) {
  EXPECT_EQ(json_of("literal").dump(), "\"literal\"");
  EXPECT_EQ(json_of(std::string_view{"view"}).dump(), "\"view\"");
  EXPECT_EQ(json_of(std::pair{1, std::string{"one"}}).dump(), R"([1,"one"])");
  EXPECT_EQ(json_of(std::array{1, 2, 3}).dump(), "[1,2,3]");
  EXPECT_EQ(json_of(std::vector<bool>{true, false}).dump(), "[true,false]");
  EXPECT_EQ(json_of(nlohmann::ordered_json{{"k", 1}}).dump(), R"({"k":1})");
}

TEST(Describe, PrintsWhatIsNoText) { EXPECT_EQ(dumped("\xff"), "\"\xef\xbf\xbd\"\n"); }

}  // namespace describe_test
}  // namespace stormproof::report
