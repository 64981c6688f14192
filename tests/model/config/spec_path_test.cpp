// Names, paths, and the order in which folders are searched.
#include "model/config/spec_path.hpp"

#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/model/config/test_files.hpp"

namespace stormproof::model::config {
namespace spec_path_test {

TEST(SpecPath, the_first_folder_wins) {
  const TestFiles files{};
  const std::string own = files.write("one/dds/paper.yaml", "{}");
  files.write("two/dds/paper.yaml", "{}");
  const std::string other = files.write("two/dds/other.yaml", "{}");
  const SpecPath specs{{files.path("one"), files.path("none"), files.path("two")}};
  EXPECT_EQ(*specs.find(SpecKind::dds, "paper", "", "w"), own);
  EXPECT_EQ(*specs.find(SpecKind::dds, "other", "", "w"), other);
  EXPECT_EQ(specs.names(SpecKind::dds), (std::vector<std::string>{"other", "paper"}));
  EXPECT_TRUE(specs.names(SpecKind::wireless).empty());
}

TEST(SpecPath, an_unknown_name_lists_the_known_ones) {
  const TestFiles files{};
  files.write("wireless/wired.yaml", "{}");
  files.write("wireless/ad-hoc.yaml", "{}");
  files.write("wireless/notes.txt", "");
  const SpecPath specs{{files.root()}};
  EXPECT_EQ(to_string(specs.find(SpecKind::wireless, "wird", "", "here").error()),
            "here: no wireless file named 'wird'; did you mean 'wired'?; expected one of ad-hoc, "
            "wired, or a path");
  EXPECT_FALSE(specs.find(SpecKind::wireless, "", "", "here"));
}

TEST(SpecPath, paths_are_relative_to_the_file_that_names_them) {
  const TestFiles files{};
  const std::string file = files.write("sub/own.yaml", "{}");
  const SpecPath specs{{files.root()}};
  EXPECT_EQ(*specs.find(SpecKind::dds, "own.yaml", files.path("sub"), ""), file);
  EXPECT_EQ(*specs.find(SpecKind::dds, "../sub/own.yaml", files.path("sub"), ""), file);
  EXPECT_EQ(*specs.find(SpecKind::dds, file, "/elsewhere", ""), file);
  EXPECT_EQ(specs.find(SpecKind::dds, "no.yml", "/x", "").error().message,
            "no file 'no.yml'; looked for /x/no.yml, no.yml");
}

TEST(SpecPath, a_file_without_an_ending_is_found_if_no_name_is_meant) {
  const TestFiles files{};
  files.write("dds/paper.yaml", "{}");
  const std::string own = files.write("sub/mine", "{}");
  files.write("sub/paper", "{}");
  files.write("sub/other.yaml", "{}");
  const SpecPath specs{{files.root()}};
  EXPECT_EQ(*specs.find(SpecKind::dds, "mine", files.path("sub"), ""), own);
  EXPECT_EQ(*specs.find(SpecKind::dds, "paper", files.path("sub"), ""),
            files.path("dds/paper.yaml"));
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(files.path("sub"));
  EXPECT_EQ(*specs.find(SpecKind::grids, "mine", "grid"), "mine");
  EXPECT_EQ(to_string(specs.find(SpecKind::grids, "other", "grid").error()),
            "other: no grid of this name; did you mean 'other.yaml'?; expected one of , or a path");
  std::filesystem::current_path(before);
}

TEST(SpecPath, the_environment_comes_first) {
  setenv("STORMPROOF_SPECS", "/a:/b:", 1);
  const SpecPath specs = SpecPath::standard();
  unsetenv("STORMPROOF_SPECS");
  ASSERT_GE(specs.directories.size(), 2U);
  EXPECT_EQ(specs.directories[0], "/a");
  EXPECT_EQ(specs.directories[1], "/b");
  EXPECT_EQ(SpecPath::standard().directories.size() + 2, specs.directories.size());
}

}  // namespace spec_path_test
}  // namespace stormproof::model::config
