// Hostile sizes are refused with the limit named, before they cost memory or time.
#include <string>

#include <gtest/gtest.h>

#include "model/config/scenario_file.hpp"
#include "model/trace/replay.hpp"
#include "tests/files.hpp"
#include "tests/fuzzing/checks.hpp"
#include "tests/fuzzing/memory_file.hpp"

namespace stormproof::fuzzing {
namespace limits_test {

using model::Scenario;

std::string corpus(const std::string& file) {
  return files::content(std::string{STORMPROOF_SOURCE_DIR "/tests/fuzzing/corpus/"} + file);
}

std::string error_of(const std::string& file) {
  const auto scenario = model::config::parse_scenario(corpus(file), "input", {}, specs());
  return scenario ? "accepted" : to_string(scenario.error());
}

std::string error_with(const std::string& change) {
  const auto scenario = model::config::read_scenario("smallest", {&change, 1}, specs());
  return scenario ? "accepted" : to_string(scenario.error());
}

testing::AssertionResult has(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << text;
}

/// Counts the events of a replay.
class Counter final : public model::trace::ViolationWatch, private model::Probe {
 public:
  explicit Counter(std::uint64_t& events) : events_{events} {}

  [[nodiscard]] model::Probe& probe() override { return *this; }
  void finish(model::Nanoseconds) override {}
  [[nodiscard]] std::optional<model::trace::TraceViolation> violation() const override {
    return std::nullopt;
  }

 private:
  void event_started(const model::Event&) override { ++events_; }

  std::uint64_t& events_;
};

TEST(HostileSizes, ParticipantsOfOneHost) {
  EXPECT_TRUE(has(error_of("scenario/refused-billion-participants.yaml"),
                  "input:1:21: deployment.hosts: '1000000000' is out of range; expected an integer "
                  "from 1 to 4000"));
}

TEST(HostileSizes, ParticipantsInAll) {
  EXPECT_TRUE(has(error_of("scenario/refused-billion-in-all.yaml"), "at most 4000 participants"));
}

TEST(HostileSizes, StateOfTheRelations) {
  EXPECT_TRUE(has(error_of("scenario/refused-too-much-state.yaml"),
                  "at most 10000000000 descriptors over all pairs of participants"));
  // 4000 · 3999 · (17 + E): E = 608 is the greatest number of endpoints that passes.
  const std::string most = "{hosts: 2, participants_per_host: 2000, endpoints_per_participant: ";
  EXPECT_EQ(error_with("deployment=" + most + "608}"), "accepted");
  EXPECT_TRUE(has(error_with("deployment=" + most + "609}"), "at most 10000000000 descriptors"));
}

TEST(HostileSizes, AliasesAndNesting) {
  EXPECT_TRUE(has(error_of("scenario/refused-billion-laughs.yaml"), "more than 1000000 values"));
  for (const char* shape : {"list.yaml", "map.yaml", "block.yaml"}) {
    EXPECT_TRUE(has(error_of(std::string{"scenario/refused-deep-"} + shape),
                    "nested more than 64 levels deep"));
  }
}

TEST(HostileSizes, FractionsWhoseTermsAreNearTheEndOfSixtyFourBits) {
  EXPECT_TRUE(has(error_of("scenario/refused-tiny-fraction.yaml"), "out of range"));
  EXPECT_TRUE(has(error_with("limits.amplification=9223372036854775807"), "at most 1000000"));
}

TEST(HostileSizes, HeaderOfATrace) {
  const MemoryFile file{corpus("trace/refused-billions-of-descriptors.jsonl")};
  const auto replay = model::trace::replay(file.path(), specs());
  ASSERT_FALSE(replay);
  EXPECT_TRUE(has(to_string(replay.error()), "at most 10000000000 descriptors"));
}

TEST(HostileSizes, AShortTraceOfALongRunIsReplayedShortly) {
  std::string trace = corpus("trace/accepted-different.jsonl");
  const auto replace = [&trace](const std::string& old, const std::string& now) {
    const std::size_t found = trace.find(old);
    ASSERT_NE(found, std::string::npos) << old;
    trace.replace(found, old.size(), now);
  };
  // A million announcements, a nanosecond apart, and no end with the completion of discovery.
  replace(R"("startup_period":"100ms")", R"("startup_period":"1ns")");
  replace(R"("startup_announcements":5)", R"("startup_announcements":1000000)");
  replace(R"("time_limit":"200s")", R"("time_limit":"200s","run_until":"time_limit")");
  replace(R"({"format")",
          R"({"expect":{"property":"any","event":1000000,"t":0,"reason":""},"format")");
  std::uint64_t events = 0;
  const auto replay = model::trace::replay(
      MemoryFile{trace}.path(), specs(), {},
      [&events](const std::string&, const Scenario&) { return std::make_unique<Counter>(events); });
  ASSERT_TRUE(replay) << to_string(replay.error());
  EXPECT_EQ(replay->verdict, model::trace::Verdict::different);
  EXPECT_GE(events, 3U);
  EXPECT_LE(events, trace.size() / 8 + 1);
}

TEST(HostileSizes, ABrokenLawEndsTheProgram) {
  EXPECT_DEATH(require(false, "one is two"), "broken: one is two");
  require(true, "one is one");
}

}  // namespace limits_test
}  // namespace stormproof::fuzzing
