// Every exhibit that is shipped is as it says; every claim is broken by some exhibit; files that
// are no exhibits are refused with their place.
#include "checker/experiments/museum/museum.hpp"

#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "checker/experiments/museum/certified.hpp"
#include "checker/experiments/museum/claims.hpp"
#include "tests/files.hpp"

namespace stormproof::museum {
namespace museum_test {

using model::config::SpecPath;

const SpecPath& specs() {
  static const SpecPath path = SpecPath::standard();
  return path;
}
bool always() { return true; }

class Exhibits : public testing::TestWithParam<std::string> {};

TEST_P(Exhibits, AreAsTheySay) {
  const auto exhibit = read_exhibit(GetParam(), specs());
  ASSERT_TRUE(exhibit) << to_string(exhibit.error());
  EXPECT_EQ(exhibit->id, GetParam());
  const Report report = show({*exhibit}, always);
  const ShownExhibit& shown = report.exhibits.front();
  EXPECT_EQ(name_of(shown.before.verdict), std::string{name_of(exhibit->before.expected)})
      << shown.before.how;
  EXPECT_EQ(name_of(shown.after.verdict), std::string{name_of(exhibit->after.expected)})
      << shown.after.how;
  for (std::size_t k = 0; k < shown.decoys.size(); ++k) {
    EXPECT_EQ(name_of(shown.decoys[k].verdict), std::string{name_of(exhibit->decoys[k].expected)})
        << exhibit->decoys[k].title << ": " << shown.decoys[k].how;
  }
  EXPECT_TRUE(report.as_expected());
}

INSTANTIATE_TEST_SUITE_P(Museum, Exhibits, testing::ValuesIn(exhibit_names(specs())),
                         [](const auto& exhibit) { return exhibit.param; });

TEST(Museum, HasAnExhibitThatBreaksEachClaim) {
  std::set<std::string> broken;
  for (const std::string& name : exhibit_names(specs())) {
    const auto exhibit = read_exhibit(name, specs());
    ASSERT_TRUE(exhibit) << name;
    if (exhibit->before.expected == props::VerdictKind::violated) broken.insert(exhibit->claim);
  }
  for (const Claim& claim : claims())
    EXPECT_TRUE(broken.contains(std::string{claim.id})) << claim.id;
  EXPECT_GE(exhibit_names(specs()).size(), 16U);
}

/// What went wrong with a file that has this text.
std::string refusal(const std::string& text) {
  const std::string path = testing::TempDir() + "exhibit.yaml";
  std::ofstream{path} << text;
  const auto exhibit = read_exhibit(path, specs());
  std::filesystem::remove(path);
  if (exhibit) return "";
  std::string message = to_string(exhibit.error());
  return message.starts_with(path) ? message.substr(path.size()) : message;
}

std::string shipped() { return files::content(STORMPROOF_SPECS_DIR "/museum/E0.yaml"); }
std::string with(const std::string& from, const std::string& to) {
  std::string text = shipped();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(MuseumFiles, AreRefusedWithTheirPlace) {
  EXPECT_EQ(refusal(shipped()), "");
  EXPECT_NE(refusal(with("vendor: Fast DDS", "vendo: Fast DDS")).find("unknown key 'vendo'"),
            std::string::npos);
  EXPECT_NE(refusal(with("year: 2017", "year: 1066")).find("expected a number from 1990 to 2100"),
            std::string::npos);
  EXPECT_NE(refusal(with("rules: [AnswerInitial]", "rules: [AnswerFirst]"))
                .find("no composition has a rule 'AnswerFirst'"),
            std::string::npos);
  EXPECT_NE(refusal(with("claim: live.recovery", "claim: live.recover"))
                .find("did you mean 'live.recovery'"),
            std::string::npos);
  EXPECT_NE(refusal(with("bound: 5s\n", "")).find("missing key 'bound'"), std::string::npos);
  EXPECT_NE(refusal(with("after: bounded", "after: observed"))
                .find("expected violated, bounded or proved"),
            std::string::npos);
  EXPECT_NE(refusal(with("initial_acknack_resets: true", "initial_acknack_resets: maybe"))
                .find("expected one of"),
            std::string::npos);
  EXPECT_NE(refusal(with("reader: 1", "reader: 7")).find("participants of different hosts"),
            std::string::npos);
}

TEST(Museum, SaysNothingMoreIfItIsStopped) {
  const auto exhibit = read_exhibit("E2", specs());
  ASSERT_TRUE(exhibit);
  int left = 5;
  const Report report = show({*exhibit}, [&] { return left-- > 0; });
  EXPECT_FALSE(report.finished);
  EXPECT_FALSE(report.as_expected());
  EXPECT_EQ(report.exhibits.front().after.verdict, props::VerdictKind::inconclusive);
}

TEST(Museum, IsInconclusiveIfRunsAreTooShort) {
  auto exhibit = read_exhibit("E0", specs());
  ASSERT_TRUE(exhibit);
  exhibit->before.scenario.time_limit = model::Nanoseconds{1'000'000'000};
  const Report report = show({*exhibit}, always);
  EXPECT_EQ(report.exhibits.front().before.verdict, props::VerdictKind::inconclusive);
}

TEST(Museum, TellsTheShortestCounterexample) {
  auto exhibit = read_exhibit("E3", specs());
  ASSERT_TRUE(exhibit);
  exhibit->losses = 1;
  const Report report = show({*exhibit}, always);
  const auto json = to_json(report)["exhibits"][0];
  EXPECT_EQ(json["before"]["verdict"], "violated");
  EXPECT_TRUE(json["before"]["lost_packets"].empty());
  EXPECT_EQ(json["after"]["verdict"], "proved");
  EXPECT_FALSE(json["after"]["assumptions"].empty());
  EXPECT_EQ(json["decoys"][0]["verdict"], "violated");
  EXPECT_EQ(json["decoys"][0]["lost_packets"].size(), 1U);
  EXPECT_EQ(json["decoys"][1]["verdict"], "proved");
}

/// What is expected is asked for, not believed.
TEST(Museum, IsNotProvedBecauseItIsExpectedToBe) {
  auto exhibit = read_exhibit("E1", specs());
  ASSERT_TRUE(exhibit);
  exhibit->losses = 0;
  exhibit->after.expected = props::VerdictKind::proved;
  const Report report = show({*exhibit}, always);
  EXPECT_EQ(report.exhibits.front().after.verdict, props::VerdictKind::bounded);
  EXPECT_FALSE(report.as_expected());
}

/// A run that breaks only the bound of an exhibit contradicts no proof.
TEST(Museum, DisputesAProofThatRunsContradict) {
  const auto exhibit = read_exhibit("E3", specs());
  ASSERT_TRUE(exhibit);
  Exhibit strict = *exhibit;
  strict.losses = 0;
  strict.bound = model::Nanoseconds{1};
  Found late = search(strict, strict.after, always);
  ASSERT_EQ(late.verdict, props::VerdictKind::violated);
  certify(late, strict, strict.after, always);
  EXPECT_EQ(late.verdict, props::VerdictKind::violated);

  props::Finding proof;
  take(late, proof);
  EXPECT_EQ(late.verdict, props::VerdictKind::violated);
  proof.kind = props::VerdictKind::proved;
  take(late, proof);
  EXPECT_EQ(late.verdict, props::VerdictKind::disputed);
}

}  // namespace museum_test
}  // namespace stormproof::museum
