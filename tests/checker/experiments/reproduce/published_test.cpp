// The published figures are read as they are printed, every one of them, and none without a word
// about it.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "tests/checker/experiments/reproduce/examples.hpp"

namespace stormproof::reproduce {
namespace published_test {

/// All numbers of a YAML document, wherever they are.
void count_numbers(const YAML::Node& node, std::size_t& count, double& sum) {
  if (node.IsMap()) {
    for (const auto& entry : node) {
      if (entry.first.as<std::string>() == "np") continue;
      count_numbers(entry.second, count, sum);
    }
  } else if (node.IsSequence()) {
    for (const YAML::Node& item : node) count_numbers(item, count, sum);
  } else {
    double value = 0;
    if (YAML::convert<double>::decode(node, value)) {
      ++count;
      sum += value;
    }
  }
}

std::string error_of(const std::string& tables, const std::string& notes) {
  const auto published = parse_published(tables, notes, "specs");
  return published ? "" : to_string(published.error());
}

const std::string grid =
    "grid: {hosts: 2, participants_per_host: [1], endpoints_per_participant: [2]}\n"
    "high_load: {participants_per_host_min: 1, endpoints_per_participant_min: 2}\n";
const std::string grid_notes =
    "beside:\n  - {figures: [grid.*, high_load.*], kind: input, quantity: set-up}\n";

TEST(PublishedFigures, AreAllThere) {
  std::size_t count = 0;
  double sum = 0;
  count_numbers(YAML::Load(shipped("paper-tables.yaml")), count, sum);
  const Published published = shipped_figures();
  std::size_t read = 0;
  double read_sum = 0;
  for (const PublishedFigure& figure : published.figures) {
    read += figure.values.size();
    for (const double value : figure.values) read_sum += value;
  }
  EXPECT_EQ(read, count);
  EXPECT_NEAR(read_sum, sum, 1e-6);
  EXPECT_GT(count, 150U);
}

TEST(PublishedFigures, HaveThePrintedValues) {
  const Published published = shipped_figures();
  EXPECT_EQ(published.values("repair_amplification.wireless.heartbeat").front(), 14036.1);
  EXPECT_EQ(published.values("repair_amplification.wired.repair_data").front(), 0.07);
  EXPECT_EQ(published.values("observed_means.np6.completion_s.adaptive").front(), 2.886);
  EXPECT_EQ(published.values("upper_range.high_load.messages.iqr"),
            (std::vector<double>{1.29, 2.07}));
  EXPECT_EQ(published.values("loopback_configurations_with_repair").front(), 48);
  EXPECT_EQ(published.find("observed_means.np7.completion_s.adaptive"), nullptr);
}

TEST(PublishedFigures, HaveUnits) {
  const Published published = shipped_figures();
  EXPECT_EQ(published.find("observed_means.np1.completion_s.baseline")->unit, "s");
  EXPECT_EQ(published.find("ordering_policy_spread.completion_max_pct")->unit, "%");
  EXPECT_EQ(published.find("observed_means.np1.messages.baseline")->unit, "");
}

TEST(PublishedFigures, OfTheModelHaveAReasonForEachVariantInCaseTheyDiffer) {
  const Published published = shipped_figures();
  for (const PublishedFigure& figure : published.figures) {
    const Kind kind = published.note_of(figure.id).kind;
    if (kind == Kind::input) continue;
    // F descriptors, each sent once: nothing to explain.
    if (figure.id.ends_with("wired.initial_data")) continue;
    for (const std::string& variant : variant_ids()) {
      EXPECT_FALSE(published.reasons_of(figure.id, variant).empty())
          << figure.id << " of " << variant;
    }
  }
}

TEST(PublishedFigures, HaveReasonsThatHoldForSomeVariantsOnly) {
  const Published published = shipped_figures();
  const std::string id = "repair_amplification.wired.acknack";
  const auto of_paper = published.reasons_of(id, "paper");
  const auto of_fastdds = published.reasons_of(id, "fastdds-2.6.11");
  EXPECT_NE(of_paper, of_fastdds);
  EXPECT_GT(published.reasons_of(id).size(), of_paper.size());
}

TEST(Patterns, MatchPartByPart) {
  EXPECT_TRUE(matches("a.*.c", "a.b.c"));
  EXPECT_TRUE(matches("a", "a"));
  EXPECT_FALSE(matches("a.*", "a"));
  EXPECT_FALSE(matches("a.*", "a.b.c"));
  EXPECT_FALSE(matches("a.b", "a.bc"));
  EXPECT_FALSE(matches("", "a"));
}

TEST(PublishedErrors, NameTheFigureWithoutANote) {
  EXPECT_EQ(error_of(grid, grid_notes), "");
  EXPECT_EQ(error_of(grid + "other: 3\n", grid_notes),
            "specs: other: 0 notes in 'beside', expected one");
  EXPECT_EQ(error_of(grid, grid_notes + "  - {figures: grid.hosts, kind: input, quantity: x}\n"),
            "specs: grid.hosts: 2 notes in 'beside', expected one");
}

TEST(PublishedErrors, NamePatternsThatMatchNothing) {
  EXPECT_EQ(error_of(grid, grid_notes + "reasons:\n  - {figures: gird.hosts, because: x}\n"),
            "specs: 'gird.hosts' matches no published figure");
}

TEST(PublishedErrors, NameUnknownVariants) {
  EXPECT_EQ(error_of(grid, grid_notes + "reasons:\n  - {figures: grid.hosts, variants: [papr], "
                                        "because: x}\n"),
            "specs/paper-notes.yaml:4:5: 'papr' is not a variant");
}

TEST(PublishedErrors, HavePlaces) {
  EXPECT_EQ(error_of(grid + "a: {b: lots}\n", grid_notes),
            "specs/paper-tables.yaml:3:8: a.b: expected a number");
  EXPECT_EQ(error_of(grid + "a: {b: .nan}\n", grid_notes),
            "specs/paper-tables.yaml:3:8: a.b: expected a number");
  EXPECT_EQ(error_of(grid, "beside:\n  - {figures: grid.*, kind: guess, quantity: x}\n"),
            "specs/paper-notes.yaml:2:5: 'guess': expected kind input, model, nearest or "
            "unavailable");
  EXPECT_EQ(error_of(grid, "beside:\n  - {kind: input, quantity: x}\n"),
            "specs/paper-notes.yaml:2:5: expected 'figures', one or several paths");
  EXPECT_NE(error_of("grid: [", grid_notes).find("specs/paper-tables.yaml:1:"), std::string::npos);
}

TEST(PublishedErrors, AskForAGrid) {
  EXPECT_EQ(error_of("high_load: {participants_per_host_min: 1}\n", grid_notes),
            "specs: lacks 'grid.hosts'");
  EXPECT_EQ(error_of("grid: {hosts: 2.5, participants_per_host: [1], "
                     "endpoints_per_participant: [2]}\n",
                     grid_notes),
            "specs: grid.hosts: 2.5 is not a whole number from 1 to 1000");
}

}  // namespace published_test
}  // namespace stormproof::reproduce
