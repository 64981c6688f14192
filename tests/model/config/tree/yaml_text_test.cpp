// What the parser keeps, and what it refuses before it costs anything.
#include "model/config/tree/yaml_text.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace yaml_text_test {

std::string refusal(const std::string& text) {
  const auto parsed = parse_yaml(text, "f");
  return parsed ? "accepted" : to_string(parsed.error());
}

/// n lists in each other.
std::string nested(std::size_t n) { return std::string(n, '[') + std::string(n, ']'); }

TEST(YamlText, every_node_knows_its_place) {
  const auto root = parse_yaml("# comment\na: 1\nb:\n  - x\n  - {k: \"v\"}\n", "f.yaml");
  ASSERT_TRUE(root);
  EXPECT_EQ(root->place.to_string(), "f.yaml:2:1");
  EXPECT_EQ(root->find("a")->place.to_string(), "f.yaml:2:4");
  EXPECT_EQ(root->members[1].key_place.to_string(), "f.yaml:3:1");
  EXPECT_EQ(root->find("b")->items[0].place.to_string(), "f.yaml:4:5");
  EXPECT_EQ(root->find("b")->items[1].find("k")->place.to_string(), "f.yaml:5:9");
  EXPECT_TRUE(root->find("b")->items[1].find("k")->quoted);
  EXPECT_FALSE(root->find("a")->quoted);
}

TEST(YamlText, json_is_yaml) {
  const auto root = parse_yaml(R"({"a": [1, "10us", {"b": null}], "c": "ä\u00e4\/\n"})", "f");
  ASSERT_TRUE(root);
  EXPECT_EQ(root->find("a")->items[1].text, "10us");
  EXPECT_EQ(root->find("a")->items[2].find("b")->kind, Node::Kind::null);
  EXPECT_EQ(root->find("c")->text, "ää/\n");
}

TEST(YamlText, aliases_are_expanded) {
  const auto root = parse_yaml("a: &x {k: 1}\nb: *x\n", "f");
  ASSERT_TRUE(root);
  EXPECT_EQ(root->find("b")->find("k")->text, "1");
}

TEST(YamlText, what_is_not_one_clean_document_is_refused) {
  EXPECT_EQ(refusal(""), "f:1:1: nothing in it");
  EXPECT_EQ(refusal("a: 1\nb: 2\na: 3\n"), "f:3:1: key 'a' is given twice");
  EXPECT_EQ(refusal("a: 1\n---\nb: 2\n"), "f:3:1: a second document; expected only one");
  EXPECT_EQ(
      refusal("a: !!python/object x\n"),
      "f:1:4: tag 'tag:yaml.org,2002:python/object' is not known; expected a value without a tag");
  EXPECT_EQ(refusal("[a]: 1\n"), "f:1:1: a list as a key; expected a key that is text");
  EXPECT_EQ(refusal("~: 1\n"), "f:1:1: nothing as a key; expected a key that is text");
  EXPECT_EQ(refusal("a: &x [*x]\n"), "f:1:8: an alias inside the value that it names");
  EXPECT_TRUE(refusal("a: *nobody\n").starts_with("f:1:4: not valid YAML: "))
      << refusal("a: *nobody\n");
  EXPECT_TRUE(refusal("a: [1, 2\n").starts_with("f:2:1: not valid YAML: "))
      << refusal("a: [1, 2\n");
  EXPECT_TRUE(refusal("a: 1\n b: 2\n").starts_with("f:2:")) << refusal("a: 1\n b: 2\n");
  EXPECT_TRUE(refusal("a: \"open\n").starts_with("f:2:2: not valid YAML: "))
      << refusal("a: \"open\n");
}

TEST(YamlText, a_missing_value_is_placed_at_its_key) {
  const auto root = parse_yaml("a:\n\nb: 1\n", "f");
  ASSERT_TRUE(root);
  EXPECT_EQ(root->find("a")->place.to_string(), "f:1:1");
}

TEST(YamlText, text_has_to_be_utf8_without_control_characters) {
  EXPECT_EQ(refusal("a: \xff\n"), "f:1:4: byte 0xff is not valid UTF-8");
  EXPECT_EQ(refusal("a: ä\n\xc0\xaf"), "f:2:1: byte 0xc0 is not valid UTF-8");
  EXPECT_EQ(refusal("x\xed\xa0\x80"), "f:1:2: byte 0xed is not valid UTF-8");
  EXPECT_EQ(refusal("x\xf4\x90\x80\x80"), "f:1:2: byte 0xf4 is not valid UTF-8");
  EXPECT_EQ(refusal("a: 1\n\x04"), "f:2:1: control character 0x04; expected text");
  EXPECT_EQ(refusal(std::string("a\0b", 3)), "f:1:2: control character 0x00; expected text");
  EXPECT_EQ(refusal("a: \"ä € 😀\"\n"), "accepted");
}

TEST(YamlText, depth_and_size_are_bounded) {
  EXPECT_EQ(refusal(nested(64)), "accepted");
  EXPECT_EQ(refusal(nested(65)), "f:1:65: nested more than 64 levels deep");
  EXPECT_NE(refusal(std::string(100'000, '[')).find("nested more than 64 levels"),
            std::string::npos);
  std::string laughs = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int k = 1; k < 20; ++k) {
    const std::string alias = "*a" + std::to_string(k - 1);
    laughs += "a" + std::to_string(k) + ": &a" + std::to_string(k) + " [" + alias;
    for (int repeat = 0; repeat < 9; ++repeat) laughs += ", " + alias;
    laughs += "]\n";
  }
  EXPECT_NE(refusal(laughs).find("more than 1000000 values"), std::string::npos) << refusal(laughs);
  std::string long_text = "a: &t " + std::string(1'000'000, 'x') + "\nb: [*t";
  for (int k = 0; k < 1'000; ++k) long_text += ", *t";
  EXPECT_NE(refusal(long_text + "]\n").find("aliases expand to more than"), std::string::npos);
  EXPECT_EQ(refusal(std::string(max_file_bytes + 1, ' ')), "f: longer than 16777216 bytes");
}

TEST(YamlText, files_that_cannot_be_read_are_refused) {
  const TestFiles files{};
  EXPECT_EQ(load_yaml(files.root()).error().message, "is a directory; expected a file");
  EXPECT_EQ(load_yaml(files.path("none")).error().message, "cannot be read");
  EXPECT_EQ(load_yaml("/dev/zero").error().message, "longer than 16777216 bytes");
  EXPECT_TRUE(load_yaml(files.write("a.yaml", "a: 1")));
}

RC_GTEST_PROP(YamlText, no_text_does_more_than_be_refused, (const std::string& text)) {
  (void)parse_yaml(text, "f");
}

RC_GTEST_PROP(YamlText, no_mess_of_punctuation_does_more_than_be_refused, ()) {
  const auto text = *rc::gen::container<std::string>(
      rc::gen::element('[', ']', '{', '}', ':', ',', '-', ' ', '\n', '&', '*', 'a', '!', '"', '\'',
                       '?', '|', '#', '%', '~'));
  (void)parse_yaml(text, "f");
}

}  // namespace yaml_text_test
}  // namespace stormproof::model::config
