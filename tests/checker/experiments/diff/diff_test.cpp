// The whole comparison on small grids: what regresses is found, what does not is let through, and
// the grid is held to what two profiles can be compared over.
#include "checker/experiments/diff/diff.hpp"

#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "checker/experiments/diff/blame.hpp"
#include "checker/experiments/diff/diff_report.hpp"
#include "checker/experiments/diff/reviewed_grid.hpp"
#include "checker/presentation/document/render.hpp"
#include "checker/presentation/text/paragraph.hpp"

namespace stormproof::diff {
namespace diff_test {

namespace config = model::config;
const config::SpecPath specs{{STORMPROOF_SPECS_DIR}};

/// A file of this process alone: tests run side by side.
std::string written(const std::string& name, const std::string& text) {
  const auto file = std::filesystem::path{testing::TempDir()} / (std::to_string(getpid()) + name);
  std::ofstream{file} << text;
  return file.string();
}

config::TracedProfile profile(const std::string& reference,
                              const std::vector<std::string>& changes = {}) {
  auto traced = config::trace_dds_profile(reference, changes, specs);
  EXPECT_TRUE(traced) << to_string(traced.error());
  return *traced;
}

constexpr const char* small_grid = R"(
base: wifi-5x20-fastdds
grid:
  deployment.participants_per_host: [2, 3]
  deployment.endpoints_per_participant: [4]
)";

DiffRequest request(config::TracedProfile base, config::TracedProfile candidate) {
  DiffRequest request;
  request.base = std::move(base);
  request.candidate = std::move(candidate);
  request.policy = *read_policy("default", specs);
  request.grid = written("diff-small.yaml", small_grid);
  request.check_verdicts = false;
  request.tell_apart = false;
  return request;
}

DiffReport compared(const DiffRequest& request) {
  auto report = diff(request, specs);
  EXPECT_TRUE(report) << to_string(report.error());
  return *report;
}

TEST(Diff, AProfileWithItselfNeedsNoRun) {
  const DiffReport report = compared(request(profile("paper"), profile("paper")));
  EXPECT_EQ(report.judgment, Judgment::same);
  EXPECT_EQ(report.profiles.relation, Relation::identical);
  EXPECT_EQ(report.costs.wanted, 0U);
  EXPECT_TRUE(report::to_text(document_of(report, {})).starts_with("✓ NO REGRESSION:"));
}

TEST(Diff, OnlyUnmodelledSettingsAreInconclusive) {
  const DiffReport report = compared(
      request(profile("fastdds-2.6.11"), profile("fastdds-2.6.11", {"unmodelled={x: does y}"})));
  EXPECT_EQ(report.judgment, Judgment::unclear);
  ASSERT_EQ(report.reasons.size(), 1U);
  EXPECT_NE(report.reasons[0].find("settings that the model has not: x"), std::string::npos);
}

TEST(Diff, SlowerRepliesRegress) {
  // Endpoints are asked for a second later: completion has to take that second.
  const DiffReport worse = compared(
      request(profile("fastdds-2.14.5"),
              profile("fastdds-2.14.5", {"sedp.nack_response_delay=1500ms", "spdp.period=2s"})));
  EXPECT_EQ(worse.judgment, Judgment::regression);
  ASSERT_EQ(worse.costs.configurations.size(), 2U);
  EXPECT_EQ(worse.costs.configurations[0][Measure::completion].judgment, Judgment::regression);
  EXPECT_GT(worse.costs.configurations[0][Measure::completion].shift->low, 0);
  EXPECT_FALSE(worse.reasons.empty());
  ASSERT_TRUE(worse.blame);
  ASSERT_EQ(worse.blame->entries.size(), 2U);
  for (const Blame::Entry& entry : worse.blame->entries) {
    EXPECT_EQ(entry.cures, entry.reverted.front() == "sedp.nack_response_delay");
  }
  const DiffReport reverse = compared(request(
      profile("fastdds-2.14.5", {"sedp.nack_response_delay=1500ms"}), profile("fastdds-2.14.5")));
  EXPECT_EQ(reverse.judgment, Judgment::better);
}

constexpr const char* grid_with_types = R"(
base:
  deployment:
    hosts: 2
    participants_per_host: 3
    endpoints_per_participant: 20
    loopback_delay: 2ms
    schedule: {start: [3ms, 36ms], endpoints_done: [30ms, 70ms], seed: 0}
  dds: fastdds-3.6
  wireless: emulated-ap
  time_limit: 60s
grid:
  deployment.types.unknown_per_participant: [0, 12]
)";

/// Jazzy's version asks for no types. Lyrical's takes as long where all know all of them.
TEST(Diff, AnUpgradeIsWorseForThoseWhoseTypesOthersLack) {
  DiffRequest asked = request(profile("jazzy"), profile("lyrical"));
  asked.grid = written("diff-types.yaml", grid_with_types);
  const DiffReport upgrade = compared(asked);
  EXPECT_EQ(upgrade.judgment, Judgment::regression);
  ASSERT_EQ(upgrade.costs.configurations.size(), 2U);
  const Configuration& known = upgrade.costs.configurations[0];
  const Configuration& unknown = upgrade.costs.configurations[1];
  EXPECT_NE(known[Measure::completion].judgment, Judgment::regression);
  EXPECT_EQ(unknown[Measure::completion].judgment, Judgment::regression);
  EXPECT_GT(unknown[Measure::completion].shift->low, 0);
  ASSERT_TRUE(upgrade.blame);
  EXPECT_EQ(upgrade.blame->configuration, unknown.name);
  const auto lookups = std::ranges::find(
      upgrade.blame->entries, std::vector<std::string>{"type_lookup"}, &Blame::Entry::reverted);
  ASSERT_NE(lookups, upgrade.blame->entries.end());
  EXPECT_TRUE(lookups->cures);
}

/// Clients of version 3.6 are told everything, those of 2.14.5 what they match.
TEST(Diff, AnUpgradeWithAServerCostsMessages) {
  DiffRequest asked = request(profile("fastdds-server-2.14.5"), profile("fastdds-server-3.6"));
  const DiffReport upgrade = compared(asked);
  EXPECT_EQ(upgrade.judgment, Judgment::regression);
  for (const Configuration& configuration : upgrade.costs.configurations) {
    EXPECT_EQ(configuration[Measure::messages].judgment, Judgment::regression)
        << configuration.name;
    EXPECT_NE(configuration[Measure::completion].judgment, Judgment::regression)
        << configuration.name;
  }
  // Nothing says how types are looked up through a server.
  asked.grid = written("diff-server-types.yaml", grid_with_types);
  const auto refused = diff(asked, specs);
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.error()).find("deployment.types"), std::string::npos);
}

TEST(Diff, TheAnswerDoesNotDependOnThreads) {
  DiffRequest asked = request(profile("fastdds-2.6.11"), profile("fastdds-2.14.5"));
  asked.samples = 3;
  asked.threads = 1;
  auto one = to_json(compared(asked), {});
  asked.threads = 3;
  auto three = to_json(compared(asked), {});
  one.erase("seconds");
  three.erase("seconds");
  EXPECT_EQ(one.dump(), three.dump());
}

TEST(Diff, RunsThatAreTheSameAreSaidToBe) {
  // The periodic HEARTBEAT of ten seconds more never fires before discovery is complete.
  const DiffReport report = compared(request(profile("fastdds-2.14.5", {"spdp.period=100s"}),
                                             profile("fastdds-2.14.5", {"spdp.period=101s"})));
  for (const Configuration& each : report.costs.configurations) {
    EXPECT_TRUE(each.identical_runs) << each.name;
    EXPECT_EQ(each[Measure::completion].shift->estimate, 0);
  }
  EXPECT_EQ(report.judgment, Judgment::same);
}

TEST(Diff, InterruptedIsInconclusive) {
  DiffRequest asked = request(profile("fastdds-2.6.11"), profile("fastdds-2.14.5"));
  asked.on_progress = [](std::string_view, std::size_t, std::size_t) { return false; };
  const DiffReport report = compared(asked);
  EXPECT_TRUE(report.interrupted);
  EXPECT_EQ(report.judgment, Judgment::unclear);
  EXPECT_TRUE(report::to_text(document_of(report, {})).starts_with("? INCONCLUSIVE:"));
}

TEST(Diff, TheLeastScenario) {
  DiffRequest asked = request(profile("fastdds-2.6.11"), profile("fastdds-2.14.5"));
  asked.samples = 2;
  asked.tell_apart = true;
  const TellingApart apart = compared(asked).telling_apart;
  ASSERT_TRUE(apart.found);
  EXPECT_EQ(apart.scenario.deployment.size(), 2U);
  EXPECT_EQ(apart.scenario.dds, asked.base.value);
  EXPECT_EQ(apart.candidate, asked.candidate.value);
}

TEST(Diff, Verdicts) {
  DiffRequest asked =
      request(profile("paper"), profile("paper", {"sedp.heartbeat_timer=additive"}));
  asked.grid = "smallest";
  asked.check_verdicts = true;
  const DiffReport report = compared(asked);
  ASSERT_TRUE(report.verdicts.done);
  EXPECT_EQ(report.verdicts.scenario, "smallest");
  const auto changed = std::ranges::find(report.verdicts.properties, "timer.single-heartbeat",
                                         &VerdictChange::property);
  ASSERT_NE(changed, report.verdicts.properties.end());
  EXPECT_EQ(changed->before, props::VerdictKind::proved);
  EXPECT_EQ(changed->after, props::VerdictKind::violated);
  EXPECT_TRUE(changed->counterexample);
  EXPECT_EQ(report.judgment, Judgment::regression);
  const auto json = to_json(report, {{"timer.single-heartbeat", "d/timer.jsonl"}});
  EXPECT_EQ(json["verdict"], "regression");
  EXPECT_EQ(json["check"]["verdicts"].size(), report.verdicts.properties.size());
  EXPECT_NE(json.dump().find("d/timer.jsonl"), std::string::npos);
}

TEST(DiffText, FitsInAHundredColumns) {
  DiffRequest asked = request(profile("fastdds-2.6.11"), profile("fastdds-2.14.5"));
  asked.samples = 4;
  const DiffReport report = compared(asked);
  for (const bool verbose : {false, true}) {
    std::istringstream lines{report::to_text(document_of(report, {}), {.verbose = verbose})};
    for (std::string line; std::getline(lines, line);) {
      if (line.find('/') != std::string::npos) continue;  // a path may be longer
      EXPECT_LE(report::columns(line), report::report_width) << line;
    }
  }
}

TEST(Blame, SetsSingleKnobsBack) {
  const model::DdsProfile base = profile("fastdds-2.6.11").value;
  const model::DdsProfile candidate = profile("fastdds-2.14.5").value;
  const auto one = with_reverted(candidate, base, {"spdp.resend"});
  ASSERT_TRUE(one);
  EXPECT_EQ(one->spdp.resend, base.spdp.resend);
  EXPECT_EQ(one->sedp, candidate.sedp);
  const auto all = with_reverted(candidate, base,
                                 {"spdp.resend", "sedp.heartbeat_response_delay",
                                  "sedp.nack_response_delay", "sedp.nack_suppression_duration"});
  ASSERT_TRUE(all);
  EXPECT_EQ(all->sedp, base.sedp);
  EXPECT_FALSE(with_reverted(candidate, profile("paper").value, {"spdp.resend"}));
  EXPECT_FALSE(with_reverted(candidate, base, {"sedp.no_such_key"}));
  // What the base does not say is as if nobody said it.
  const auto asks = with_reverted(profile("fastdds-3.6").value, candidate, {"type_lookup"});
  ASSERT_TRUE(asks);
  EXPECT_EQ(asks->version.type_lookup, model::Whether::no);
  EXPECT_EQ(asks->version.sizes, model::SizesSince::v3_6);
}

/// The error of a grid; "accepted" if there is none.
std::string grid_error(const std::string& text) {
  const model::DdsProfile dds = profile("fastdds-2.6.11").value;
  const std::string file = written("diff-grid.yaml", text);
  const auto grid = read_reviewed_grid(file, dds, dds, specs);
  if (grid) return "accepted";
  const std::string whole = to_string(grid.error());
  const auto at = whole.find("diff-grid.yaml");
  return at == std::string::npos ? whole : whole.substr(at);
}

TEST(ReviewedGrid, MayNotSweepTheProfile) {
  EXPECT_EQ(grid_error(small_grid), "accepted");
  const std::string whole = grid_error("base: smallest\ngrid:\n  dds: [paper]\n");
  EXPECT_EQ(whole.substr(0, 52), "diff-grid.yaml:3:9: dds: the grid sweeps the DDS pro");
  EXPECT_NE(grid_error("base: smallest\ngrid:\n  dds.sedp.grouping: [mtu]\n")
                .find("dds.sedp.grouping: the grid sweeps"),
            std::string::npos);
  EXPECT_NE(
      grid_error("base: smallest\nscenarios:\n  - {dds: paper}\n").find("diff-grid.yaml:3:11"),
      std::string::npos);
  EXPECT_NE(grid_error("base: smallest\ngrid:\n  deployment.hosts: [1]\n").find("two hosts"),
            std::string::npos);
}

TEST(ReviewedGrid, OneScenarioIsAGrid) {
  const model::DdsProfile base = profile("paper").value;
  const model::DdsProfile candidate = profile("fastdds-2.6.11").value;
  const auto grid = read_reviewed_grid("three-hosts", base, candidate, specs);
  ASSERT_TRUE(grid) << to_string(grid.error());
  ASSERT_EQ(grid->points.size(), 1U);
  EXPECT_EQ(grid->points[0].name, "three-hosts");
  EXPECT_EQ(grid->points[0].base.dds, base);
  EXPECT_EQ(grid->points[0].candidate.dds, candidate);
  EXPECT_FALSE(grid->points[0].is_drawn());
  const auto wrong = read_reviewed_grid("three-host", base, candidate, specs);
  ASSERT_FALSE(wrong);
  EXPECT_NE(to_string(wrong.error()).find("did you mean 'three-hosts'"), std::string::npos);
}

TEST(ReviewedGrid, TheShippedOneFitsEveryPreset) {
  for (const std::string& name : specs.names(config::SpecKind::dds)) {
    const model::DdsProfile dds = profile(name).value;
    const auto grid = read_reviewed_grid("review", dds, dds, specs);
    ASSERT_TRUE(grid) << name << ": " << to_string(grid.error());
    EXPECT_EQ(grid->points.size(), 9U);
    EXPECT_EQ(grid->points[4].name, "participants_per_host 4, endpoints_per_participant 20");
    EXPECT_TRUE(grid->points[4].is_drawn());
  }
}

}  // namespace diff_test
}  // namespace stormproof::diff
