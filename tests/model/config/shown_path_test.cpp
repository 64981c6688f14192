// What reports show of files: nothing of the machine that only the lookup by name brought in.
#include "model/config/shown_path.hpp"

#include <gtest/gtest.h>

#include "model/config/spec_path.hpp"

namespace stormproof::model::config {
namespace shown_path_test {

TEST(ShownPath, FilesOfSpecsAreBelowSpecs) {
  const std::string folder = STORMPROOF_SPECS_DIR;
  EXPECT_EQ(shown_path(folder + "/dds/paper.yaml"), "specs/dds/paper.yaml");
  EXPECT_EQ(shown_path(folder + "/dds/../wireless/x.yaml"), "specs/wireless/x.yaml");
  const auto named = SpecPath::standard().named(SpecKind::scenarios, "smallest");
  ASSERT_TRUE(named);
  EXPECT_EQ(shown_path(*named), "specs/scenarios/smallest.yaml");
}

TEST(ShownPath, OthersAreAsTheyWereGiven) {
  EXPECT_EQ(shown_path("robots.yaml"), "robots.yaml");
  EXPECT_EQ(shown_path("specs/../robots.yaml"), "specs/../robots.yaml");
  EXPECT_EQ(shown_path("/srv/robots.yaml"), "/srv/robots.yaml");
  EXPECT_EQ(shown_path(std::string{STORMPROOF_SPECS_DIR} + "-old/dds/paper.yaml"),
            std::string{STORMPROOF_SPECS_DIR} + "-old/dds/paper.yaml");
}

TEST(ShownPath, PlacesKeepTheirLine) {
  const std::string folder = STORMPROOF_SPECS_DIR;
  const Place place{std::make_shared<const std::string>(folder + "/dds/paper.yaml"), 7, 3};
  EXPECT_EQ(shown_place(place), "specs/dds/paper.yaml:7:3");
  EXPECT_EQ(shown_place({}), Place{}.to_string());
}

}  // namespace shown_path_test
}  // namespace stormproof::model::config
