// Overrides are placed at the argument, whatever they hold.
#include "model/config/tree/overrides.hpp"

#include <gtest/gtest.h>

namespace stormproof::model::config {
namespace overrides_test {

Result<std::vector<Override>> parse(const std::string& argument) {
  const std::vector<std::string> arguments{argument};
  return parse_overrides(arguments);
}

TEST(Overrides, key_and_value_are_split_at_the_first_equals_sign) {
  const auto overrides = parse("a.b=x=y");
  ASSERT_TRUE(overrides);
  EXPECT_EQ(overrides->at(0).path, "a.b");
  EXPECT_EQ(overrides->at(0).value.text, "x=y");
}

TEST(Overrides, values_are_yaml_and_placed_at_the_argument) {
  const auto overrides = parse("l=[1, {a: 2}]");
  ASSERT_TRUE(overrides);
  const Node& list = overrides->at(0).value;
  EXPECT_EQ(list.items[1].find("a")->place.to_string(), "--set l=[1, {a: 2}]");
  EXPECT_EQ(list.items[1].members[0].key_place.to_string(), "--set l=[1, {a: 2}]");
}

TEST(Overrides, mistakes_name_the_argument) {
  EXPECT_EQ(to_string(parse("a.b").error()),
            "--set a.b: 'a.b' is not an override; expected key.path=value");
  EXPECT_EQ(parse("=5").error().message, "'=5' is not an override; expected key.path=value");
  EXPECT_EQ(parse("a=[1").error().where, "--set a=[1");
  EXPECT_EQ(parse("a=").error().message, "nothing in it");
  EXPECT_EQ(parse("a=\xff").error().message, "byte 0xff is not valid UTF-8");
}

TEST(Overrides, a_path_that_leads_nowhere_is_an_error) {
  Node root;
  root.kind = Node::Kind::map;
  EXPECT_FALSE(apply(parse("a=1")->at(0), root));
  EXPECT_EQ(to_string(*apply(parse("a.b=1")->at(0), root)),
            "--set a.b=1: 'a' has no keys below it: it is '1'");
}

}  // namespace overrides_test
}  // namespace stormproof::model::config
