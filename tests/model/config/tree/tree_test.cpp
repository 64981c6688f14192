// Merging and assignment keep values where they were written.
#include "model/config/tree/tree.hpp"

#include <gtest/gtest.h>

#include "model/config/tree/yaml_text.hpp"

namespace stormproof::model::config {
namespace tree_test {

Node tree(const std::string& text, const std::string& source = "t") {
  auto parsed = parse_yaml(text, source);
  EXPECT_TRUE(parsed) << text;
  return parsed ? *parsed : Node{};
}

TEST(Tree, maps_merge_and_all_else_is_replaced) {
  const Node merged = merge(tree("{a: 1, m: {x: 1, y: 2}, l: [1, 2]}", "base"),
                            tree("{b: 3, m: {y: 5}, l: [9]}", "over"));
  EXPECT_EQ(merged.find("a")->text, "1");
  EXPECT_EQ(merged.find("b")->text, "3");
  EXPECT_EQ(merged.find("m")->find("x")->text, "1");
  EXPECT_EQ(merged.find("m")->find("y")->text, "5");
  EXPECT_EQ(merged.find("l")->items.size(), 1U);
  EXPECT_EQ(merged.place.to_string(), "over:1:1");
  EXPECT_EQ(merged.find("m")->find("x")->place.to_string(), "base:1:15");
  EXPECT_EQ(merged.find("m")->find("y")->place.to_string(), "over:1:15");
  EXPECT_EQ(merge(tree("{a: {b: 1}}"), tree("{a: 2}")).find("a")->text, "2");
}

TEST(Tree, taking_a_key_removes_it) {
  Node map = tree("{a: 1, b: 2}");
  EXPECT_EQ(map.take("a")->text, "1");
  EXPECT_FALSE(map.take("a"));
  EXPECT_EQ(map.members.size(), 1U);
}

TEST(Tree, a_path_sets_a_value) {
  Node root = tree("{a: {b: 1}, l: [{c: 1}, {c: 2}]}");
  EXPECT_FALSE(set_path(root, "a.b", tree("7")));
  EXPECT_FALSE(set_path(root, "a.new.deep", tree("8")));
  EXPECT_FALSE(set_path(root, "l.1.c", tree("9")));
  EXPECT_EQ(root.find("a")->find("b")->text, "7");
  EXPECT_EQ(root.find("a")->find("new")->find("deep")->text, "8");
  EXPECT_EQ(root.find("l")->items[1].find("c")->text, "9");
  EXPECT_EQ(root.find("l")->items[0].find("c")->text, "1");
}

TEST(Tree, a_wrong_path_says_why) {
  Node root = tree("{a: {b: 1}, l: [5]}");
  EXPECT_EQ(set_path(root, "a.b.c", tree("1")), "'a.b' has no keys below it: it is '1'");
  EXPECT_EQ(set_path(root, "l.1", tree("1")),
            "there is no element 1; the list has 1 (numbered from 0)");
  EXPECT_EQ(set_path(root, "l.x", tree("1")), "'x' is not the number of a list element");
  EXPECT_EQ(set_path(root, "l.-1", tree("1")), "'-1' is not the number of a list element");
  EXPECT_EQ(set_path(root, "a..b", tree("1")), "'a..b' has an empty part; expected key.key…");
  std::string deep = "a";
  for (int k = 0; k < 100'000; ++k) deep += ".a";
  EXPECT_EQ(set_path(root, deep, tree("1")), "a key has at most 64 parts");
}

TEST(Tree, values_are_shown_short_and_without_control_characters) {
  EXPECT_EQ(quote("a\nb"), "'a\\x0ab'");
  EXPECT_EQ(quote(std::string(61, 'x')), "'" + std::string(60, 'x') + "…'");
  EXPECT_EQ(quote(std::string(59, 'x') + "ä"), "'" + std::string(59, 'x') + "…'");
  EXPECT_EQ(tree("[1]").shown(), "a list");
  EXPECT_EQ(tree("~").shown(), "nothing");
}

}  // namespace tree_test
}  // namespace stormproof::model::config
