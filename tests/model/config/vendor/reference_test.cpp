// Which references are vendors' files, and what their parts are.
#include "model/config/vendor/reference.hpp"

#include <gtest/gtest.h>

namespace stormproof::model::config::vendor {
namespace reference_test {

/// "file|profile|base", or "no".
std::string parts(const std::string& reference) {
  const auto parsed = parse_reference(reference);
  if (!parsed) return "no";
  return parsed->file + "|" + parsed->selection.profile + "|" + parsed->selection.base;
}

TEST(Reference, a_file_alone) {
  EXPECT_EQ(parts("robots.xml"), "robots.xml||");
  EXPECT_EQ(parts("a/b.c/ROBOTS.XmL"), "a/b.c/ROBOTS.XmL||");
  EXPECT_EQ(parts("/tmp/my robots.xml"), "/tmp/my robots.xml||");
}

TEST(Reference, profile_and_preset) {
  EXPECT_EQ(parts("robots.xml#lidar"), "robots.xml|lidar|");
  EXPECT_EQ(parts("robots.xml@fastdds-2.14.5"), "robots.xml||fastdds-2.14.5");
  EXPECT_EQ(parts("robots.xml#lidar@fastdds-2.14.5"), "robots.xml|lidar|fastdds-2.14.5");
  EXPECT_EQ(parts("robots.xml#a#b@c"), "robots.xml|a#b|c");
  EXPECT_EQ(parts("robots.xml#a@b@c"), "robots.xml|a@b|c");
  EXPECT_EQ(parts("robots.xml#@"), "robots.xml||");
}

TEST(Reference, marks_before_the_ending_are_of_the_name) {
  EXPECT_EQ(parts("team#1/robots@home.xml"), "team#1/robots@home.xml||");
  EXPECT_EQ(parts("a.xml#b.xml"), "a.xml#b.xml||");
  EXPECT_EQ(parts("a.xml#b.xml#c"), "a.xml#b.xml|c|");
  EXPECT_EQ(parts("old.xml.bak/robots.xml@paper"), "old.xml.bak/robots.xml||paper");
}

TEST(Reference, other_names_are_none) {
  for (const char* name : {"", "paper", "robots.yaml", "xml", ".xml", "robots.xmlx", "robots.xml/x",
                           "robots.xml.yaml", "#robots", "robots.xm", "robots xml"}) {
    EXPECT_EQ(parts(name), "no") << name;
  }
}

}  // namespace reference_test
}  // namespace stormproof::model::config::vendor
