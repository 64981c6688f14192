// Reading of grid files: what is accepted, what is refused, and where the mistake is shown.
#include "checker/experiments/grids/grid.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace stormproof::grids {
namespace grid_test {

using model::config::SpecPath;

model::config::Result<Grid> parse(const std::string& text) {
  return parse_grid(text, "g.yaml", SpecPath::standard());
}

std::string error(const std::string& text) {
  const auto grid = parse(text);
  return grid ? "no error" : to_string(grid.error());
}

std::vector<std::string> values(const std::string& list) {
  const auto grid = parse("base: smallest\ngrid:\n  k: " + list + "\n");
  if (!grid) return {to_string(grid.error())};
  std::vector<std::string> texts;
  for (const Axis::Value& value : grid->axes[0].values) texts.push_back(value.text);
  return texts;
}

using Texts = std::vector<std::string>;

TEST(Grid, RangesAreCountedOutExactly) {
  EXPECT_EQ(values("{from: 1, to: 4}"), (Texts{"1", "2", "3", "4"}));
  EXPECT_EQ(values("{from: 2, to: 7, step: 2}"), (Texts{"2", "4", "6"}));
  EXPECT_EQ(values("{from: 500ms, to: 1.5s, step: 500ms}"), (Texts{"500ms", "1s", "1.5s"}));
  EXPECT_EQ(values("{from: 0, to: 20us, step: 10us}"), (Texts{"0s", "10us", "20us"}));
  EXPECT_EQ(values("{from: 6Mbps, to: 24Mbps, step: 18Mbps}"), (Texts{"6Mbps", "24Mbps"}));
  EXPECT_EQ(values("[1, {from: 3, to: 4}, x]"), (Texts{"1", "3", "4", "x"}));
  EXPECT_EQ(values("[{base: paper, sedp: {grouping: mtu}}]"),
            (Texts{"{base: paper, sedp: {grouping: mtu}}"}));
}

TEST(Grid, WrongRangesAreRefusedAtTheirPlace) {
  EXPECT_EQ(values("{from: 4, to: 1}")[0].substr(0, 11), "g.yaml:3:6:");
  EXPECT_NE(values("{from: 1, to: 4, step: 0}")[0].find("positive step"), std::string::npos);
  EXPECT_NE(values("{from: 1, to: 4s}")[0].find("expected a range"), std::string::npos);
  EXPECT_NE(values("{from: 1s, to: 4s}")[0].find("expected a range"), std::string::npos);
  EXPECT_NE(values("{from: 1}")[0].find("without to"), std::string::npos);
  EXPECT_NE(values("{from: 1, to: 2, stop: 1}")[0].find("did you mean 'step'"), std::string::npos);
  EXPECT_NE(values("{from: 0, to: 1000000}")[0].find("1000001 values"), std::string::npos);
  EXPECT_NE(values("[]")[0].find("an empty list"), std::string::npos);
  EXPECT_NE(values("5")[0].find("expected a list of values"), std::string::npos);
}

TEST(Grid, CountsItsJobs) {
  const auto grid = parse(
      "base: live-5x20\nscenarios: [smallest, {dds: paper}, {base: wifi-5x20, time_limit: 1s}]\n"
      "grid: {a: [1, 2], b: [x, y, z]}\nsamples: 4\nseed: 7\n");
  ASSERT_TRUE(grid) << to_string(grid.error());
  EXPECT_EQ(grid->combinations(), 18U);
  EXPECT_EQ(grid->jobs(), 72U);
  EXPECT_EQ(grid->first_seed, 7U);
  EXPECT_EQ(grid->variants[0].name, "smallest");
  EXPECT_EQ(grid->variants[1].name, "dds=paper");
  EXPECT_EQ(grid->variants[2].name, "wifi-5x20 time_limit=1s");
}

TEST(Grid, ShippedGridsAreRead) {
  const auto paper = read_grid("paper", SpecPath::standard());
  ASSERT_TRUE(paper) << to_string(paper.error());
  EXPECT_EQ(paper->jobs(), 90U);
  EXPECT_TRUE(read_grid("small", SpecPath::standard()));
  EXPECT_TRUE(read_grid("profiles-and-orders", SpecPath::standard()));
}

struct Mistake {
  const char* text;
  const char* expected;
};

TEST(Grid, MistakesAreShownWithTheirPlace) {
  const Mistake mistakes[] = {
      {"gird: {a: [1]}\n", "g.yaml:1:1: unknown key 'gird'; did you mean 'grid'?"},
      {"grid: {a: [1]}\n", "g.yaml:1:1: neither base nor scenarios"},
      {"base: smalest\n", "g.yaml:1:7: no scenarios file named 'smalest'; did you mean"},
      {"base: [1]\n", "g.yaml:1:7: base: a list; expected the name"},
      {"base: smallest\ngrid: 3\n", "g.yaml:2:7: grid: '3'; expected a map"},
      {"base: smallest\ngrid: {a: [1], a: [2]}\n", "g.yaml:2:"},
      {"base: smallest\nscenarios: []\n", "g.yaml:2:12: scenarios: an empty list"},
      {"scenarios: [{dds: paper}]\n", "g.yaml:1:13: scenarios.0: a map without base"},
      {"scenarios: [smallest, nosuch]\n", "g.yaml:1:23: no scenarios file"},
      {"base: smallest\nsamples: 0\n", "g.yaml:2:10: samples: '0'; expected a number"},
      {"base: smallest\nseed: 1\n", "g.yaml:2:7: seed: there are no samples"},
      {"base: smallest\nsamples: 2\nseed: -1\n", "g.yaml:3:7: seed: '-1'"},
      {"base: smallest\ndescription: [x]\n", "g.yaml:2:14: description: a list"},
      {"base: smallest\ngrid: {a: {from: 1, to: 10000}, b: {from: 1, to: 10000}, c: {from: 1, to: "
       "10001}}\n",
       "g.yaml:1:1: more than 1000000000000 jobs"},
  };
  for (const Mistake& mistake : mistakes) {
    EXPECT_EQ(error(mistake.text).substr(0, std::string{mistake.expected}.size()), mistake.expected)
        << mistake.text;
  }
}

TEST(Grid, AGridThatDoesNotExist) {
  const auto grid = read_grid("papr", SpecPath::standard());
  ASSERT_FALSE(grid);
  EXPECT_NE(to_string(grid.error()).find("did you mean 'paper'"), std::string::npos);
  EXPECT_FALSE(read_grid("/no/such/grid.yaml", SpecPath::standard()));
}

}  // namespace grid_test
}  // namespace stormproof::grids
