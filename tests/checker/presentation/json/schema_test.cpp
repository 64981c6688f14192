// JSON Schema by description: what becomes of each kind of member, and that it allows what the
// description prints and nothing else.
#include "checker/presentation/json/schema.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "tests/checker/presentation/json/schema_errors.hpp"

namespace stormproof::report {
namespace schema_test {

using Json = nlohmann::ordered_json;

enum class Colour : std::uint8_t { red, green = 4 };

const char* name_of(Colour colour) { return colour == Colour::red ? "red" : "green"; }

struct Inner {
  std::uint32_t number = 1;
  std::vector<Inner> below;
};

template <class V>
void describe(V& v, const Inner& inner) {
  v("number", inner.number);
  v("below", inner.below);
}

/// No default: it shows something else.
struct Shown {
  const Inner& inner;
  Colour colour{};
  const std::vector<int>& numbers;
};

template <class V>
void describe(V& v, const Shown& shown) {
  describe(v, shown.inner);
  v("colour", shown.colour);
  v("perhaps_colour", std::optional{shown.colour});
  v("perhaps", std::optional{shown.inner});
  v("time_ns", model::Nanoseconds{1});
  v("share", 0.5);
  v("map", std::map<std::string, bool>{{"a", true}});
  v("pair", std::pair{1, std::string{"x"}});
  v.unless_empty("numbers", shown.numbers);
  v.or_null("name", shown.numbers.empty() ? "" : "some");
  v.as_in("profile", "../scenario.schema.json", Json{{"any", "thing"}});
}

Json schema() { return schema_of("all", {schema_form<Shown>}); }

Json printed(Colour colour, const std::vector<int>& numbers) {
  const Inner inner{2, {Inner{}}};
  Json json = json_of(Head{"stormproof", 0, false});
  json.update(json_of(Shown{inner, colour, numbers}));
  return json;
}

TEST(Schema, MembersBecomeProperties) {
  const Json all = schema();
  const Json& properties = all["properties"];
  EXPECT_EQ(properties["schema"].dump(), R"({"type":"integer"})");
  EXPECT_EQ(properties["number"].dump(), R"({"type":"integer","minimum":0})");
  EXPECT_EQ(properties["below"].dump(), R"({"type":"array","items":{"$ref":"#/$defs/Inner"}})");
  EXPECT_EQ(properties["colour"].dump(), R"({"type":"string","enum":["red","green"]})");
  EXPECT_EQ(properties["perhaps_colour"].dump(),
            R"({"type":["string","null"],"enum":["red","green",null]})");
  EXPECT_EQ(properties["perhaps"].dump(),
            R"({"anyOf":[{"$ref":"#/$defs/Inner"},{"type":"null"}]})");
  EXPECT_EQ(properties["time_ns"].dump(), R"({"type":"integer"})");
  EXPECT_EQ(properties["share"].dump(), R"({"type":["number","null"]})");
  EXPECT_EQ(properties["map"].dump(),
            R"({"type":"object","additionalProperties":{"type":"boolean"}})");
  EXPECT_EQ(properties["pair"]["prefixItems"].dump(), R"([{"type":"integer"},{"type":"string"}])");
  EXPECT_EQ(properties["profile"].dump(), R"({"$ref":"../scenario.schema.json"})");
  EXPECT_EQ(all["additionalProperties"], false);
  EXPECT_EQ(all["required"].size(), properties.size() - 1) << "but for `numbers`";
  EXPECT_EQ(all["$defs"].size(), 1U) << "an Inner below an Inner is the same";
}

TEST(Schema, AllowsWhatIsPrinted) {
  const Json all = schema();
  for (const Json& json : {printed(Colour::red, {}), printed(Colour::green, {1, 2})}) {
    EXPECT_EQ(SchemaErrors(all, json).found(), std::vector<std::string>{});
  }
}

TEST(Schema, AllowsNothingElse) {
  const Json all = schema();
  const auto errors = [&](const char* pointer, const Json& value) {
    Json json = printed(Colour::red, {});
    json[Json::json_pointer(pointer)] = value;
    return SchemaErrors(all, json).found().size();
  };
  EXPECT_EQ(errors("/number", "one"), 1U);
  EXPECT_EQ(errors("/number", -1), 1U);
  EXPECT_EQ(errors("/number", 1.5), 1U);
  EXPECT_EQ(errors("/another", 1), 1U);
  EXPECT_EQ(errors("/below/0/another", 1), 1U);
  EXPECT_EQ(errors("/colour", "blue"), 1U);
  EXPECT_EQ(errors("/colour", nullptr), 1U);
  EXPECT_EQ(errors("/perhaps", Json{{"number", 1}}), 1U);
  EXPECT_EQ(errors("/map/a", 1), 1U);
  EXPECT_EQ(errors("/pair/0", nullptr), 1U);
  EXPECT_EQ(errors("/pair/2", 1), 1U);
  Json incomplete = printed(Colour::red, {});
  incomplete.erase("share");
  EXPECT_EQ(SchemaErrors(all, incomplete).found(), std::vector<std::string>{": no \"share\""});
}

TEST(Schema, OfSeveralFormsOneHolds) {
  const Json all = schema_of("all", {schema_form<Inner>, schema_form<Shown>});
  EXPECT_EQ(all["anyOf"].size(), 2U);
  Json json = printed(Colour::red, {});
  EXPECT_EQ(SchemaErrors(all, json).found(), std::vector<std::string>{});
  json["another"] = 1;
  EXPECT_EQ(SchemaErrors(all, json).found(),
            std::vector<std::string>{".another: not in the schema"});
}

}  // namespace schema_test
}  // namespace stormproof::report
