// What a study of failures finds: what everybody survives, what nobody does, and what cures it.
#include "checker/experiments/survive/survive.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/experiments/survive/survive_report.hpp"
#include "checker/presentation/document/render.hpp"
#include "model/config/knobs/numeric_knobs.hpp"
#include "model/config/scenario_file.hpp"

namespace stormproof::survive {
namespace survive_test {

using model::Nanoseconds;
using model::config::SpecPath;

constexpr Nanoseconds seconds(std::int64_t s) { return Nanoseconds{s * 1'000'000'000}; }

Request request_of(std::vector<std::string> overrides, std::vector<Nanoseconds> lengths) {
  Request request;
  request.scenario = "smallest";
  request.overrides = std::move(overrides);
  request.lengths = std::move(lengths);
  request.samples = 2;
  request.threads = 2;
  return request;
}

Report report_of(const Request& request) {
  auto report = survive(request, SpecPath::standard());
  EXPECT_TRUE(report) << to_string(report.error());
  return *std::move(report);
}

const Outcome& outcome_of(const Version& version, Kind kind, Nanoseconds length) {
  for (const Outcome& outcome : version.outcomes) {
    if (outcome.failure == Failure{kind, length}) return outcome;
  }
  ADD_FAILURE() << name_of(kind);
  return version.outcomes.front();
}

TEST(Survive, FastDdsRecoversByItself) {
  const Report report = report_of(request_of({"dds=fastdds-2.6.11"}, {seconds(1), seconds(30)}));
  const Version& own = report.versions.front();
  EXPECT_EQ(report.unsurvived(), 0U);
  EXPECT_TRUE(own.attempts.empty());
  const Outcome& brief = outcome_of(own, Kind::network, seconds(1));
  EXPECT_EQ(brief.lost_pairs.max, 0);
  const Outcome& longer = outcome_of(own, Kind::network, seconds(30));
  EXPECT_EQ(longer.lost_pairs.min, 2);  // both, and the next announcement of one ends it
  EXPECT_GT(longer.recovery.max.value(), 0);
  EXPECT_LE(longer.recovery.max.value(), 3.2e9);
  // Who is killed for good is held until its lease is over.
  const Outcome& gone = outcome_of(own, Kind::process_gone, {});
  EXPECT_GT(gone.recovery.min.value(), 16.9e9);
  EXPECT_LE(gone.recovery.max.value(), 20e9);
  EXPECT_EQ(document_of(report, request_of({}, {})).exit_code, 0);
}

TEST(Survive, CycloneWithoutMulticastDoesNotAndAnIntervalCuresIt) {
  const Request request =
      request_of({"dds=cyclonedds-11", "dds.allow_multicast=false", "dds.peers=2"}, {seconds(60)});
  const Report report = report_of(request);
  const Version& own = report.versions.front();
  const Outcome& outcome = outcome_of(own, Kind::network, seconds(60));
  EXPECT_EQ(outcome.recovered, 0U);
  const auto interval = std::ranges::find(own.attempts, "SPDPInterval 5 s",
                                          [](const Attempt& one) { return one.cure.name; });
  ASSERT_NE(interval, own.attempts.end());
  EXPECT_TRUE(interval->cures());
  const report::Document document = document_of(report, request);
  EXPECT_EQ(document.exit_code, 1);
  const std::string text = to_text(document);
  EXPECT_NE(text.find("with SPDPInterval 5 s: 2 of 2"), std::string::npos) << text;
}

/// A server that comes back within the leases is not obeyed; one that waits is.
TEST(Survive, AServerThatWaitsIsObeyed) {
  const Report report = report_of(request_of(
      {"dds=fastdds-server-2.6.11", "deployment.hosts=2", "deployment.participants_per_host=2"},
      {seconds(2), seconds(30)}));
  const Version& own = report.versions.front();
  EXPECT_EQ(outcome_of(own, Kind::server_killed, seconds(2)).recovered, 0U);
  EXPECT_TRUE(outcome_of(own, Kind::server_killed, seconds(30)).is_survived());
  EXPECT_EQ(own.survived_from(Kind::server_killed), seconds(30));
  EXPECT_FALSE(outcome_of(own, Kind::unseen_death, seconds(23)).is_survived());
}

TEST(Survive, EveryFailureOfAnyScenarioIsValid) {
  for (const char* dds : {"fastdds-2.6.11", "cyclonedds-0.10", "fastdds-server-3.6"}) {
    const auto scenario = model::config::read_scenario(
        "smallest", std::vector<std::string>{std::string{"dds="} + dds}, SpecPath::standard());
    ASSERT_TRUE(scenario);
    for (const Failure& failure : failures_of(*scenario, {})) {
      EXPECT_TRUE(model::config::is_valid(with(failure, seconds(5), *scenario)))
          << dds << ": " << words_of(failure);
    }
  }
}

TEST(Survive, LengthsSurroundTheLease) {
  const auto scenario = *model::config::read_scenario(
      "smallest", std::vector<std::string>{"dds=fastdds-2.6.11"}, SpecPath::standard());
  std::vector<Nanoseconds> lengths;
  for (const Failure& failure : failures_of(scenario, {})) {
    if (failure.kind == Kind::host) lengths.push_back(failure.length);
  }
  EXPECT_EQ(lengths.front(), Nanoseconds{200'000'000});
  EXPECT_EQ(lengths.back(), seconds(120));
  EXPECT_TRUE(std::ranges::is_sorted(lengths));
  EXPECT_EQ(std::ranges::count(lengths, Nanoseconds{18'500'000'000}), 1);
  EXPECT_EQ(std::ranges::count(lengths, seconds(23)), 1);
}

TEST(Survive, AVersionFromWhichOnItIsSurvived) {
  Version version;
  const auto add = [&version](std::int64_t s, std::size_t recovered) {
    Outcome& one = version.outcomes.emplace_back();
    one.failure = {Kind::network, seconds(s)};
    one.runs = 2;
    one.recovered = recovered;
  };
  add(1, 2);
  EXPECT_FALSE(version.survived_from(Kind::network));  // nothing to wait for
  add(5, 1);
  EXPECT_FALSE(version.survived_from(Kind::network));
  add(23, 2);
  add(60, 2);
  EXPECT_EQ(version.survived_from(Kind::network), seconds(23));
  EXPECT_FALSE(version.survived_from(Kind::host));
}

TEST(Survive, OtherVersionsAreAskedAboutBesides) {
  Request request = request_of({"dds=fastdds-2.6.11"}, {seconds(30)});
  request.versions = {"fastdds-2.14.5"};
  request.samples = 1;
  const Report report = report_of(request);
  ASSERT_EQ(report.versions.size(), 2U);
  EXPECT_EQ(report.versions[1].outcomes.size(), report.versions[0].outcomes.size());
  request.versions = {"fastdds-9"};
  EXPECT_FALSE(survive(request, SpecPath::standard()));
}

TEST(Survive, RulesWithoutFailuresAreRefused) {
  const auto report = survive(request_of({}, {seconds(1)}), SpecPath::standard());
  ASSERT_FALSE(report);
  EXPECT_NE(to_string(report.error()).find("implementation: fastdds"), std::string::npos);
  Request lives = request_of({}, {seconds(1)});
  lives.scenario = "rejoin-fastdds";
  const auto twice = survive(lives, SpecPath::standard());
  ASSERT_FALSE(twice);
  EXPECT_NE(to_string(twice.error()).find("expected none"), std::string::npos);
}

TEST(Survive, StopsWhenItIsTold) {
  Request request = request_of({"dds=fastdds-2.6.11"}, {seconds(1)});
  request.on_progress = [](std::string_view, std::size_t, std::size_t) { return false; };
  const Report report = report_of(request);
  EXPECT_TRUE(report.interrupted);
  EXPECT_EQ(document_of(report, request).exit_code, 3);
}

}  // namespace survive_test
}  // namespace stormproof::survive
