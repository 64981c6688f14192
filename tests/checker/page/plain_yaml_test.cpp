// The page's own reader of YAML reads every file that is shipped to the same tree as yaml-cpp, with
// the same places, and refuses what it does not know where it stands.
#include "checker/page/plain_yaml.hpp"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "model/config/tree/yaml_text.hpp"
#include "tests/files.hpp"

namespace stormproof::page {
namespace plain_yaml_test {

namespace fs = std::filesystem;
using model::config::Node;

/// A tree with all that it knows, as text.
void print(const Node& node, const std::string& path, std::string& out) {
  out += path + " @" + std::to_string(node.place.line) + ":" + std::to_string(node.place.column) +
         (node.quoted ? " quoted" : "") + " " + node.shown() + " " + node.text + "\n";
  for (const model::config::Member& member : node.members) {
    const auto& place = member.key_place;
    print(member.value,
          path + "." + member.key + "@" + std::to_string(place.line) + ":" +
              std::to_string(place.column),
          out);
  }
  for (std::size_t k = 0; k < node.items.size(); ++k) {
    print(node.items[k], path + "[" + std::to_string(k) + "]", out);
  }
}

std::string printed(const model::config::Result<Node>& read) {
  if (!read) return to_string(read.error());
  std::string out;
  print(*read, "", out);
  return out;
}

void expect_same(const std::string& text, const std::string& name) {
  EXPECT_EQ(printed(parse_plain_yaml(text, name)), printed(model::config::parse_yaml(text, name)))
      << text.substr(0, 400);
}

TEST(PlainYaml, ReadsEveryShippedFileAsYamlCppDoes) {
  std::size_t files = 0;
  for (const char* folder : {"scenarios", "dds", "wireless", "hosts", "museum"}) {
    for (const auto& entry : fs::directory_iterator{fs::path{STORMPROOF_SPECS_DIR} / folder}) {
      if (entry.path().extension() != ".yaml") continue;
      expect_same(files::content(entry.path()), entry.path().string());
      ++files;
    }
  }
  expect_same(files::content(fs::path{STORMPROOF_SPECS_DIR} / "distributions.yaml"), "d");
  EXPECT_GT(files, 50U);
}

TEST(PlainYaml, ReadsFormsThatPeopleWrite) {
  for (const char* text : {
           "a: 1",
           "a: 1\r\nb: 2\r\n",
           "{a: 1, b: [x, 'y, z', \"q\\\"\"], c: {d: e f}}",
           "{\"a\": 1, \"b\": [1, 2]}",
           "a:\n- 1\n- {b: 2}\n- c: 3\n  d: 4\ne: 5",
           "a:\n  - - 1\n    - 2\n  -\n    b: 3",
           "a: b\n  c\n\n  d\ne: f",
           "a: >-\n  b\n  c\n\n  d\ne: f",
           "a:\nb: ~\nc: null\nd: {e: , f: g}",
           "a: [1,\n  2, # two\n  3]\nb: http://x.y:80/z",
           "a: b#c # d\n# e\n'f g': 1",
           "just text",
       }) {
    expect_same(text, "text");
  }
}

TEST(PlainYaml, RefusesWhatItDoesNotKnowWithItsPlace) {
  const auto refuses = [](const std::string& text, const std::string& complaint) {
    EXPECT_EQ(printed(parse_plain_yaml(text, "s")), complaint) << text;
  };
  refuses("a: 1\nb: &x 2",
          "s:2:4: '&' begins what this page does not read; expected a map, a list, text, a number "
          "or \">-\"");
  refuses("a: |\n  b",
          "s:1:4: '|' begins what this page does not read; expected a map, a list, text, a number "
          "or \">-\"");
  refuses("a: 1\na: 2", "s:2:1: key 'a' is given twice");
  refuses("a: [1, 2", "s:1:9: expected ',' or ']' of what begins at line 1");
  refuses("a: 'b", "s:1:4: no closing quote in the line");
  refuses("a: 1\n  b: 2", "s:2:4: a key within text; expected quotes around it");
  refuses("a:\n  b: 1\n c: 2",
          "s:3:2: text in column 2; expected a line that begins in column 1 or before");
  refuses("a:\n\tb: 1", "s:2:1: a tab before the text of a line; expected spaces");
  refuses("--- a", "s:1:1: the border of a document; expected one document without borders");
  refuses("a: 1\nb", "s:2:1: no key; expected a key and a colon, as on the lines above");
  refuses("# nothing", "s:1:10: nothing in it");
  refuses("a: \x01", "s:1:4: control character 0x01; expected text");
  refuses(std::string(200, '['), "s:1:65: nested more than 64 levels deep");
}

}  // namespace plain_yaml_test
}  // namespace stormproof::page
