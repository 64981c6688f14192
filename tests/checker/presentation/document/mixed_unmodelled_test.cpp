// What several profiles of one run leave out is all assumed.
#include <string>

#include <gtest/gtest.h>

#include "checker/presentation/document/unmodelled.hpp"

namespace stormproof::report {
namespace mixed_unmodelled_test {

TEST(Unmodelled, OfAllProfilesOfARun) {
  model::Scenario scenario;
  scenario.dds.unmodelled["one"] = "this";
  scenario.deployment = model::Deployment::homogeneous(2, 2, 2);
  model::DdsProfile other = scenario.dds;
  other.unmodelled = {{"two", "that"}};
  scenario.deployment.participants[1].dds = other;
  scenario.deployment.participants[3].dds = other;
  Document document;
  add_unmodelled(document, scenario);
  ASSERT_EQ(document.assumptions.size(), 2U);
  EXPECT_NE(document.assumptions[0].plain().find("one"), std::string::npos);
  EXPECT_NE(document.assumptions[1].plain().find("of participants 1, 3): that"), std::string::npos);
}

}  // namespace mixed_unmodelled_test
}  // namespace stormproof::report
