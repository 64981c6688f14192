// Profiles on top of each other: what comes from where, and chains that never end.
#include "model/config/profile_files.hpp"

#include <gtest/gtest.h>

#include "model/config/tree/yaml_text.hpp"
#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace profile_files_test {

class ProfileFiles : public testing::Test {
 protected:
  Result<Node> resolve(const std::string& text) const {
    auto reference = parse_yaml(text, files.path("scenario.yaml"));
    if (!reference) return reference.error();
    auto resolved = resolve_profile(*std::move(reference), SpecKind::dds, SpecPath{{files.root()}});
    if (!resolved) return resolved.error();
    return std::move(resolved->tree);
  }
  std::string refusal(const std::string& text) const {
    const auto resolved = resolve(text);
    return resolved ? "accepted" : to_string(resolved.error());
  }

  const TestFiles files{};
};

TEST_F(ProfileFiles, bases_are_merged_in_order) {
  const std::string root =
      files.write("dds/root.yaml", "description: d\na: 1\nb: 1\nc: 1\nl: [1, 2]\n");
  files.write("dds/middle.yaml", "base: root\nb: 2\nc: 2\nl: [3]\n");
  const auto resolved = resolve("{base: middle, c: 3}");
  ASSERT_TRUE(resolved);
  EXPECT_EQ(resolved->find("a")->text, "1");
  EXPECT_EQ(resolved->find("b")->text, "2");
  EXPECT_EQ(resolved->find("c")->text, "3");
  EXPECT_EQ(resolved->find("l")->items.size(), 1U);
  EXPECT_EQ(resolved->find("base"), nullptr);
  EXPECT_EQ(resolved->find("description"), nullptr);
  EXPECT_EQ(resolved->find("a")->place.to_string(), root + ":2:4");
}

TEST_F(ProfileFiles, a_base_may_be_a_map_or_a_path) {
  files.write("near.yaml", "base: {a: 1, base: {b: 2}}\n");
  const auto resolved = resolve("near.yaml");
  ASSERT_TRUE(resolved);
  EXPECT_EQ(resolved->find("a")->text, "1");
  EXPECT_EQ(resolved->find("b")->text, "2");
}

TEST_F(ProfileFiles, a_path_is_relative_to_the_file_that_names_it) {
  files.write("sub/one.yaml", "base: ./two.yaml\n");
  files.write("sub/two.yaml", "a: 1\n");
  EXPECT_EQ(resolve("sub/one.yaml")->find("a")->text, "1");
}

TEST_F(ProfileFiles, a_profile_based_on_itself_is_refused) {
  const std::string one = files.write("dds/one.yaml", "base: two\n");
  const std::string two = files.write("dds/two.yaml", "a: 1\nbase: one\n");
  EXPECT_EQ(refusal("one"),
            two + ":2:7: 'one' is based on itself: " + one + " → " + two + " → " + one);
  const std::string self = files.write("dds/self.yaml", "base: ../dds/self.yaml\n");
  EXPECT_EQ(refusal("self"),
            self + ":1:7: '../dds/self.yaml' is based on itself: " + self + " → " + self);
}

TEST_F(ProfileFiles, a_chain_has_an_end) {
  for (int k = 0; k < 40; ++k) {
    files.write("dds/p" + std::to_string(k) + ".yaml", "base: p" + std::to_string(k + 1) + "\n");
  }
  EXPECT_NE(refusal("p0").find("p31.yaml:1:7: more than 32 profiles based on each other"),
            std::string::npos)
      << refusal("p0");
}

TEST_F(ProfileFiles, a_profile_cannot_change_the_implementation_of_its_base) {
  const std::string scenario = files.path("scenario.yaml");
  files.write("dds/fast.yaml", "implementation: fastdds\n");
  files.write("dds/silent.yaml", "a: 1\n");
  const std::string file = files.write("dds/mixed.yaml", "base: silent\nimplementation: fastdds\n");
  EXPECT_EQ(resolve("{base: fast, a: 2}")->find("implementation")->text, "fastdds");
  EXPECT_TRUE(resolve("{base: {base: fast}, implementation: fastdds}"));
  EXPECT_TRUE(resolve("{base: silent, implementation: paper}"));
  const std::string reason =
      ", as the profile that this changes has it; the keys of one do not fit the other";
  EXPECT_EQ(refusal("{base: {base: fast}, implementation: paper}"),
            scenario + ":1:38: implementation: 'paper'; expected fastdds" + reason);
  EXPECT_EQ(refusal("mixed"), file + ":2:17: implementation: 'fastdds'; expected paper" + reason);
}

TEST_F(ProfileFiles, what_is_no_profile_is_refused) {
  const std::string scenario = files.path("scenario.yaml");
  const std::string list = files.write("dds/list.yaml", "- 1\n");
  EXPECT_EQ(refusal("[1]"),
            scenario + ":1:1: a list as a profile; expected a name, a path or a map");
  EXPECT_EQ(refusal("{base: ~}"),
            scenario + ":1:2: nothing as a profile; expected a name, a path or a map");
  EXPECT_EQ(refusal("list"), list + ":1:1: a list as a profile file; expected a map");
  EXPECT_EQ(refusal("lost"),
            scenario +
                ":1:1: no dds file named 'lost'; did you mean 'list'?; expected one of "
                "list, or a path");
  EXPECT_EQ(refusal("{description: [1]}"), scenario + ":1:15: description: a list; expected text");
  files.write("dds/folder.yaml/x", "");
  EXPECT_EQ(refusal("folder"), files.path("dds/folder.yaml") + ": is a directory; expected a file");
}

}  // namespace profile_files_test
}  // namespace stormproof::model::config
